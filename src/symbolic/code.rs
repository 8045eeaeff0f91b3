//! Source code that computes what a [`Program`] computes, operation by operation, in C, Python and Rust.
//!
//! Run in binary64, the code does the same operations in the same order as
//! [`Program::bind`] to [`Native<f64>`](crate::real::Native) does, infinities and NaN included. So values
//! differ only where the languages' libraries of elementary functions do, and where a C compiler works out
//! functions of constants itself: gcc rounds them correctly, unless it is told `-fno-builtin`. Arguments
//! must be binary64: a Python `int` is computed with as the integer that it is.

mod body;
mod c;
mod callee;
mod layout;
mod names;
mod number;
mod python;
mod rust;
mod text;

use super::Program;
use layout::Layout;
use names::Names;
use rug::Rational;
use std::fmt;
use std::str::FromStr;

/// A language that source code is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// C99.
    C,
    /// Python 3, with its own `math` module.
    Python,
    /// Rust, with the crate `libm` where erf is needed.
    Rust,
}

/// Text that names no language.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown language '{name}' (allowed: c, python, rust)")]
pub struct LanguageError {
    /// The text given.
    pub name: String,
}

impl Language {
    /// All of them.
    pub const ALL: [Language; 3] = [Language::C, Language::Python, Language::Rust];

    fn layout(self) -> &'static dyn Layout {
        match self {
            Language::C => &c::C,
            Language::Python => &python::Python,
            Language::Rust => &rust::Rust,
        }
    }
}

impl FromStr for Language {
    type Err = LanguageError;

    fn from_str(name: &str) -> Result<Self, LanguageError> {
        Language::ALL
            .into_iter()
            .find(|language| language.to_string() == name)
            .ok_or_else(|| LanguageError { name: name.into() })
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Language::C => "c",
            Language::Python => "python",
            Language::Rust => "rust",
        })
    }
}

/// One function of a source file.
#[derive(Clone, Copy, Debug)]
pub struct Definition<'a> {
    /// Its name.
    pub name: &'a str,
    /// What it computes, for a comment.
    pub doc: &'a str,
    /// Its parameters are the inputs, its value is the first output.
    pub program: &'a Program,
}

/// A source file: `head` as a comment, then the named constants, then the functions.
///
/// Names that the language, its library or another name has taken get underscores appended; characters
/// that no identifier may have become underscores.
///
/// ```
/// use volver::symbolic::code::{Definition, Language, source};
/// use volver::symbolic::{Expr, Program};
///
/// let integral: Expr = "2 - (sin(lambda^2) + 2)*exp(-sin(lambda^2)/2)".parse()?;
/// let program = Program::new(&[integral], &["lambda"])?;
/// let definition = Definition { name: "integral", doc: "The integral.", program: &program };
/// let code = source(Language::C, "", &[], &[definition]);
/// assert!(code.ends_with(
/// "// The integral.
/// double integral(double lambda) {
///     const double t1 = sin(lambda * lambda);
///     return 2.0 - (t1 + 2.0) * exp(-0.5 * t1);
/// }
/// "
/// ));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn source(
    language: Language,
    head: &str,
    constants: &[(&str, &Rational)],
    definitions: &[Definition<'_>],
) -> String {
    let layout = language.layout();
    let mut names = Names::new(layout);
    let wanted = constants.iter().map(|(name, _)| *name);
    let wanted: Vec<&str> = wanted.chain(definitions.iter().map(|d| d.name)).collect();
    let given = names.claim(&wanted);
    let (constant_names, function_names) = given.split_at(constants.len());

    let mut callees = Vec::new();
    let mut functions = String::new();
    for (definition, name) in definitions.iter().zip(function_names) {
        let body = body::body(definition.program, layout, &names, &mut callees);
        functions += layout.gap();
        functions += &layout.function(name, &layout::lines(definition.doc), &body);
    }
    let mut code = String::new();
    if !constants.is_empty() {
        code.push('\n');
    }
    for ((_, value), name) in constants.iter().zip(constant_names) {
        code += &layout.constant(name, &number::rational(value, layout).text);
    }
    for helper in callees.iter().filter_map(|&callee| layout.helper(callee)) {
        code += layout.gap();
        code += helper;
    }
    code += &functions;
    let head = layout::comment(layout.comment(), &layout::lines(head));
    let text = head + &layout.prologue(&callees, &code) + &code;
    text.trim_start().into()
}

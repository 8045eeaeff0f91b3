//! A case as a file for Coq: definitions, and a theorem a channel.

use crate::case::manufacture::Manufactured;
use crate::case::{Case, Description};
use crate::symbolic::{CoqError, Expr};
use std::fmt::Write;

/// What stands in every file that is written, and in no other.
pub const MARK: &str = "Written by volver prove; not to be edited.";

/// A file for Coq.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Script {
    /// The case's name as an identifier: that of the file, without its ending, and of the theorem.
    pub name: String,
    /// The theorems, a channel each, as the file qualifies them.
    pub theorems: Vec<String>,
    /// The file.
    pub text: String,
}

/// Why there is no theorem about a case.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotStated {
    /// The radiance is known by reference only.
    #[error("{case} has no closed form to prove (allowed: cases with a depth and a radiance)")]
    NoClosedForm {
        /// The case, with its channel.
        case: String,
    },
    /// A formula is none that the theory covers.
    #[error("{formula} of {case}: {error}")]
    NotElementary {
        /// The case, with its channel.
        case: String,
        /// Which of its formulas.
        formula: &'static str,
        /// What is in the way.
        error: CoqError,
    },
}

/// The theorem about each channel: with the case's own field and transfer functions, depth and volume
/// rendering integral exist for every 0 ≤ D ≤ length and are what the closed forms say.
///
/// # Errors
/// [`NotStated`] where a channel has no closed form, or one with branches or fractional powers.
pub fn script(description: &Description, cases: &[Manufactured]) -> Result<Script, NotStated> {
    let name = identifier(&description.name);
    let mut text = head(description);
    let mut theorems = Vec::new();
    for case in cases {
        let statement = Statement::of(case)?;
        match &case.channel {
            None => {
                statement.write(&mut text, &name);
                theorems.push(name.clone());
            }
            Some(channel) => {
                let module = identifier(channel);
                let theorem = format!("{name}_{module}");
                // Writing to a String does not fail.
                let _ = writeln!(text, "\nModule {module}.");
                statement.write(&mut text, &theorem);
                let _ = writeln!(text, "End {module}.");
                theorems.push(format!("{module}.{theorem}"));
            }
        }
    }
    Ok(Script {
        name,
        theorems,
        text,
    })
}

fn head(description: &Description) -> String {
    let title = if description.title.is_empty() {
        String::new()
    } else {
        format!(": {}", comment(&description.title))
    };
    format!(
        "(** * {}{title}

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    {MARK} *)

From Volver Require Import CaseTactic.
",
        comment(&description.name)
    )
}

/// A channel's formulas as terms.
struct Statement {
    length: String,
    /// What is defined, of which variable, as what.
    definitions: [(&'static str, &'static str, String); 5],
}

impl Statement {
    fn of(case: &Manufactured) -> Result<Self, NotStated> {
        let formulas = case.case.formulas();
        let (Some(depth), Some(radiance)) = (&formulas.optical_depth, &formulas.radiance) else {
            return Err(NotStated::NoClosedForm {
                case: case.case.name().into(),
            });
        };
        let term = |formula: &'static str, expr: &Expr| {
            expr.to_coq().map_err(|error| NotStated::NotElementary {
                case: case.case.name().into(),
                formula,
                error,
            })
        };
        Ok(Statement {
            length: term("the length", &Expr::number(case.case.length()))?,
            definitions: [
                ("field", "lambda", term("the field", &formulas.field)?),
                (
                    "extinction",
                    "s",
                    term("the extinction", &formulas.extinction)?,
                ),
                ("emission", "s", term("the emission", &formulas.emission)?),
                ("exact_depth", "lambda", term("the optical depth", depth)?),
                ("exact_radiance", "lambda", term("the radiance", radiance)?),
            ],
        })
    }

    fn write(&self, text: &mut String, theorem: &str) {
        text.push('\n');
        for (name, variable, term) in &self.definitions {
            let _ = writeln!(text, "Definition {name} ({variable} : R) : R :=\n  {term}.");
        }
        let _ = write!(
            text,
            "
Theorem {theorem} (D : R) :
  0 <= D <= {} ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
",
            self.length
        );
    }
}

/// Words that Coq keeps for itself, as far as they could name a case.
const KEYWORDS: [&str; 24] = [
    "as", "at", "cofix", "else", "end", "exists", "fix", "for", "forall", "fun", "if", "in", "let",
    "match", "mod", "return", "then", "using", "where", "with", "Prop", "SProp", "Set", "Type",
];

/// The name with what no identifier may have replaced.
fn identifier(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let plain: String = name.chars().map(plain).collect();
    let begins = plain.starts_with(|c: char| c.is_ascii_alphabetic());
    if begins && !KEYWORDS.contains(&plain.as_str()) {
        plain
    } else {
        format!("case_{plain}")
    }
}

/// Text that neither ends a comment nor opens one or a string in it.
fn comment(text: &str) -> String {
    let plain = |c: char| match c {
        '"' => '\'',
        '*' => '×',
        c if c.is_control() => ' ',
        c => c,
    };
    text.chars().map(plain).collect()
}

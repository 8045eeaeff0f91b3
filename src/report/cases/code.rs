//! The functions of a case as source code.

use super::Derived;
use crate::symbolic::code::{Definition, Language, source};
use crate::symbolic::{CompileError, Expr, Program};

/// A function to be: name, comment and program.
struct Wanted {
    name: String,
    doc: String,
    program: Program,
}

impl Wanted {
    fn new(name: String, doc: String, of: &Expr, input: &str) -> Result<Self, CompileError> {
        let program = Program::new(std::slice::from_ref(of), &[input])?;
        Ok(Wanted { name, doc, program })
    }
}

/// A source file with the length and all functions: field, extinction and, where there is a closed form, optical depth;
/// emission and radiance of every channel.
///
/// # Errors
/// [`CompileError`] where a formula is no program.
pub fn code(derived: &Derived, language: Language) -> Result<String, CompileError> {
    let description = &derived.description;
    let mut head = description.name.clone();
    if !description.title.is_empty() {
        head = format!("{head}: {}", description.title);
    }
    let version = env!("CARGO_PKG_VERSION");
    head = format!("{head}\nWritten by volver {version}. 0 <= lambda <= LENGTH.");
    if derived.cases.iter().any(|case| !case.has_closed_form()) {
        head += "\nThe optical depth and the radiance have no closed form: there is no function of them.";
    }
    let mut wanted = Vec::new();
    if let Some(case) = derived.cases.first() {
        let formulas = case.case.formulas();
        for (name, doc, of, input) in [
            ("field", "Field s at lambda.", &formulas.field, "lambda"),
            (
                "extinction",
                "Extinction tau of the field value s, per unit of length.",
                &formulas.extinction,
                "s",
            ),
        ] {
            wanted.push(Wanted::new(name.into(), doc.into(), of, input)?);
        }
        if let Some(depth) = &formulas.optical_depth {
            let doc = "Optical depth t from 0 to lambda.".into();
            wanted.push(Wanted::new("optical_depth".into(), doc, depth, "lambda")?);
        }
    }
    for case in &derived.cases {
        let formulas = case.case.formulas();
        let (suffix, of_channel) = match (&case.channel, &derived.cases[..]) {
            (Some(channel), [_, _, ..]) => (format!("_{channel}"), format!(", {channel}")),
            _ => (String::new(), String::new()),
        };
        wanted.push(Wanted::new(
            format!("emission{suffix}"),
            format!("Emission C of the field value s{of_channel}, per unit of optical depth."),
            &formulas.emission,
            "s",
        )?);
        if let Some(radiance) = &formulas.radiance {
            let doc = format!("Exact radiance I from 0 to lambda{of_channel}.");
            let name = format!("radiance{suffix}");
            wanted.push(Wanted::new(name, doc, radiance, "lambda")?);
        }
    }
    let definitions: Vec<Definition<'_>> = wanted
        .iter()
        .map(|wanted| Definition {
            name: &wanted.name,
            doc: &wanted.doc,
            program: &wanted.program,
        })
        .collect();
    let length = &description.length;
    Ok(source(language, &head, &[("LENGTH", length)], &definitions))
}

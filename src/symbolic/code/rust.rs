//! Rust.

use super::callee::Callee;
use super::layout::{self, Body, Choice, Layout};
use super::names::listed;
use crate::symbolic::Function;

/// Rust with its own `f64`.
pub(super) struct Rust;

/// Keywords of all editions, variants of the prelude, and the names that generated code uses.
const WORDS: &str = "
    abstract as async await become box break const continue crate do dyn else enum extern false final fn
    for gen if impl in let loop macro match mod move mut override priv pub ref return self Self static
    struct super trait true try type typeof union unsafe unsized use virtual where while yield _
    None Some Ok Err main f64 std libm lesser greater
";

const LESSER: &str = "\
/// The lesser of the two; NaN where one of them is.
fn lesser(a: f64, b: f64) -> f64 {
    if b < a {
        b
    } else if a <= b {
        a
    } else {
        f64::NAN
    }
}
";

const GREATER: &str = "\
/// The greater of the two; NaN where one of them is.
fn greater(a: f64, b: f64) -> f64 {
    if b > a {
        b
    } else if a >= b {
        a
    } else {
        f64::NAN
    }
}
";

impl Layout for Rust {
    fn reserved(&self, name: &str) -> bool {
        listed(WORDS, name)
    }

    fn pi(&self) -> &'static str {
        "std::f64::consts::PI"
    }

    fn infinity(&self) -> &'static str {
        "f64::INFINITY"
    }

    fn nan(&self) -> &'static str {
        "f64::NAN"
    }

    fn callee(&self, callee: Callee) -> &'static str {
        match callee {
            Callee::Function(Function::Exp) => "f64::exp",
            Callee::Function(Function::Ln) => "f64::ln",
            Callee::Function(Function::Sin) => "f64::sin",
            Callee::Function(Function::Cos) => "f64::cos",
            Callee::Function(Function::Tan) => "f64::tan",
            Callee::Function(Function::Sinh) => "f64::sinh",
            Callee::Function(Function::Cosh) => "f64::cosh",
            Callee::Function(Function::Tanh) => "f64::tanh",
            Callee::Function(Function::Atan) => "f64::atan",
            Callee::Function(Function::Erf) => "libm::erf",
            Callee::Function(Function::Abs) => "f64::abs",
            Callee::Sqrt => "f64::sqrt",
            Callee::ExpM1 => "f64::exp_m1",
            Callee::Ln1p => "f64::ln_1p",
            Callee::Min => "lesser",
            Callee::Max => "greater",
            Callee::Divide => "",
        }
    }

    fn helper(&self, callee: Callee) -> Option<&'static str> {
        match callee {
            Callee::Min => Some(LESSER),
            Callee::Max => Some(GREATER),
            _ => None,
        }
    }

    fn choice(&self, choice: &Choice<'_>) -> String {
        let (condition, opposite) = choice.conditions();
        let (then, otherwise) = (choice.then, choice.otherwise);
        format!(
            "if {condition} {{
        {then}
    }} else if {opposite} {{
        {otherwise}
    }} else {{
        f64::NAN
    }}"
        )
    }

    fn comment(&self) -> &'static str {
        "//"
    }

    fn prologue(&self, callees: &[Callee], _: &str) -> String {
        if callees.contains(&Callee::Function(Function::Erf)) {
            "// Rust's standard library has no erf: this needs the crate libm (cargo add libm).\n"
                .into()
        } else {
            String::new()
        }
    }

    fn gap(&self) -> &'static str {
        "\n"
    }

    fn constant(&self, name: &str, value: &str) -> String {
        let allow = if name.chars().any(|c| c.is_ascii_lowercase()) {
            "#[allow(non_upper_case_globals)]\n"
        } else {
            ""
        };
        format!("{allow}pub const {name}: f64 = {value};\n")
    }

    fn function(&self, name: &str, doc: &[String], body: &Body) -> String {
        let parameters: Vec<String> = body
            .parameters
            .iter()
            .map(|parameter| format!("{parameter}: f64"))
            .collect();
        let mut text = layout::comment("///", doc);
        if !body.parameters.iter().all(|name| is_snake_case(name)) || !is_snake_case(name) {
            text += "#[allow(non_snake_case)]\n";
        }
        text.extend(["pub fn ", name, "(", &parameters.join(", "), ") -> f64 {\n"]);
        for unused in &body.unused {
            text.extend(["    let _ = ", unused, ";\n"]);
        }
        for (step, value) in &body.steps {
            text.extend(["    let ", step, " = ", value, ";\n"]);
        }
        text + &format!("    {}\n}}\n", body.value)
    }
}

/// As rustc sees it.
fn is_snake_case(name: &str) -> bool {
    !name.trim_matches('_').contains("__") && !name.chars().any(|c| c.is_ascii_uppercase())
}

//! The formulas of a case in LaTeX.

use super::Derived;
use crate::case::Case;
use crate::symbolic::Expr;
use std::fmt::Write;

/// The formulas of a case in one `align*`; C and I have the channel's name below them where there are several.
#[must_use]
pub fn latex(derived: &Derived) -> String {
    let mut lines = Vec::new();
    let mut add = |left: String, right: &Expr| {
        lines.push(format!("  {left} &= {}", right.to_latex()));
    };
    if let Some(case) = derived.cases.first() {
        let formulas = case.case.formulas();
        add("D".into(), &Expr::number(case.case.length()));
        add(r"s(\lambda)".into(), &formulas.field);
        add(r"\tau(s)".into(), &formulas.extinction);
        if let Some(depth) = &formulas.optical_depth {
            add(r"t(\lambda)".into(), depth);
        }
    }
    for case in &derived.cases {
        let formulas = case.case.formulas();
        let below = match (&case.channel, &derived.cases[..]) {
            (Some(channel), [_, _, ..]) => format!(r"_{{\text{{{channel}}}}}"),
            _ => String::new(),
        };
        add(format!("C{below}(s)"), &formulas.emission);
        if let Some(radiance) = &formulas.radiance {
            add(format!(r"I{below}(\lambda)"), radiance);
        }
    }
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = writeln!(
        text,
        "% {}, for the package amsmath",
        derived.description.name
    );
    if derived.cases.iter().any(|case| !case.has_closed_form()) {
        let _ = writeln!(
            text,
            "% no closed form of the optical depth and the radiance"
        );
    }
    let _ = writeln!(
        text,
        "\\begin{{align*}}\n{}\n\\end{{align*}}",
        lines.join(" \\\\\n")
    );
    text
}

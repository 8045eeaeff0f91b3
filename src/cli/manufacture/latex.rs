//! The formulas of a case in LaTeX.

use crate::cli::case::Loaded;
use std::fmt::Write;
use volver::case::Case;
use volver::symbolic::Expr;

/// One `align*`; C and I have the channel's name below them where there are several.
pub(super) fn render(loaded: &Loaded) -> String {
    let mut lines = Vec::new();
    let mut add = |left: String, right: &Expr| {
        lines.push(format!("  {left} &= {}", right.to_latex()));
    };
    if let Some(case) = loaded.cases.first() {
        let formulas = case.case.formulas();
        add("D".into(), &Expr::number(case.case.length()));
        add(r"s(\lambda)".into(), &formulas.field);
        add(r"\tau(s)".into(), &formulas.extinction);
        if let Some(depth) = &formulas.optical_depth {
            add(r"t(\lambda)".into(), depth);
        }
    }
    for case in &loaded.cases {
        let formulas = case.case.formulas();
        let below = match (&case.channel, &loaded.cases[..]) {
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
        loaded.description.name
    );
    if loaded.cases.iter().any(|case| !case.has_closed_form()) {
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

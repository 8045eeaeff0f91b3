//! The table of a study for a paper.

use super::words::{best, crossing, exponent, order, theory};
use crate::study::sweep::Results;
use std::fmt::Write;

/// A `tabular` for the package booktabs, one row a case, method and format; the formats of a sweep are left
/// out. Names are escaped.
#[must_use]
pub fn latex(results: &Results) -> String {
    let mut text = String::from(
        "% A study of volver; needs \\usepackage{booktabs}.\n\
         \\begin{tabular}{lllllllrr}\n\\toprule\n\
         case & method & format & $p$ & theory & $q_\\mathrm{arithmetic}$ & $q_\\mathrm{input}$ & $n^*$ & best \\\\\n",
    );
    // Writing to a String does not fail.
    for (case, method, lines) in results.groups() {
        for (index, line) in lines.iter().enumerate() {
            let summary = &line.summary;
            let (rule, case, method) = if index == 0 {
                ("\\midrule\n", case, method)
            } else {
                ("", "", "")
            };
            let cells = [
                case.to_string(),
                method.to_string(),
                line.format.clone(),
                order(&summary.discretization),
                theory(line.row.expected),
                exponent(summary.laws.arithmetic),
                exponent(summary.laws.input),
                crossing(line),
                best(line),
            ];
            let cells: Vec<String> = cells.iter().map(|cell| escape(cell)).collect();
            let _ = writeln!(text, "{rule}{} \\\\", cells.join(" & "));
        }
    }
    text.push_str("\\bottomrule\n\\end{tabular}\n");
    text
}

/// Text that LaTeX sets as it stands; letters that it may not know become commands or question marks.
pub(in crate::report) fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(c);
            }
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("$\\sim$"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '<' => escaped.push_str("$<$"),
            '>' => escaped.push_str("$>$"),
            '±' => escaped.push_str("$\\pm$"),
            '×' => escaped.push_str("$\\times$"),
            c if c.is_ascii() && !c.is_ascii_control() => escaped.push(c),
            _ => escaped.push('?'),
        }
    }
    escaped
}

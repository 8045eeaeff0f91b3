//! The table for a terminal.

use super::super::text::{MIN_WIDTH, Style, paint, wrap};
use super::words::{LEGEND, best, crossing, exponent, order, summary, theory, warnings};
use crate::convergence::{Fit, Verdict};
use crate::study::sweep::{Line, Results};
use std::fmt::Write;

/// Columns behind the format's: a name and a width each.
const HEAD: [(&str, usize); 4] = [
    ("discretization, total", 29),
    ("q arithm., input", 16),
    ("n*", 7),
    ("best", 7),
];

/// The table in lines of at most `width` columns, with ANSI colour where `color` says so: for every case and
/// method two lines a format, of discretization and of the total error. The last line counts verdicts.
#[must_use]
pub fn text(results: &Results, width: usize, color: bool) -> String {
    let width = width.max(MIN_WIDTH);
    let formats = results.lines.iter().filter(|line| !line.swept);
    let page = Page {
        width,
        color,
        format: formats
            .map(|line| line.format.chars().count())
            .max()
            .unwrap_or(0)
            .max(6),
    };
    let mut text = String::new();
    for (case, method, lines) in results.groups() {
        page.group(case, method, &lines, &mut text);
    }
    if !results.lines.is_empty() {
        page.legend(&mut text);
    }
    text.push_str(&summary(results));
    text.push('\n');
    text
}

struct Page {
    width: usize,
    color: bool,
    /// The width of the formats' column.
    format: usize,
}

// Writing to a String does not fail, so that results are dropped here.
impl Page {
    fn fits(&self) -> bool {
        let columns: usize = HEAD.iter().map(|(_, width)| width + 2).sum();
        2 + self.format + columns <= self.width
    }

    fn group(&self, case: &str, method: &str, lines: &[&Line], text: &mut String) {
        let Some(first) = lines.first() else {
            return;
        };
        let title = format!("{case}, {method}: theory {}", theory(first.row.expected));
        for line in wrap(&title, self.width, "", "  ") {
            let _ = writeln!(text, "{}", self.paint(&line, Style::Bold));
        }
        if self.fits() {
            let mut head = format!("  {:<1$}", "format", self.format);
            for (index, (name, width)) in HEAD.iter().enumerate() {
                head += &cell(name, *width, index == 0);
            }
            let _ = writeln!(text, "{}", self.paint(head.trim_end(), Style::Faint));
        }
        for line in lines {
            if self.fits() {
                self.line(line, text);
            } else {
                self.narrow(line, text);
            }
        }
        for line in lines {
            for warning in warnings(line) {
                let warning = format!("{}: {warning}", line.format);
                for line in wrap(&warning, self.width, "! ", "  ") {
                    let _ = writeln!(text, "{}", self.paint(&line, Style::Open));
                }
            }
        }
        text.push('\n');
    }

    fn line(&self, line: &Line, text: &mut String) {
        let summary = &line.summary;
        let width = HEAD[0].1;
        let of = |fit: &Fit, good: bool| {
            let figure = figure(fit);
            let padding = " ".repeat(width.saturating_sub(figure.chars().count()));
            format!(
                "  {}{padding}",
                self.paint(&figure, style(fit.verdict, good))
            )
        };
        let mut first = format!("  {:<1$}", line.format, self.format);
        first += &of(&summary.discretization, line.contradicts_theory());
        let cells = [
            exponent(summary.laws.arithmetic),
            crossing(line),
            best(line),
        ];
        for (text, (_, width)) in cells.iter().zip(&HEAD[1..]) {
            first += &cell(text, *width, false);
        }
        let mut second = format!("  {:<1$}{2}", "", self.format, of(&summary.total, false));
        second += &cell(&exponent(summary.laws.input), HEAD[1].1, false);
        let _ = writeln!(text, "{}\n{}", first.trim_end(), second.trim_end());
    }

    /// Where the table has no room.
    fn narrow(&self, line: &Line, text: &mut String) {
        let summary = &line.summary;
        let figures = format!(
            "{}: discretization {}; total {}; q arithmetic {}; q input {}; n* {}; best {}",
            line.format,
            figure(&summary.discretization),
            figure(&summary.total),
            exponent(summary.laws.arithmetic),
            exponent(summary.laws.input),
            crossing(line),
            best(line),
        );
        for line in wrap(&figures, self.width, "  ", "    ") {
            let _ = writeln!(text, "{line}");
        }
    }

    fn legend(&self, text: &mut String) {
        for (word, meaning) in LEGEND {
            for line in wrap(meaning, self.width, &format!("{word:<16}"), &" ".repeat(16)) {
                let _ = writeln!(text, "{}", self.paint(&line, Style::Faint));
            }
        }
        text.push('\n');
    }

    fn paint(&self, text: &str, style: Style) -> String {
        paint(text, style, self.color)
    }
}

/// "2.003 ± 0.021 Confirmed".
fn figure(fit: &Fit) -> String {
    format!("{} {}", order(fit), fit.verdict)
}

fn cell(text: &str, width: usize, left: bool) -> String {
    if left {
        format!("  {text:<width$}")
    } else {
        format!("  {text:>width$}")
    }
}

pub(super) fn style(verdict: Verdict, contradicts: bool) -> Style {
    match verdict {
        _ if contradicts => Style::Bad,
        Verdict::Confirmed | Verdict::Exact => Style::Good,
        _ => Style::Open,
    }
}

//! The tables for a terminal.

use super::super::text::{MIN_WIDTH, Style, paint, wrap};
use super::words::{model, range, relative, runs, states, unreached, usual, way};
use crate::study::tradeoff::{CaseResults, Cost, Results, standings};
use std::fmt::Write;

/// Methods and formats that the summary names at most.
const NAMED: usize = 12;

/// For every case the cheapest way to each error with what is usual beside it, in lines of at most `width`
/// columns, with ANSI colour where `color` says so; then how often methods are on a front, and how well the
/// model does.
#[must_use]
pub fn text(results: &Results, width: usize, color: bool) -> String {
    let page = Page {
        width: width.max(MIN_WIDTH),
        color,
        cost: results.cost,
    };
    let mut text = String::new();
    for case in &results.cases {
        page.case(case, &mut text);
    }
    page.summary(results, &mut text);
    text
}

struct Page {
    width: usize,
    color: bool,
    cost: Cost,
}

// Writing to a String does not fail, so that results are dropped here.
impl Page {
    fn case(&self, case: &CaseResults, text: &mut String) {
        let title = format!("{}: {}", case.name, relative(case));
        self.put(&title, "", "  ", Style::Bold, text);
        self.put(&states(case), "  ", "  ", Style::Faint, text);
        let goals = case.goals(self.cost);
        let last = match self.cost {
            Cost::Operations => "operations",
            _ => "time",
        };
        let head = ["error", "method", "format", "n", "eval.", last, "usual"];
        let mut rows = vec![head.map(String::from)];
        for (first, last_of) in runs(&goals) {
            let Some(best) = last_of.best else { continue };
            let [method, format, n, evaluations, operations, time] = way(best, self.cost);
            let last = match self.cost {
                Cost::Operations => operations,
                _ => time,
            };
            let usual = usual(first, self.cost);
            rows.push([
                range((first, last_of)),
                method,
                format,
                n,
                evaluations,
                last,
                usual,
            ]);
        }
        self.table(&rows, text);
        if let Some(unreached) = unreached(&goals) {
            self.put(&unreached, "  ", "  ", Style::Open, text);
        }
        text.push('\n');
    }

    /// Columns as wide as they need to be; where they do not fit, the method has a line of its own.
    fn table(&self, rows: &[[String; 7]], text: &mut String) {
        let widths: [usize; 7] = std::array::from_fn(|column| {
            let lengths = rows.iter().map(|row| row[column].chars().count());
            lengths.max().unwrap_or(0)
        });
        // A column of which nothing is known, as times without timing, has its name alone.
        let shown = |column: usize| rows.iter().skip(1).any(|row| !row[column].is_empty());
        let total: usize = (0..7).filter(|c| shown(*c)).map(|c| widths[c] + 2).sum();
        let fits = total <= self.width;
        for (index, row) in rows.iter().enumerate() {
            let mut line = String::new();
            for column in (0..7).filter(|column| shown(*column)) {
                let (cell, width) = (&row[column], widths[column]);
                let _ = match column {
                    1 if !fits => Ok(()),
                    0..=2 | 6 => write!(line, "  {cell:<width$}"),
                    _ => write!(line, "  {cell:>width$}"),
                };
            }
            let line = line.trim_end();
            let style = (index == 0).then_some(Style::Faint);
            let _ = match style {
                Some(style) => writeln!(text, "{}", paint(line, style, self.color)),
                None => writeln!(text, "{line}"),
            };
            if !fits && index > 0 {
                let _ = writeln!(text, "    by {}", row[1]);
            }
        }
    }

    fn summary(&self, results: &Results, text: &mut String) {
        let standings = standings(results, self.cost);
        let of = results.cases.len();
        if !standings.is_empty() {
            let title = format!("Pareto fronts by {}: on how many of {of}", self.cost);
            self.put(&title, "", "  ", Style::Bold, text);
        }
        for standing in standings.iter().take(NAMED) {
            let line = format!(
                "{} in {}: {}, with {} of its points",
                standing.method, standing.format, standing.cases, standing.points
            );
            for line in wrap(&line, self.width, "  ", "    ") {
                let _ = writeln!(text, "{line}");
            }
        }
        if standings.len() > NAMED {
            let _ = writeln!(text, "  and {} more", standings.len() - NAMED);
        }
        text.push('\n');
        let usual = "usual: left Riemann sums with opacity 1 - exp(-tau d) in f32, \
                     front-to-back/front/subtraction; cannot: at no n that was run";
        self.put(usual, "", "  ", Style::Faint, text);
        for line in model(results) {
            self.put(&line, "", "  ", Style::Faint, text);
        }
    }

    fn put(&self, words: &str, first: &str, later: &str, style: Style, text: &mut String) {
        for line in wrap(words, self.width, first, later) {
            let _ = writeln!(text, "{}", paint(&line, style, self.color));
        }
    }
}

//! The report for a terminal: the paper's figure beside the order, row by row.

use super::{Group, groups, legend, proved};
use crate::convergence::Verdict;
use crate::study::reproduce::Entry;
use std::fmt::Write;

/// Narrower than this, lines are cut by the terminal instead.
pub(super) const MIN_WIDTH: usize = 40;

/// Columns of an entry; verdicts come last and may be as long as they are.
const HEAD: [(&str, usize); 5] = [
    ("", 10),
    ("paper", 5),
    ("protocol", 8),
    ("order", 16),
    ("levels n", 12),
];

/// The report in lines of at most `width` columns (the tables need 80, text is wrapped), with ANSI
/// colour where `color` says so. The last line counts the verdicts.
#[must_use]
pub fn reproduction(entries: &[Entry], width: usize, color: bool) -> String {
    let page = Page {
        width: width.max(MIN_WIDTH),
        color,
    };
    let mut text = String::new();
    for group in groups(entries) {
        page.table(&group, &mut text);
    }
    if !entries.is_empty() {
        page.legend(entries, &mut text);
    }
    text.push_str(&legend::summary(entries));
    text.push('\n');
    text
}

#[derive(Clone, Copy)]
pub(super) enum Style {
    Bold,
    Faint,
    Good,
    Open,
    Bad,
}

struct Page {
    width: usize,
    color: bool,
}

// Writing to a String does not fail, so that results are dropped here.
impl Page {
    fn table(&self, group: &Group<'_>, text: &mut String) {
        let (row_axis, column_axis) = group.table.axes();
        let _ = writeln!(text, "{}", self.paint(&group.title(), Style::Bold));
        let head = HEAD.map(|(name, _)| name.to_string());
        let head = line(&head.map(|h| if h.is_empty() { column_axis.into() } else { h }));
        let _ = writeln!(
            text,
            "{}",
            self.paint(&format!("{head}  verdict"), Style::Faint)
        );
        for row in &group.rows {
            let replicas = row
                .entries
                .iter()
                .find_map(|e| Some(format!(" ({} replicas in {})", e.replicas?, e.format)));
            let heading = format!("{row_axis}: {}", row.name);
            let _ = writeln!(
                text,
                "{}{}",
                self.paint(&heading, Style::Bold),
                replicas.unwrap_or_default()
            );
            for entry in &row.entries {
                self.entry(entry, text);
            }
        }
        let explained: Vec<&Entry> = group.entries().filter(|e| e.note.is_some()).collect();
        if !explained.is_empty() {
            text.push('\n');
        }
        for entry in explained {
            let note = entry.note.as_deref().unwrap_or_default();
            let note = format!("{}: {note}", legend::name(entry));
            for line in wrap(&note, self.width, "* ", "  ") {
                let _ = writeln!(text, "{line}");
            }
        }
        text.push('\n');
        let _ = writeln!(
            text,
            "{}",
            self.paint("proofs of the orders expected", Style::Bold)
        );
        for (theorem, entries) in proved::theorems(group.entries()) {
            let line = format!("{}: {entries}", proved::name(theorem));
            for line in wrap(&line, self.width, "  ", "    ") {
                let _ = writeln!(text, "{line}");
            }
        }
        text.push('\n');
    }

    fn entry(&self, entry: &Entry, text: &mut String) {
        let cells = line(&[
            entry.column.to_string(),
            legend::paper(entry),
            legend::protocol(entry),
            legend::order(entry),
            legend::window(entry),
        ]);
        let mark = if entry.note.is_some() { " *" } else { "" };
        let verdict = self.paint(entry.verdict.name(), style(entry));
        let _ = writeln!(text, "{cells}  {verdict}{mark}");
    }

    fn legend(&self, entries: &[Entry], text: &mut String) {
        let mut lines = vec![
            ("paper", "the figure that the paper prints"),
            (
                "protocol",
                "the paper's way here: one line through log|error| at all levels 8 … 1024, in binary64 \
                 (with replicas: of one run)",
            ),
            (
                "order",
                "Fitted at the levels n, where it is asymptotic; ± half of its interval. With replicas \
                 it is the standard deviation's; without levels, the last pair's, and ± is a spread",
            ),
        ];
        let verdicts = legend::counts(entries);
        for (verdict, _) in &verdicts {
            lines.push((verdict.name(), legend::meaning(*verdict)));
        }
        if entries.iter().any(|entry| entry.note.is_some()) {
            lines.push(("*", "explained below its table"));
        }
        for (word, meaning) in lines {
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

/// How good or bad an entry's verdict is.
pub(super) fn style(entry: &Entry) -> Style {
    match entry.verdict {
        verdict if verdict.passes(Some(entry.expected)) => Style::Good,
        Verdict::TooLow
        | Verdict::TooHigh
        | Verdict::Stalled
        | Verdict::Diverged
        | Verdict::NotFinite => Style::Bad,
        _ => Style::Open,
    }
}

/// Text in a style, where there is colour.
pub(super) fn paint(text: &str, style: Style, color: bool) -> String {
    if !color {
        return text.into();
    }
    let code = match style {
        Style::Bold => 1,
        Style::Faint => 2,
        Style::Good => 32,
        Style::Open => 33,
        Style::Bad => 31,
    };
    format!("\u{1b}[{code}m{text}\u{1b}[0m")
}

/// The cells of [`HEAD`]'s columns: the name to the left, figures to the right.
fn line(cells: &[String; 5]) -> String {
    let mut line = String::from(" ");
    for (index, (cell, (_, width))) in cells.iter().zip(HEAD).enumerate() {
        let _ = if index == 0 {
            write!(line, " {cell:<width$}")
        } else {
            write!(line, "  {cell:>width$}")
        };
    }
    line
}

/// Words in lines of at most `width`, which begin with `first` and then with `later`; a word that is
/// longer has a line of its own.
#[must_use]
pub fn wrap(text: &str, width: usize, first: &str, later: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = first.to_string();
    let mut empty = true;
    for word in text.split_whitespace() {
        let length = line.chars().count() + usize::from(!empty) + word.chars().count();
        if !empty && length > width {
            lines.push(std::mem::replace(&mut line, later.to_string()));
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    lines.push(line);
    lines
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{entry, replicated};
    use super::*;

    fn report(color: bool) -> String {
        let mut stalled = replicated("monte-carlo", "boole");
        stalled.verdict = Verdict::Stalled;
        reproduction(&[entry("simpson", "boole"), stalled], 80, color)
    }

    #[test]
    fn an_entry_shows_paper_protocol_order_and_verdict() {
        let text = report(false);
        let expected = "inner: simpson\n  boole        4.80      4.68     4.000 ± 0.009      16 … 256  Confirmed *\n";
        assert!(text.contains(expected), "{text}");
        assert!(text.contains("inner: monte-carlo (64 replicas in f64)\n"));
        assert!(text.contains("\n* simpson × boole: pre-asymptotic window (+0.66)"));
        assert!(text.contains("\nStalled         the error stays"));
        assert!(!text.contains("Diverged"));
        assert!(text.ends_with("\n2 entries: 1 Confirmed, 1 Stalled\n"));
        assert!(!text.contains('\u{1b}'));
    }

    #[test]
    fn color_adds_escapes_and_nothing_else() {
        let mut plain = report(true);
        assert!(plain.contains("\u{1b}[32mConfirmed\u{1b}[0m *"));
        assert!(plain.contains("\u{1b}[31mStalled\u{1b}[0m"));
        for code in [0, 1, 2, 31, 32, 33] {
            plain = plain.replace(&format!("\u{1b}[{code}m"), "");
        }
        assert_eq!(plain, report(false));
    }

    #[test]
    fn lines_fit_80_columns() {
        let mut long = entry("monte-carlo-independent", "trapezoid");
        long.note = Some("pairwise orders 6.00 5.53 4.97 ".repeat(9));
        long.verdict = Verdict::PreAsymptotic;
        long.window = Some((1024, 65536));
        let text = reproduction(&[long], 80, false);
        assert!(text.lines().all(|l| l.chars().count() <= 80), "{text}");
    }

    #[test]
    fn words_wrap_with_an_indent() {
        assert_eq!(
            wrap("aa bb ccccccc d", 7, "* ", "  "),
            ["* aa bb", "  ccccccc", "  d"]
        );
        assert_eq!(wrap("", 7, "* ", "  "), ["* "]);
    }

    #[test]
    fn nothing_is_a_report_too() {
        assert_eq!(reproduction(&[], 0, true), "0 entries\n");
    }
}

//! The list of cases: a line a channel.

use crate::cli::case::{Loaded, value};
use rug::Float;
use std::collections::BTreeSet;
use std::fmt::Write;
use volver::case::Case;
use volver::case::manufacture::{Manufactured, Outcome};
use volver::reference::ReferenceError;
use volver::report::text::wrap;

/// Tags in fewer columns would say nothing.
const NARROWEST_TAGS: usize = 8;

/// All tags.
pub(super) fn tags<'a>(of_cases: impl Iterator<Item = &'a [String]>) -> BTreeSet<&'a str> {
    of_cases.flatten().map(String::as_str).collect()
}

struct Row<'a> {
    cells: [String; 5],
    tags: &'a [String],
    open: Vec<String>,
}

/// The cases in lines of at most `width` columns; tags that do not fit are cut.
pub(super) fn render(loaded: &[Loaded], wanted: &[String], width: usize) -> String {
    let mut text = String::new();
    if loaded.is_empty() {
        let _ = writeln!(text, "no case has all of these tags: {}", wanted.join(", "));
        return text;
    }
    let rows: Vec<Row<'_>> = loaded
        .iter()
        .flat_map(|l| l.cases.iter().map(move |case| row(l, case)))
        .collect();
    let head = ["case", "D", "t(D)", "I(D)", "state"].map(String::from);
    let widths = [0, 1, 2, 3, 4].map(|column| {
        let cells = std::iter::once(&head).chain(rows.iter().map(|row| &row.cells));
        let widths = cells.filter_map(|cells| cells.get(column)).map(String::len);
        widths.max().unwrap_or(0)
    });
    let room = width.saturating_sub(widths.iter().sum::<usize>() + 2 * widths.len());
    let _ = writeln!(text, "{}", line(&head, &widths, "tags", room));
    let count = |tag: &str| {
        let with = loaded.iter().map(|l| &l.description.tags);
        with.filter(|tags| tags.iter().any(|t| t == tag)).count()
    };
    for row in &rows {
        let tags = fitting(row.tags, room, count);
        let _ = writeln!(text, "{}", line(&row.cells, &widths, &tags, room));
        for open in &row.open {
            for part in wrap(open, width, "    ", "      ") {
                let _ = writeln!(text, "{part}");
            }
        }
    }
    text.push('\n');
    let proved = rows.iter().filter(|row| row.open.is_empty()).count();
    let _ = writeln!(
        text,
        "{} cases, {} channels; every statement is proved for {proved}",
        loaded.len(),
        rows.len(),
    );
    let all = tags(loaded.iter().map(|l| &l.description.tags[..]));
    let all: Vec<&str> = all.into_iter().collect();
    for part in wrap(&all.join(", "), width, "tags: ", "      ") {
        let _ = writeln!(text, "{part}");
    }
    text
}

fn row<'a>(loaded: &'a Loaded, case: &Manufactured) -> Row<'a> {
    let open = case.checks.iter().filter(|c| c.outcome != Outcome::Proved);
    let state = match (case.has_closed_form(), case.is_proved()) {
        (false, _) => "by reference",
        (true, true) => "proved",
        (true, false) => "open",
    };
    Row {
        cells: [
            case.case.name().into(),
            value::rational(&case.case.length()),
            shown(value::total_depth(case)),
            shown(value::radiance(case)),
            state.into(),
        ],
        tags: &loaded.description.tags,
        open: open
            .map(|check| format!("{}: {}", check.statement, value::outcome(&check.outcome)))
            .collect(),
    }
}

fn shown(value: Result<Float, ReferenceError>) -> String {
    value.map_or("-".into(), |value| value::decimal(&value))
}

/// Names to the left, numbers to the right.
fn line(cells: &[String; 5], widths: &[usize; 5], tags: &str, room: usize) -> String {
    let [name, numbers @ .., state] = cells;
    let [name_width, number_widths @ .., state_width] = widths;
    let mut line = format!("{name:<name_width$}");
    for (number, width) in numbers.iter().zip(number_widths) {
        let _ = write!(line, "  {number:>width$}");
    }
    let _ = write!(line, "  {state:<state_width$}");
    if room >= NARROWEST_TAGS {
        let _ = write!(line, "  {tags}");
    }
    line.truncate(line.trim_end().len());
    line
}

/// The tags, the rarest and so the most telling first, cut where there is no more room.
fn fitting(tags: &[String], room: usize, count: impl Fn(&str) -> usize) -> String {
    let mut tags: Vec<&str> = tags.iter().map(String::as_str).collect();
    tags.sort_by_key(|tag| count(tag));
    let all = tags.join(", ");
    if all.chars().count() <= room {
        return all;
    }
    let cut: String = all.chars().take(room.saturating_sub(1)).collect();
    format!("{}…", cut.trim_end_matches([',', ' ']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rare_tags_come_first_and_what_is_too_wide_is_cut() {
        let tags = ["smooth", "thin", "paper"].map(String::from);
        let count = |tag: &str| if tag == "smooth" { 3 } else { 1 };
        let fitting = |room| fitting(&tags, room, count);
        assert_eq!(fitting(19), "thin, paper, smooth");
        assert_eq!(fitting(18), "thin, paper, smoo…");
        assert_eq!(fitting(13), "thin, paper…");
        assert_eq!(fitting(8), "thin, p…");
    }
}

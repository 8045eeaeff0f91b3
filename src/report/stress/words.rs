//! The words that the reports share.

use crate::study::stress::{Cell, Digits, Verdict};

/// How to read a figure.
pub(super) const FIGURES: &str = "7/3: 7 digits of what the method gives without rounding, 3 of the exact \
radiance; = all of them, more than 17; ? unknown; ! fewer than promised, and nothing says so";

/// More digits than binary64 has.
const ALL: f64 = 17.0;

/// "fix15", "e4m3": formats by short names.
pub(super) fn short(format: &str) -> String {
    format.replace("fixed:", "fix").replace("fp8-", "")
}

/// "7/3", or the code of a verdict.
pub(super) fn figure(cell: &Cell) -> String {
    if let Some(verdict) = cell.verdict {
        return verdict.code().into();
    }
    let mark = if cell.is_silently_wrong() { "!" } else { "" };
    format!(
        "{}/{}{mark}",
        whole(cell.digits),
        whole(cell.against_radiance)
    )
}

/// Whole digits.
pub(in crate::report) fn whole(digits: Option<Digits>) -> String {
    match digits {
        None => "?".into(),
        Some(Digits::Exact) => "=".into(),
        Some(Digits::Of(digits)) if digits >= ALL => "=".into(),
        Some(Digits::Of(digits)) => format!("{:.0}", digits.floor()),
    }
}

/// The verdicts that occur.
pub(super) fn occurring(cells: &[Cell]) -> impl Iterator<Item = Verdict> {
    let found = |verdict: &Verdict| cells.iter().any(|cell| cell.verdict == Some(*verdict));
    Verdict::ALL.into_iter().filter(found)
}

/// "99 cells: 70 have the digits promised, 29 a verdict, 0 are silently wrong".
pub(super) fn summary(cells: &[Cell]) -> String {
    let judged = cells.iter().filter(|cell| cell.verdict.is_some()).count();
    let wrong = cells.iter().filter(|cell| cell.is_silently_wrong()).count();
    format!(
        "{} cells: {} have the digits promised, {judged} a verdict, {wrong} are silently wrong",
        cells.len(),
        cells.len() - judged - wrong
    )
}

/// In one line: a cell that is silently wrong.
pub(super) fn accusation(cell: &Cell) -> String {
    format!(
        "{} by {} in {}, n = {}: {} digits where {:.1} are promised, and no verdict",
        cell.scenario,
        cell.method,
        cell.format,
        cell.n,
        match cell.digits {
            Some(Digits::Of(digits)) => format!("{digits:.1}"),
            other => whole(other),
        },
        cell.promised
    )
}

/// What was left out and why, once each.
pub(super) fn omissions(cells: &[Cell]) -> Vec<String> {
    let mut reasons: Vec<(String, usize)> = Vec::new();
    let left_out = |cell: &&Cell| cell.verdict == Some(Verdict::LeftOut);
    for reason in cells
        .iter()
        .filter(left_out)
        .filter_map(|c| c.reason.clone())
    {
        match reasons.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, count)) => *count += 1,
            None => reasons.push((reason, 1)),
        }
    }
    let line = |(reason, count)| format!("left out {count}: {reason}");
    reasons.into_iter().map(line).collect()
}

//! The words that the reports share.

use crate::method::Expected;
use crate::study::nonsmooth::Cell;

/// What stands where there is no figure.
const NONE: &str = "-";

/// "2.003 ± 0.021".
pub(super) fn order(cell: &Cell) -> String {
    match (cell.measured.order, cell.measured.half_width) {
        (Some(order), Some(half_width)) => format!("{order:.3} ± {half_width:.3}"),
        _ => NONE.into(),
    }
}

/// The order by theory.
pub(super) fn theory(expected: Expected) -> String {
    match expected {
        Expected::Order(order) => format!("{order}"),
        Expected::Blind { here, .. } => format!("{here}"),
        Expected::Exact => "exact".into(),
        Expected::Unknown => "?".into(),
    }
}

/// What a ladder of doublings shows: "0.52 Oscillatory".
pub(super) fn usual(cell: &Cell) -> String {
    let order = cell.usual.order.map_or(NONE.into(), |p| format!("{p:.2}"));
    format!("{order} {}", cell.usual.verdict)
}

/// "36 cells: 36 agree with theory".
pub(super) fn summary(cells: &[Cell]) -> String {
    let bad = cells
        .iter()
        .filter(|cell| cell.contradicts_theory())
        .count();
    let good = cells.len() - bad;
    let contradict = match bad {
        0 => String::new(),
        _ => format!(", {bad} contradict it"),
    };
    format!(
        "{} cells: {good} agree with theory{contradict}",
        cells.len()
    )
}

/// A cell that contradicts theory, in words.
pub(super) fn contradiction(cell: &Cell) -> String {
    format!(
        "{}, {} {}: {} where theory says {} ({})",
        cell.rule,
        cell.kind.title().to_lowercase(),
        cell.place.title(),
        order(cell),
        theory(cell.theory),
        cell.measured.verdict
    )
}

/// What the table says, and why; a word and its meaning each.
pub(super) const LEGEND: [(&str, &str); 5] = [
    (
        "order",
        "of the root mean square error over 2, 4 or (where the break moves) 16 neighbouring n a level, from n = 64, 128 … 2048 on; [theory]",
    ),
    (
        "doublings",
        "what the usual ladder n = 8, 16 … 2048 shows, with its verdict",
    ),
    (
        "off the nodes",
        "one segment holds the break and errs by c·d for a jump, c·d² for a kink, whatever the rule. c depends \
         on the place in the segment, so that doublings see it scatter or alternate",
    ),
    (
        "on a node",
        "no segment holds the break: rules keep their order, except that at a jump the node's one value \
         is wrong for one side, which costs closed rules all but order 1",
    ),
    (
        "simpson, D/3",
        "c = 0 for a kink at a third and at two thirds: order 3 there, and 2 elsewhere",
    ),
];

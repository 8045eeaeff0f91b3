//! The table of a study for a paper.

use super::words::{best, crossing, exponent, order, theory};
use crate::document::{Cell, Column, Table};
use crate::study::sweep::Results;

/// A row a case, method and format; the formats of a sweep are left out.
pub(super) fn table(results: &Results) -> Table {
    let columns = [
        Column::text("case").grouping(),
        Column::text("method").grouping(),
        Column::text("format"),
        Column::text("p"),
        Column::text("theory"),
        Column::text("q arithmetic"),
        Column::text("q input"),
        Column::number("n*"),
        Column::number("best"),
    ];
    let groups = results.groups();
    let rows = groups.flat_map(|(case, method, lines)| {
        lines.into_iter().filter_map(move |line| {
            let split = line.summary.split.as_ref()?;
            let cells = [
                case.to_string(),
                method.to_string(),
                line.format.clone(),
                order(&split.discretization),
                theory(line.row.expected),
                exponent(split.laws.arithmetic),
                exponent(split.laws.input),
                crossing(line),
                best(line),
            ];
            Some(cells.map(Cell::text).into())
        })
    });
    let caption = "The order p of the discretization, and how roundoff grows with n";
    Table::new(caption, columns).with(rows)
}

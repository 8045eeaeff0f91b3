//! Every level, for tables and plots elsewhere.

use crate::document::{Cell, Column, Table};
use crate::study::sweep::{LevelRecord, Line, Results, State};
use rug::Float;

const COLUMNS: [&str; 15] = [
    "case",
    "method",
    "format",
    "bits",
    "n",
    "state",
    "total",
    "discretization",
    "truncation",
    "input_rounding",
    "arithmetic_rounding",
    "of_transmittances",
    "resolution",
    "oracle_bits",
    "reason",
];

/// A row a case, method, format and n. A part that is not known is empty; numbers have twenty digits.
pub(super) fn table(results: &Results) -> Table {
    let rows = results.lines.iter().flat_map(|line| {
        let levels = line.row.levels.iter();
        levels.map(move |level| record(line, level))
    });
    Table::new("All levels", COLUMNS.map(Column::text))
        .named("study")
        .with(rows)
}

fn record(line: &Line, level: &LevelRecord) -> Vec<Cell> {
    let number = |x: &Option<Float>| {
        let digits = x.as_ref().map(|x| x.to_string_radix(10, Some(20)));
        digits.unwrap_or_default()
    };
    let reason = match &level.state {
        State::Refused(reason) => reason.as_str(),
        _ => "",
    };
    let bits = level.oracle_bits.map(|bits| bits.to_string());
    let cells: [String; COLUMNS.len()] = [
        line.case.clone(),
        line.row.method.clone(),
        line.format.clone(),
        line.bits.to_string(),
        level.n.to_string(),
        level.state.name().into(),
        number(&level.total),
        number(&level.discretization),
        number(&level.truncation),
        number(&level.input),
        number(&level.arithmetic),
        number(&level.of_depth),
        number(&level.resolution),
        bits.unwrap_or_default(),
        reason.into(),
    ];
    cells.map(Cell::text).into()
}

//! Every run, for tables and plots elsewhere.

use crate::document::{Cell, Column, Table};
use crate::study::tradeoff::{CaseResults, Outcome, Point, Results, Unit};

const COLUMNS: [&str; 17] = [
    "case",
    "method",
    "format",
    "bits",
    "n",
    "state",
    "error",
    "evaluations",
    "operations",
    "transcendentals",
    "modelled_ns",
    "measured_ns",
    "spread_ns",
    "repeats",
    "on_front",
    "only_usual",
    "reason",
];

/// A row a run. What is not known is empty; errors have twenty digits.
pub(super) fn table(results: &Results) -> Table {
    let mut table = Table::new("All runs", COLUMNS.map(Column::text)).named("tradeoff");
    for case in &results.cases {
        let front = case.front(results.cost);
        for unit in &case.units {
            for point in &unit.points {
                let on_front = front.iter().any(|(_, other)| std::ptr::eq(*other, point));
                table.rows.push(record(case, unit, point, on_front));
            }
        }
    }
    table
}

fn record(case: &CaseResults, unit: &Unit, point: &Point, on_front: bool) -> Vec<Cell> {
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.1}"));
    let error = match point.outcome.error() {
        Some(error) if error.is_zero() => "0".into(),
        Some(error) => error.to_string_radix(10, Some(20)),
        None => String::new(),
    };
    let reason = match &point.outcome {
        Outcome::Refused { reason } => reason.clone(),
        _ => String::new(),
    };
    let timing = point.measured;
    let cells: [String; COLUMNS.len()] = [
        case.name.clone(),
        point.method.name(),
        unit.format.to_string(),
        unit.bits.to_string(),
        point.n.to_string(),
        point.outcome.name().into(),
        error,
        point.counts.evaluations().to_string(),
        point.counts.operations().to_string(),
        point.counts.transcendentals().to_string(),
        number(point.modelled),
        number(timing.map(|timing| timing.median)),
        number(timing.map(|timing| timing.spread)),
        timing.map_or(String::new(), |timing| timing.repeats.to_string()),
        on_front.to_string(),
        point.only_usual.to_string(),
        reason,
    ];
    cells.map(Cell::text).into()
}

//! Errors as a whole: orders without the parts that errors are made of.

use super::words::{judged, order, theory};
use crate::document::{Axis, Cell, Column, Plot, Point, Stroke, Table};
use crate::report::plots::{FLAT, Level, curve, gap, key, log10_abs, slope, trace};
use crate::study::sweep::{LevelRecord, Line, Results, State};
use rug::Float;

/// What verdicts are on.
pub(super) const SAID: &str = "The verdicts above are on the order of the whole error, a line a case, method and format. Errors are not split: how roundoff grows, n*, the least error and the bits for a tolerance need --errors split and are left out.";

/// What the table says; a word and its meaning each.
pub(super) const LEGEND: [(&str, &str); 2] = [
    (
        "total",
        "order of the whole error Q − I in the format, with its interval and verdict on theory; ~ is the last pair's, without an interval",
    ),
    (
        "floor",
        "what of an error may be rounding, foreseen: u √n of what is summed, u n where terms have few bits below the sum; errors of up to 30 times as much tell no order",
    ),
];

const ERROR: &str = "|error|";

/// Orders, a row a format.
pub(super) fn table(lines: &[&Line]) -> Table {
    let columns = [
        Column::text("format"),
        Column::number("total"),
        Column::verdict("verdict"),
    ];
    let rows = lines.iter().map(|line| {
        let total = &line.summary.total;
        vec![
            Cell::text(&line.format),
            Cell::number(order(total), total.order),
            Cell::verdict(total.verdict.name(), judged(line)),
        ]
    });
    Table::new("Orders, a row a format", columns).with(rows)
}

/// The table for a paper: a row a case, method and format; the formats of a sweep are left out.
pub(super) fn paper(results: &Results) -> Table {
    let columns = [
        Column::text("case").grouping(),
        Column::text("method").grouping(),
        Column::text("format"),
        Column::text("p"),
        Column::text("theory"),
        Column::text("verdict"),
    ];
    let rows = results.groups().flat_map(|(case, method, lines)| {
        lines.into_iter().map(move |line| {
            let total = &line.summary.total;
            let cells = [
                case.to_string(),
                method.to_string(),
                line.format.clone(),
                order(total),
                theory(line.row.expected),
                total.verdict.name().into(),
            ];
            cells.map(Cell::text).into()
        })
    });
    Table::new("The order p of the whole error", columns).with(rows)
}

/// A row a case, method, format and n, for tables and plots elsewhere; numbers have twenty digits.
pub(super) fn levels(results: &Results) -> Table {
    let columns = [
        "case", "method", "format", "bits", "n", "state", "total", "floor", "reason",
    ];
    let rows = results.lines.iter().flat_map(|line| {
        let levels = line.row.levels.iter();
        levels.map(move |level| record(line, level))
    });
    Table::new("All levels", columns.map(Column::text))
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
    let cells = [
        line.case.clone(),
        line.row.method.clone(),
        line.format.clone(),
        line.bits.to_string(),
        level.n.to_string(),
        level.state.name().into(),
        number(&level.total),
        number(&level.floor),
        reason.into(),
    ];
    cells.map(Cell::text).into()
}

/// The error against n, a plot a format, with its floor and a line of the order that was fitted.
pub(super) fn plots(lines: &[&Line]) -> Vec<Plot> {
    lines.iter().map(|line| plot(line)).collect()
}

fn plot(line: &Line) -> Plot {
    let fit = &line.summary.total;
    let in_fit = |n: u64| {
        fit.window.is_some_and(|window| {
            window.coarsest_n.is_some_and(|first| first <= n)
                && window.finest_n.is_some_and(|last| n <= last)
        })
    };
    let levels = line.row.levels.iter().filter(|level| level.n > 0);
    let mark = |level: &LevelRecord| {
        let at = Level::of_n(level.n);
        let total = level.total.as_ref();
        total.map_or_else(gap, |total| at.mark(total, in_fit(level.n), ERROR))
    };
    let points: Vec<Point> = levels.clone().map(mark).collect();
    let floor = levels.filter_map(|level| {
        let floor = log10_abs(level.floor.as_ref()?)?;
        Some((Level::of_n(level.n).x, floor))
    });
    let floor = trace(Stroke::Dotted, floor);
    let fitted = fit.order.filter(|_| fit.window.is_some());
    let slope = slope(&points, fitted);
    let name = match fitted.filter(|order| order.abs() >= FLAT) {
        Some(order) => format!("total {order:.2}"),
        None => "total".into(),
    };
    let axes = (Axis::log("segments n"), Axis::log(ERROR));
    let mut plot = Plot::new(&line.format, axes.0, axes.1).keyed(key("fitted order"));
    if points.iter().any(|point| point.y.is_finite()) {
        plot.series = vec![curve(name, points, [slope, floor])];
    }
    plot
}

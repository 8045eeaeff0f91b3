//! A table of orders as plots.

use super::{Group, Row};
use crate::convergence::Verdict;
use crate::document::{Axis, Plot, Point, Series, Stroke};
use crate::report::plots::{Level, curve, key, legend, log10_abs, slope, trace};
use crate::study::reproduce::Entry;

/// A plot for every row of a table, in it a curve a column. With replicas the curve is their standard deviation, and |bias|
/// is dashed.
#[must_use]
pub fn of_table(group: &Group<'_>) -> Vec<Plot> {
    let (axis, _) = group.table.axes();
    let columns = group.columns();
    let rows = group.rows.iter();
    rows.map(|row| plot(row, axis, &columns)).collect()
}

fn plot(row: &Row<'_>, axis: &str, columns: &[&str]) -> Plot {
    let replicas = row
        .entries
        .iter()
        .find_map(|entry| Some((entry.replicas?, &entry.format)));
    let (title, error) = match replicas {
        Some((replicas, format)) => (
            format!("{axis}: {} ({replicas} replicas, {format})", row.name),
            "standard deviation of error",
        ),
        None => (format!("{axis}: {}", row.name), "|error|"),
    };
    let mut plot =
        Plot::new(title, Axis::log("segments n"), Axis::log(error)).keyed(key("fitted order"));
    plot.series = row
        .entries
        .iter()
        .map(|entry| {
            let color = columns.iter().position(|column| *column == entry.column);
            series(entry, error).colored(color.unwrap_or(0))
        })
        .collect();
    plot
}

fn series(entry: &Entry, axis: &str) -> Series {
    let levels = || entry.levels.iter().filter(|level| level.n > 0);
    // A stalled entry with replicas has the order of its bias, which is not the curve drawn.
    let is_of_marks = entry.replicas.is_none() || entry.verdict != Verdict::Stalled;
    let window = entry.window.filter(|_| is_of_marks);
    let in_window = |n: u64| window.is_some_and(|(first, last)| (first..=last).contains(&n));
    let points: Vec<Point> = levels()
        .map(|level| Level::of_n(level.n).mark(&level.error, in_window(level.n), axis))
        .collect();
    let x = |n: u64| Level::of_n(n).x;
    let bias = levels().filter_map(|level| {
        let log = level.bias?.abs().log10();
        log.is_finite().then_some((x(level.n), log))
    });
    let floor = levels().filter_map(|level| Some((x(level.n), log10_abs(&level.floor)?)));
    let order = entry.asymptotic_order;
    let traces = [
        slope(&points, order),
        trace(Stroke::Dashed, bias),
        trace(Stroke::Dotted, floor),
    ];
    curve(legend(entry.column, order, entry.verdict), points, traces)
}

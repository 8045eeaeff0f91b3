//! The cheapest ways and the front, as tables.

use super::words::{error, goal, range, runs, time_of, usual, way};
use crate::document::{Cell, Column, Table};
use crate::study::tradeoff::{CaseResults, Cost, Results};

/// Goal by goal.
pub(super) fn goals(case: &CaseResults, cost: Cost) -> Table {
    let columns = [
        Column::logarithm("error"),
        Column::text("method"),
        Column::text("format"),
        Column::number("n"),
        Column::number("evaluations"),
        Column::number("operations"),
        Column::number("time"),
        Column::text("usual"),
    ];
    let goals = case.goals(cost);
    let reached = goals.iter().map_while(|goal| Some((goal, goal.best?)));
    let rows = reached.map(|(of, best)| {
        let (_, point) = best;
        let [method, format, n, evaluations, operations, time] = way(best, cost);
        vec![
            Cell::number(goal(of), -f64::from(of.digits)),
            Cell::text(method),
            Cell::text(format),
            Cell::number(n, point.n as f64),
            Cell::number(evaluations, point.counts.evaluations() as f64),
            Cell::number(operations, point.counts.operations() as f64),
            Cell::number(time, cost.of(point)),
            Cell::text(usual(of, cost)),
        ]
    });
    let caption = "The cheapest way to an error, and what the usual choice costs for it";
    Table::new(caption, columns).with(rows)
}

/// The same with one row for goals that are reached in one way, and one cost beside the evaluations.
pub(super) fn cheapest(case: &CaseResults, cost: Cost) -> Table {
    let by_operations = matches!(cost, Cost::Operations);
    let last = if by_operations { "operations" } else { "time" };
    let columns = [
        Column::text("error"),
        Column::text("method"),
        Column::text("format"),
        Column::number("n"),
        Column::number("eval."),
        Column::number(last),
        Column::text("usual"),
    ];
    let goals = case.goals(cost);
    let runs = runs(&goals).into_iter();
    let rows = runs.filter_map(|(first, last)| {
        let [method, format, n, evaluations, operations, time] = way(last.best?, cost);
        let last_cost = if by_operations { operations } else { time };
        let range = range((first, last));
        let usual = usual(first, cost);
        let cells = [range, method, format, n, evaluations, last_cost, usual];
        Some(cells.map(Cell::text).into())
    });
    Table::new("The cheapest way to an error", columns).with(rows)
}

/// From cheap to exact.
pub(super) fn front(case: &CaseResults, cost: Cost) -> Table {
    let columns = [
        Column::text("method"),
        Column::text("format"),
        Column::number("n"),
        Column::number("evaluations"),
        Column::number("time"),
        Column::logarithm("error"),
    ];
    let front = case.front(cost).into_iter();
    let rows = front.map(|(unit, point)| {
        let evaluations = point.counts.evaluations();
        vec![
            Cell::text(point.method.name()),
            Cell::text(unit.format.to_string()),
            Cell::number(point.n.to_string(), point.n as f64),
            Cell::number(evaluations.to_string(), evaluations as f64),
            Cell::number(time_of(point, cost), cost.of(point)),
            Cell::number(error(point), point.outcome.log10()),
        ]
    });
    Table::new("On the Pareto front, from cheap to exact", columns).with(rows)
}

/// The table for a paper.
pub(super) fn paper(results: &Results) -> Table {
    let columns = [
        Column::text("case").grouping(),
        Column::number("error"),
        Column::text("method"),
        Column::text("format"),
        Column::number("n"),
        Column::number("evaluations"),
        Column::number("time"),
        Column::text("usual"),
    ];
    let cost = results.cost;
    let rows = results.cases.iter().flat_map(|case| {
        let goals = case.goals(cost).into_iter();
        let reached = goals.map_while(|goal| Some((goal, goal.best?)));
        reached.map(move |(of, best)| {
            let [method, format, n, evaluations, _, time] = way(best, cost);
            let (case, usual) = (case.name.clone(), usual(&of, cost));
            let cells = [case, goal(&of), method, format, n, evaluations, time, usual];
            cells.map(Cell::text).into()
        })
    });
    Table::new(format!("The cheapest way to an error, by {cost}"), columns).with(rows)
}

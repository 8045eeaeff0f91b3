//! The report as a page.

use super::words::{error, figure_file, goal, model, relative, states, unreached, usual, way};
use crate::document::{
    self, About, Axis, Block, Cell, Column, Document, Fact, Plot, Point, Section, Series, Table,
};
use crate::study::tradeoff::{CaseResults, Cost, Point as Run, Results, Unit, standings};
use std::collections::BTreeMap;

/// What [`markdown`](super::markdown()) says, with tables that sort and plots that answer.
#[must_use]
pub fn page(results: &Results, about: &About) -> Document {
    let mut page = Document::new("tradeoff", "Error against cost", about.clone());
    let header = &results.header;
    page.summary = vec![
        Fact::new("cases", results.cases.len().to_string()),
        Fact::new("methods", header.methods.len().to_string()),
        Fact::new("formats", header.formats.len().to_string()),
        Fact::new("levels", header.levels.len().to_string()),
    ];
    let mut run = Section::new("run", "What was run");
    let levels: Vec<String> = header.levels.iter().map(ToString::to_string).collect();
    run.blocks.push(Block::Facts(vec![
        Fact::new("cost", results.cost.to_string()),
        Fact::new("methods", header.methods.join("; ")),
        Fact::new("formats", header.formats.join("; ")),
        Fact::new("levels n", levels.join(", ")),
    ]));
    for line in model(results) {
        run.blocks.push(Block::Text(line));
    }
    run.blocks.push(Block::Table(fronts(results)));
    page.sections.push(run);
    for (index, case) in results.cases.iter().enumerate() {
        let file = figure_file(results, index);
        let file = file.trim_end_matches(".svg");
        page.sections.push(section(file, case, results.cost));
    }
    page
}

fn fronts(results: &Results) -> Table {
    let mut table = Table::new(
        "How often a method is on a Pareto front",
        [
            Column::text("method"),
            Column::text("format"),
            Column::number("cases"),
            Column::number("points"),
        ],
    );
    for standing in standings(results, results.cost) {
        table.rows.push(vec![
            Cell::text(standing.method.clone()),
            Cell::text(standing.format.clone()),
            Cell::number(standing.cases.to_string(), standing.cases as f64),
            Cell::number(standing.points.to_string(), standing.points as f64),
        ]);
    }
    table
}

fn section(file: &str, case: &CaseResults, cost: Cost) -> Section {
    let mut section = Section::new(&case.name, &case.name);
    let said = format!("{}; {}.", states(case), relative(case));
    section.blocks.push(Block::Text(said));
    let title = format!("{}: error against {}", case.name, cost.label());
    let figure = document::Figure::new(file, title, [plot(case, cost)]);
    section.blocks.push(Block::Figure(figure));
    section.blocks.push(Block::Table(goals(case, cost)));
    if let Some(unreached) = unreached(&case.goals(cost)) {
        section.blocks.push(Block::Text(format!("{unreached}.")));
    }
    section
}

/// All runs of a format as marks, and the front as a line through its own.
fn plot(case: &CaseResults, cost: Cost) -> Plot {
    let mut plot = Plot::new(
        format!("{}: error against cost", case.name),
        Axis::log(cost.to_string()),
        Axis::log("error"),
    );
    let place = |unit: &Unit, point: &Run| {
        let (x, y) = (cost.of(point)?.log10(), point.outcome.log10()?);
        let hover = format!(
            "{} in {}, n = {}: error {}",
            point.method.name(),
            unit.format,
            point.n,
            error(point)
        );
        Some(Point::new(x, y, hover))
    };
    let mut formats: BTreeMap<(u32, String), Vec<Point>> = BTreeMap::new();
    for (unit, point) in case.points() {
        if let Some(placed) = place(unit, point) {
            let key = (unit.bits, unit.format.to_string());
            formats.entry(key).or_default().push(placed);
        }
    }
    for ((_, name), points) in formats {
        plot.series.push(Series::marks(name, points));
    }
    let front = case.front(cost).into_iter();
    let front = front.filter_map(|(unit, point)| Some(place(unit, point)?.filled()));
    plot.series.push(Series::line("Pareto front", front));
    plot
}

fn goals(case: &CaseResults, cost: Cost) -> Table {
    let mut table = Table::new(
        "The cheapest way to an error, and what the usual choice costs for it",
        [
            Column::logarithm("error"),
            Column::text("method"),
            Column::text("format"),
            Column::number("n"),
            Column::number("evaluations"),
            Column::number("operations"),
            Column::number("time"),
            Column::text("usual"),
        ],
    );
    let goals = case.goals(cost);
    for of in &goals {
        let Some(best) = of.best else { break };
        let (_, point) = best;
        let [method, format, n, evaluations, operations, time] = way(best, cost);
        table.rows.push(vec![
            Cell::number(goal(of), -f64::from(of.digits)),
            Cell::text(method),
            Cell::text(format),
            Cell::number(n, point.n as f64),
            Cell::number(evaluations, point.counts.evaluations() as f64),
            Cell::number(operations, point.counts.operations() as f64),
            Cell::number(time, cost.of(point)),
            Cell::text(usual(of, cost)),
        ]);
    }
    table
}

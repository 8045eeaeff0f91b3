//! The report as a document: GitHub Markdown with a plot a case.

use super::words::{
    error, figure_file, goal, model, relative, states, time_of, unreached, usual, way,
};
use crate::report::study::markdown::escape;
use crate::study::tradeoff::{CaseResults, Results, standings};
use std::fmt::{self, Write};

/// For every case its plot, the cheapest way to each error and the front; then how often methods are on one.
#[must_use]
pub fn markdown(results: &Results) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = document(results, &mut text);
    text
}

fn document(results: &Results, text: &mut String) -> fmt::Result {
    let header = &results.header;
    writeln!(text, "# Error against cost\n")?;
    let levels: Vec<String> = header.levels.iter().map(ToString::to_string).collect();
    writeln!(text, "| run | |\n|---|---|")?;
    for (what, value) in [
        ("volver", header.volver.clone()),
        ("methods", header.methods.join("; ")),
        ("formats", header.formats.join("; ")),
        ("levels n", levels.join(", ")),
        ("cost", results.cost.to_string()),
    ] {
        writeln!(text, "| {what} | {} |", escape(&value))?;
    }
    for line in model(results) {
        writeln!(text, "\n{}", escape(&line))?;
    }
    writeln!(
        text,
        "\n*Usual*: left Riemann sums with opacity 1 − e^(−τd) in binary32, `front-to-back/front/subtraction`; \
         *cannot*: at no n that was run.\n"
    )?;
    for (index, case) in results.cases.iter().enumerate() {
        section(results, index, case, text)?;
    }
    writeln!(text, "## On the Pareto fronts\n")?;
    writeln!(
        text,
        "| method | format | cases | points |\n|---|---|--:|--:|"
    )?;
    for standing in standings(results, results.cost) {
        let method = escape(&standing.method);
        let (cases, points) = (standing.cases, standing.points);
        writeln!(
            text,
            "| {method} | {} | {cases} | {points} |",
            standing.format
        )?;
    }
    Ok(())
}

fn section(results: &Results, index: usize, case: &CaseResults, text: &mut String) -> fmt::Result {
    let cost = results.cost;
    writeln!(text, "## {}\n", escape(&case.name))?;
    writeln!(
        text,
        "{}; {}.\n",
        escape(&states(case)),
        escape(&relative(case))
    )?;
    writeln!(
        text,
        "![Error against cost]({})\n",
        figure_file(results, index)
    )?;
    let goals = case.goals(cost);
    writeln!(
        text,
        "| error | method | format | n | evaluations | operations | time | usual |"
    )?;
    writeln!(text, "|--:|---|---|--:|--:|--:|--:|---|")?;
    for of in &goals {
        let Some(best) = of.best else { break };
        let cells = way(best, cost).map(|cell| escape(&cell));
        writeln!(
            text,
            "| {} | {} | {} |",
            goal(of),
            cells.join(" | "),
            usual(of, cost)
        )?;
    }
    if let Some(unreached) = unreached(&goals) {
        writeln!(text, "\n{}.", escape(&unreached))?;
    }
    writeln!(
        text,
        "\nThe front:\n\n| method | format | n | evaluations | time | error |"
    )?;
    writeln!(text, "|---|---|--:|--:|--:|--:|")?;
    for (unit, point) in case.front(cost) {
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} |",
            escape(&point.method.name()),
            unit.format,
            point.n,
            point.counts.evaluations(),
            time_of(point, cost),
            error(point)
        )?;
    }
    writeln!(text)
}

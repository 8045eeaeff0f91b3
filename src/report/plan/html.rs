//! A plan as a page.

use super::words::{because, bound, effort, left_out, medium, place, sum};
use crate::document::{
    self, About, Axis, Block, Cell, Column, Document, Fact, Guide, Plot, Point, Section, Series,
    Table, Tone,
};
use crate::study::plan::{Plan, Step};
use crate::symbolic::parse_number;

/// What [`markdown`](super::markdown()) says, with tables that sort, and how the bounds add up along the ray.
#[must_use]
pub fn page(plan: &Plan, about: &About) -> Document {
    let stored = plan.stored();
    let title = format!("The least model of {}", plan.scene().name());
    let mut page = Document::new("plan", title, about.clone());
    if let Some(checked) = &stored.checked {
        for channel in &checked.channels {
            let is_within = channel.error <= stored.tolerance;
            let tone = if is_within { Tone::Good } else { Tone::Bad };
            let name = format!("error {}", channel.channel);
            let value = format!("{:.1e}", channel.error);
            page.summary
                .push(Fact::new(name.trim_end(), value).toned(tone));
        }
    }
    let total = bound(stored.uncertainty.total());
    page.summary.push(Fact::new("bound", total));
    page.summary
        .push(Fact::new("tolerance", format!("{:e}", stored.tolerance)));
    let evaluations = stored.evaluations.to_string();
    page.summary.push(Fact::new("evaluations", evaluations));
    page.summary
        .push(Fact::new("format", stored.format.clone()));
    page.sections.push(steps(plan));
    if stored.checked.is_some() {
        page.sections.push(radiance(plan));
    }
    page
}

fn steps(plan: &Plan) -> Section {
    let stored = plan.stored();
    let mut section = Section::new("steps", "Steps, from front to back");
    let said = format!("{}. Error ≤ {}.", effort(stored), sum(stored));
    section.blocks.push(Block::Text(said));
    let mut table = Table::new(
        "What stands for each stretch of the ray, and what that may cost",
        [
            Column::number("step"),
            Column::text("medium"),
            Column::number("from"),
            Column::number("to"),
            Column::text("model"),
            Column::number("evaluations"),
            Column::text("left out"),
            Column::number("bound"),
            Column::text("T (ΔE + ΔT R)"),
        ],
    );
    for (i, step) in stored.steps.iter().enumerate() {
        table.rows.push(vec![
            Cell::number((i + 1).to_string(), (i + 1) as f64),
            Cell::text(medium(plan, step)),
            Cell::number(place(&step.from), number(&step.from)),
            Cell::number(place(&step.to), number(&step.to)),
            Cell::text(step.model.to_string()),
            Cell::number(
                step.model.evaluations().to_string(),
                f64::from(step.model.evaluations()),
            ),
            Cell::text(left_out(step)),
            Cell::number(bound(step.bound), step.bound),
            Cell::text(because(step)),
        ]);
    }
    section.blocks.push(Block::Table(table));
    section
        .blocks
        .push(Block::Figure(document::Figure::new("", "", [bounds(plan)])));
    if let Some(stop) = &stored.stop {
        let text = format!(
            "The ray may end at {}: nothing behind it matters.",
            place(stop)
        );
        section.blocks.push(Block::Text(text));
    }
    section
}

/// The part of the tolerance from which on bounds are drawn.
const LEAST: f64 = 1e-6;

/// The bound of each step, and what they have added up to.
fn bounds(plan: &Plan) -> Plot {
    let stored = plan.stored();
    let mut plot = Plot::new(
        "How the bounds add up along the ray",
        Axis::linear("λ"),
        Axis::log("bound of the error"),
    );
    let hover = |step: &Step, value: f64, what: &str| {
        format!(
            "{}: {}, {what} {}",
            medium(plan, step),
            step.model,
            bound(value)
        )
    };
    let mut so_far = 0.0;
    let mut sums = Vec::new();
    let mut own = Vec::new();
    for step in &stored.steps {
        so_far += step.bound;
        let (from, to) = (number(&step.from), number(&step.to));
        // Less is rounding, and would leave the rest no room.
        if step.bound > LEAST * stored.tolerance {
            let point = Point::new(
                f64::midpoint(from, to),
                step.bound.log10(),
                hover(step, step.bound, "error at most"),
            );
            own.push(point);
        }
        if so_far > LEAST * stored.tolerance {
            sums.push(Point::new(
                to,
                so_far.log10(),
                hover(step, so_far, "so far"),
            ));
        }
    }
    plot.series.push(Series::marks("of each step", own));
    plot.series.push(Series::line("so far", sums));
    plot.guides.push(Guide {
        upright: false,
        at: stored.tolerance.log10(),
        label: "tolerance".into(),
    });
    plot
}

fn radiance(plan: &Plan) -> Section {
    let mut section = Section::new("radiance", "The radiance");
    let mut table = Table::new(
        "The plan, run in its own format, beside the radiance to many digits",
        [
            Column::text("channel"),
            Column::text("radiance"),
            Column::text("exactly"),
            Column::number("error"),
        ],
    );
    for channel in plan
        .stored()
        .checked
        .iter()
        .flat_map(|checked| &checked.channels)
    {
        table.rows.push(vec![
            Cell::text(channel.channel.clone()),
            Cell::text(channel.radiance.clone()),
            Cell::text(channel.reference.clone()),
            Cell::number(format!("{:.1e}", channel.error), channel.error),
        ]);
    }
    section.blocks.push(Block::Table(table));
    section
}

fn number(exact: &str) -> f64 {
    parse_number(exact).map_or(f64::NAN, |q| q.to_f64())
}

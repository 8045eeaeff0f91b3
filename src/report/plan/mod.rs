//! The least model of a scene, and what came out of it.

mod json;
mod rendering;
mod words;

pub use json::json;
pub use rendering::Rendering;

use crate::document::{
    About, Axis, Block, Cell, Column, Conclusion, Document, Fact, Figure, Finding, Guide, Medium,
    Plot, Point, Section, Series, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::plan::{CheckedChannel, Plan, Step};
use crate::symbolic::parse_number;
use std::path::{Path, PathBuf};
use words::{because, bound, effort, left_out, medium, place, shortened, sum};

/// Steps that a terminal shows one by one.
const SHOWN: usize = 60;

/// What stands below the steps where bounds are explained.
const EXPLAINED: &str = "Below each step: what it leaves out, and its bound, T (ΔE + ΔT R).";

/// The part of the tolerance from which on bounds are drawn: less is rounding, and would leave the rest no room.
const LEAST: f64 = 1e-6;

/// The steps, what each leaves out and the bound of it, what the bounds add up to, and the radiance where the plan was run. A
/// terminal shows the arithmetic of every bound where that is to be explained.
#[must_use]
pub fn document(plan: &Plan, explain: bool, about: &About) -> Document {
    let stored = plan.stored();
    let name = plan.scene().name();
    let mut document = Document::new("plan", format!("The least model of {name}"), about.clone());
    let checked = || stored.checked.iter().flat_map(|checked| &checked.channels);
    let tone = |channel: &CheckedChannel| {
        let is_within = channel.error <= stored.tolerance;
        if is_within { Tone::Good } else { Tone::Bad }
    };
    let errors = checked().map(|channel| {
        let name = format!("error {}", channel.channel);
        Fact::new(name.trim_end(), error(channel)).toned(tone(channel))
    });
    let others = [
        ("bound", bound(stored.uncertainty.total())),
        ("tolerance", format!("{:e}", stored.tolerance)),
        ("evaluations", stored.evaluations.to_string()),
        ("format", stored.format.clone()),
    ];
    let others = others.map(|(name, value)| Fact::new(name, value));
    document.summary = errors.chain(others).collect();
    document.conclusion = Some(Conclusion {
        tone: checked().map(tone).min(),
        ..Conclusion::new(format!(
            "{name}: tolerance {:e}, {}, in {}",
            stored.tolerance,
            effort(stored),
            stored.format
        ))
    });
    let of_channels = checked().map(|channel| {
        let said = said(channel, tone(channel));
        Block::Finding(said).only(Medium::Terminal)
    });
    let table = stored.checked.iter().map(|_| radiance(checked()));
    let radiance = of_channels.chain(table);
    document.sections = vec![
        Section::of("steps", "Steps, from front to back", steps(plan, explain)),
        Section::of("radiance", "The radiance", radiance),
    ];
    document
}

/// Writes `plan.json`, `plan.md` and a page, `index.html`, into `dir`; see [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, plan: &Plan, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("plan.json".to_string(), json(plan)?)];
    write_document(dir, &document(plan, false, about), "plan", data)
}

fn steps(plan: &Plan, explain: bool) -> Vec<Block> {
    let stored = plan.stored();
    let caption = "How the bounds add up along the ray";
    let mut blocks = Vec::new();
    if explain {
        blocks.push(Block::Text(EXPLAINED.into()).only(Medium::Terminal));
    }
    blocks.extend([
        Block::Table(table(plan, explain)),
        Block::Figure(Figure::new("", caption, [bounds(plan, caption)])),
    ]);
    blocks.extend(stored.stop.iter().map(|stop| {
        let place = place(stop);
        Block::Text(format!(
            "The ray may end at {place}: nothing behind it matters."
        ))
    }));
    for medium in plan.scene().media() {
        blocks.extend(medium.unproved.iter().map(|note| {
            let words = format!("{note} could not be proved");
            Block::Finding(Finding::new(format!("medium {}", medium.name), words).toned(Tone::Open))
        }));
    }
    blocks.push(Block::Text(format!("Error ≤ {}.", sum(stored))));
    blocks
}

fn table(plan: &Plan, explain: bool) -> Table {
    let reason = |title| match Column::text(title) {
        column if explain => column.below(),
        column => column.detail(),
    };
    let columns = [
        Column::number("step").detail(),
        Column::text("medium"),
        Column::number("from"),
        Column::number("to"),
        Column::text("model"),
        Column::number("evaluations").detail(),
        Column::number("bound"),
        reason("left out"),
        reason("T (ΔE + ΔT R)"),
    ];
    let rows = plan.stored().steps.iter().zip(1_u32..).map(|(step, i)| {
        let evaluations = step.model.evaluations();
        vec![
            Cell::number(i.to_string(), f64::from(i)),
            Cell::text(medium(plan, step)),
            Cell::number(place(&step.from), number(&step.from)),
            Cell::number(place(&step.to), number(&step.to)),
            Cell::text(step.model.to_string()),
            Cell::number(evaluations.to_string(), f64::from(evaluations)),
            Cell::number(bound(step.bound), step.bound),
            Cell::text(left_out(step)),
            Cell::text(because(step)),
        ]
    });
    let caption = "What stands for each stretch of the ray, and what that may cost";
    Table::new(caption, columns).with(rows).at_most(SHOWN)
}

/// The bound of each step, and what they have added up to.
fn bounds(plan: &Plan, title: &str) -> Plot {
    let stored = plan.stored();
    let y = Axis::log("bound of the error");
    let mut plot = Plot::new(title, Axis::linear("λ"), y);
    let hover = |step: &Step, value: f64, what: &str| {
        format!(
            "{}: {}, {what} {}",
            medium(plan, step),
            step.model,
            bound(value)
        )
    };
    let is_drawn = |value: f64| value > LEAST * stored.tolerance;
    let mut so_far = 0.0;
    let (mut sums, mut own) = (Vec::new(), Vec::new());
    for step in &stored.steps {
        so_far += step.bound;
        let (from, to) = (number(&step.from), number(&step.to));
        if is_drawn(step.bound) {
            let label = hover(step, step.bound, "error at most");
            let middle = f64::midpoint(from, to);
            own.push(Point::new(middle, step.bound.log10(), label));
        }
        if is_drawn(so_far) {
            let label = hover(step, so_far, "so far");
            sums.push(Point::new(to, so_far.log10(), label));
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

/// A channel in one line.
fn said(channel: &CheckedChannel, tone: Tone) -> Finding {
    let verdict = match tone {
        Tone::Good => "within the tolerance",
        Tone::Open | Tone::Bad => "BEYOND the tolerance",
    };
    let words = format!(
        "{verdict}, error {}: {}, exactly {}",
        error(channel),
        shortened(&channel.radiance, &channel.reference),
        channel.reference
    );
    Finding::new(&channel.channel, words).toned(tone)
}

fn radiance<'a>(channels: impl Iterator<Item = &'a CheckedChannel>) -> Block {
    let columns = [
        Column::text("channel"),
        Column::text("radiance"),
        Column::text("exactly"),
        Column::number("error"),
    ];
    let rows = channels.map(|channel| {
        vec![
            Cell::text(&channel.channel),
            Cell::text(&channel.radiance),
            Cell::text(&channel.reference),
            Cell::number(error(channel), channel.error),
        ]
    });
    let caption = "The plan, run in its own format, beside the radiance to many digits";
    Block::Table(Table::new(caption, columns).with(rows)).only(Medium::Written)
}

fn error(channel: &CheckedChannel) -> String {
    format!("{:.1e}", channel.error)
}

fn number(exact: &str) -> f64 {
    parse_number(exact).map_or(f64::NAN, |q| q.to_f64())
}

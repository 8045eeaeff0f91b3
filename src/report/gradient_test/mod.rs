//! What anybody's Taylor remainders say of a gradient.

mod json;

pub use json::{json, schema};

use super::fit::by_level;
use crate::convergence::{Smoothness, Taylor};
use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Section, Table, Tone,
};

/// More levels are not shown: the finest are.
const MOST_LEVELS: usize = 1_000;

/// What they say, the parts of the remainder, then the levels.
#[must_use]
pub fn document(taylor: &Taylor, about: &About) -> Document {
    let mut document = Document::new("gradient-test", "Taylor remainders", about.clone());
    let tone = match taylor.smoothness {
        Smoothness::First | Smoothness::NotFinite => Tone::Bad,
        Smoothness::Unclear => Tone::Open,
        Smoothness::Second | Smoothness::Higher | Smoothness::Zero => Tone::Good,
    };
    document.summary = vec![Fact::new("remainder", taylor.smoothness.name()).toned(tone)];
    document.conclusion = Some(Conclusion::new(said(taylor)).toned(tone));
    document.sections = vec![
        Section::of("parts", "", [Block::Facts(facts(taylor))]),
        Section::of("levels", "", [Block::Table(levels(taylor))]),
    ];
    document
}

/// A sentence without a full stop.
fn said(taylor: &Taylor) -> String {
    match taylor.smoothness {
        Smoothness::Second => "second-order remainder: the gradient is right".into(),
        Smoothness::Higher => {
            "a remainder of more than second order: the gradient is right, and f has no curvature along v"
                .into()
        }
        Smoothness::Zero => "no remainder at all: the gradient is right, and f is linear along v".into(),
        Smoothness::First => match (taylor.wrong_by(), taylor.first) {
            (Some(part), _) => {
                format!("first-order remainder: the gradient is wrong by about {}", percent(part))
            }
            (None, Some(first)) => format!(
                "first-order remainder: g·v is off by about {first:.2e} (a third column |f(x + hv) − f(x)| or --slope says how much of it that is)"
            ),
            (None, None) => "first-order remainder: the gradient is wrong".into(),
        },
        Smoothness::NotFinite => "a remainder is NaN or infinite".into(),
        Smoothness::Unclear => format!(
            "no order shows ({}): more steps, or --floor where the finest are roundoff, may tell",
            taylor.fit.verdict
        ),
    }
}

/// "3 %", "0.012 %": two digits.
fn percent(part: f64) -> String {
    let percent = part * 100.0;
    if !(percent > 0.0 && percent.is_finite()) {
        return format!("{percent} %");
    }
    let places = 1.0 - percent.log10().floor();
    if !(0.0..=6.0).contains(&places) {
        return format!("{percent:.1e} %");
    }
    // From 0 to 6.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let rounded = format!("{percent:.*}", places as usize);
    let trimmed = if rounded.contains('.') {
        rounded.trim_end_matches('0').trim_end_matches('.')
    } else {
        &rounded
    };
    format!("{trimmed} %")
}

fn facts(taylor: &Taylor) -> Vec<Fact> {
    let fit = &taylor.fit;
    let order = match (fit.order, fit.half_width, fit.window) {
        (Some(order), Some(half_width), Some(_)) => format!("{order:.4} ± {half_width:.4}"),
        _ => "none".into(),
    };
    let mut facts = vec![Fact::new("order", order)];
    if let (Some(first), Some(second)) = (taylor.first, taylor.second) {
        let words = format!("{first:.3e} h + {second:.3e} h², signs unknown");
        facts.push(Fact::new("two powers", words));
    }
    if let Some(slope) = taylor.slope {
        facts.push(Fact::new("slope", format!("{slope:.6e}")));
    }
    let rounded = taylor.roundoff.and_then(|level| taylor.samples.get(level));
    if let Some(first) = rounded {
        let words = format!("from h = {:.3e}: steps there are left out", first.step);
        facts.push(Fact::new("roundoff", words));
    }
    let notes = fit.notes.iter().map(ToString::to_string);
    facts.extend(notes.map(|note| Fact::new("note", note)));
    facts
}

fn levels(taylor: &Taylor) -> Table {
    let columns = [
        Column::number("h"),
        Column::logarithm("remainder"),
        Column::number("order"),
        Column::text(""),
    ];
    let samples = &taylor.samples;
    let pairs = by_level(samples.len(), taylor.fit.pairs.iter().copied());
    let levels = samples.iter().enumerate().zip(pairs);
    let rows = levels.map(|((level, sample), pair)| {
        let size = sample.error.to_f64();
        let is_floor = taylor.roundoff.is_some_and(|first| level >= first);
        vec![
            Cell::number(format!("{:.4e}", sample.step), sample.step),
            Cell::number(format!("{size:.4e}"), size.log10()),
            pair.map_or_else(
                || Cell::text("-"),
                |pair| Cell::number(format!("{:.4}", pair.order), pair.order),
            ),
            Cell::text(if is_floor { "floor" } else { "" }),
        ]
    });
    let coarse = samples.len().saturating_sub(MOST_LEVELS);
    Table::new(
        "Remainders, and the order of each with the one before",
        columns,
    )
    .with(rows.skip(coarse))
}

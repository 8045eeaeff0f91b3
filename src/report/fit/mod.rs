//! An order of accuracy from anybody's errors, or values, and what it rests on.

mod json;

pub use json::{json, schema};

use crate::convergence::table::FloorSource;
use crate::convergence::{Fit, Pair, Sample, Verdict, Window};
use crate::document::{About, Block, Cell, Column, Document, Fact, Section, Table, Tone};
use crate::method::Expected;
use crate::real::{MpfrReal, Real};
use rug::Float;
use serde::Serialize;
use std::f64::consts::LOG10_2;

/// More levels are not shown one by one: the finest are.
const MOST_LEVELS: usize = 10_000;

/// A fit, and what it rests on.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The fit.
    pub fit: Fit,
    /// Its levels, coarse to fine.
    pub samples: Vec<Sample>,
    /// The order that was expected, where one was.
    pub expected: Option<Expected>,
    /// The order that has to be reached, where one was named.
    pub at_least: Option<f64>,
    /// Where the floor comes from.
    pub floor_source: FloorSource,
    /// Where the errors come from.
    pub source: Source,
}

impl Fitted {
    /// Whether the whole interval lies at or above the order that has to be reached; `None` where none was named.
    #[must_use]
    pub fn reaches(&self) -> Option<bool> {
        let least = self.at_least?;
        Some(
            match (self.fit.order, self.fit.half_width, self.fit.window) {
                (Some(order), Some(half_width), Some(_)) => {
                    self.fit.verdict.is_of_an_order() && order - half_width >= least
                }
                _ => false,
            },
        )
    }

    /// Whether every check that was asked for passes; `None` where none was.
    #[must_use]
    pub fn passes(&self) -> Option<bool> {
        let expected = self
            .expected
            .map(|_| self.fit.verdict.passes(self.expected));
        match (expected, self.reaches()) {
            (Some(first), Some(second)) => Some(first && second),
            (first, second) => first.or(second),
        }
    }
}

/// Where errors come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// They were given.
    Errors,
    /// They are values less the exact one.
    Exact,
    /// They are differences of values.
    Differences,
}

/// Order, window, floor and verdict, then the levels.
#[must_use]
pub fn document(fitted: &Fitted, about: &About) -> Document {
    let mut document = Document::new("fit", "Order of accuracy", about.clone());
    let tone = tone(fitted.fit.verdict);
    document.summary = vec![Fact::new("verdict", fitted.fit.verdict.name()).toned(tone)];
    let facts = Block::Facts(facts(fitted));
    let mut shown = Section::of("levels", "", [Block::Table(levels(fitted))]);
    let all = fitted.samples.len();
    if all > MOST_LEVELS {
        let said = format!("The finest {MOST_LEVELS} of {all} levels; --json has all of them.");
        shown.blocks.insert(0, Block::Text(said));
    }
    document.sections = vec![Section::of("fit", "", [facts]), shown];
    document
}

fn facts(fitted: &Fitted) -> Vec<Fact> {
    let fit = &fitted.fit;
    let window = fit.window.as_ref().map_or("none".to_string(), window);
    let mut facts = vec![Fact::new("order", order(fit)), Fact::new("window", window)];
    if let (Some(log2), Some(_)) = (fit.log2_constant, fit.window) {
        let constant = format!("{} in |e| = c d^p", power_of_two(log2));
        facts.push(Fact::new("constant", constant));
    }
    facts.push(Fact::new("floor", floor(fitted)));
    let expected = match fitted.expected {
        Some(Expected::Order(p)) => format!(" (expected {p})"),
        Some(Expected::Exact) => " (expected exact)".into(),
        Some(Expected::Blind { .. } | Expected::Unknown) | None => String::new(),
    };
    let verdict = format!("{}{expected}", fit.verdict);
    facts.push(Fact::new("verdict", verdict).toned(tone(fit.verdict)));
    if let (Some(least), Some(reaches)) = (fitted.at_least, fitted.reaches()) {
        let (said, tone) = if reaches {
            ("yes", Tone::Good)
        } else {
            ("no", Tone::Bad)
        };
        facts.push(Fact::new("at least", format!("{least}: {said}")).toned(tone));
    }
    let notes = fit.notes.iter().map(ToString::to_string);
    facts.extend(notes.map(|note| Fact::new("note", note)));
    facts
}

/// Without a window there is no order, only pairs.
fn order(fit: &Fit) -> String {
    match (fit.order, fit.half_width, fit.window) {
        (Some(order), Some(half_width), Some(_)) => format!("{order:.4} ± {half_width:.4}"),
        _ => "none".into(),
    }
}

fn window(window: &Window) -> String {
    let range = match (window.coarsest_n, window.finest_n) {
        (Some(coarsest), Some(finest)) => format!("n = {coarsest} to {finest}"),
        _ => format!(
            "step {:.4e} to {:.4e}",
            window.coarsest_step, window.finest_step
        ),
    };
    let levels = window.last + 1 - window.first;
    let within = (window.tolerance * 1000.0).ceil() / 1000.0;
    format!("{range}, {levels} levels, pairwise orders within {within}")
}

fn floor(fitted: &Fitted) -> String {
    let source = match fitted.floor_source {
        FloorSource::Column => "from the table",
        FloorSource::Given => "as given",
        FloorSource::Digits => "half a unit of the last digit",
        FloorSource::Unknown => return "unknown".into(),
    };
    let cut = match &fitted.fit.cut {
        Some(cut) => format!("; cuts from level {}", cut.level),
        None => String::new(),
    };
    format!("{} ({source}){cut}", short(&fitted.fit.floor))
}

/// A row a level: the order of a row is that of the pair with the level before.
fn levels(fitted: &Fitted) -> Table {
    let fit = &fitted.fit;
    let columns = [
        Column::number("level"),
        Column::number("n"),
        Column::number("step"),
        Column::logarithm("error"),
        Column::number("order"),
        Column::text(""),
    ];
    let pairs = by_level(fitted.samples.len(), fit.pairs.iter().copied());
    let levels = fitted.samples.iter().enumerate().zip(pairs);
    let coarse = fitted.samples.len().saturating_sub(MOST_LEVELS);
    let rows = levels.skip(coarse).map(|((level, sample), pair)| {
        let inside = fit
            .window
            .is_some_and(|w| (w.first..=w.last).contains(&level));
        let mark = match &fit.cut {
            Some(cut) if level >= cut.level => "floor",
            _ if inside => "window",
            _ => "",
        };
        let none = || Cell::text("-");
        vec![
            Cell::number(level.to_string(), level as f64),
            sample
                .n
                .map_or_else(none, |n| Cell::number(n.to_string(), n as f64)),
            Cell::number(format!("{:.4e}", sample.step), sample.step),
            Cell::number(short(&sample.error), log10(&sample.error)),
            pair.map_or_else(none, |p| Cell::number(format!("{:.4}", p.order), p.order)),
            Cell::text(mark),
        ]
    });
    Table::new("Levels, and the order of each with the one before", columns).with(rows)
}

/// The pair that each level ends, looking at each pair once: there may be millions of levels.
pub fn by_level(
    levels: usize,
    pairs: impl Iterator<Item = Pair>,
) -> impl Iterator<Item = Option<Pair>> {
    let mut pairs = pairs.peekable();
    (0..levels).map(move |level| pairs.next_if(|pair| pair.coarse + 1 == level))
}

/// Five significant digits, whatever the magnitude.
fn short(x: &Float) -> String {
    if x.is_zero() {
        "0".into()
    } else {
        x.to_string_radix(10, Some(5))
    }
}

/// Of errors below binary64's range too.
fn log10(x: &Float) -> f64 {
    MpfrReal::from(x.clone()).log2_abs() * LOG10_2
}

/// 2^log₂ with five significant digits; −6645 is 10^−2000, which binary64 does not hold.
fn power_of_two(log2: f64) -> String {
    short(&Float::with_val(64, log2).exp2())
}

/// What passes or is good news, what is inconclusive, and what is wrong.
fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Confirmed | Verdict::Fitted | Verdict::Exact => Tone::Good,
        Verdict::PreAsymptotic
        | Verdict::FloorLimited
        | Verdict::TooFewLevels
        | Verdict::Oscillatory
        | Verdict::Blind => Tone::Open,
        Verdict::TooLow
        | Verdict::TooHigh
        | Verdict::Stalled
        | Verdict::Diverged
        | Verdict::NotFinite => Tone::Bad,
    }
}

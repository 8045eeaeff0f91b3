//! Radiances to any number of digits.

mod json;

pub use json::{json, schema};

use super::cases::{decimal, decimal_of};
use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::document::{About, Block, Document, Fact, Section, Tone};
use crate::reference::{Reference, Source};
use rug::Float;

/// What was found of a channel.
#[derive(Clone, Debug)]
pub struct Found<'c> {
    /// The channel.
    pub case: &'c Manufactured,
    /// Its radiance.
    pub reference: Reference,
    /// |integral − closed form|, where both were asked for and exist.
    pub difference: Option<Difference>,
}

/// How far the integral is from a closed form.
#[derive(Clone, Debug)]
pub struct Difference {
    /// So far.
    pub amount: Float,
    /// Whether that is no more than both errors.
    pub is_within_errors: bool,
}

/// A section a channel, all `digits` of its value on one line.
#[must_use]
pub fn document(found: &[Found<'_>], digits: u32, about: &About) -> Document {
    let mut document = Document::new("reference", "Radiance to many digits", about.clone());
    document.sections = found.iter().map(|found| section(found, digits)).collect();
    document
}

fn section(found: &Found<'_>, digits: u32) -> Section {
    let reference = &found.reference;
    let value = decimal_of(&reference.value, digits as usize);
    let word = if reference.is_enclosed() {
        "proved"
    } else {
        "estimated"
    };
    let known = match reference.digits() {
        Some(0) => format!("{digits} asked for, none {word}"),
        Some(known) => format!("{digits} asked for, {known} {word}"),
        None => format!("exact, {word}"),
    };
    let from = source(reference.source);
    let from = match &reference.not_enclosed {
        None => Fact::new("source", from),
        Some(reason) => {
            Fact::new("source", format!("{from}, not proved: {reason}")).toned(Tone::Open)
        }
    };
    let mut facts = vec![
        Fact::new("I(D)", value),
        Fact::new(
            "error",
            format!("at most {}, {word}", decimal(&reference.error)),
        ),
        Fact::new("digits", known),
        from,
    ];
    if reference.source != Source::ClosedForm {
        let work = &reference.work;
        let grid = format!("{} panels, {} points", work.panels, work.points);
        let mut done = format!("{} evaluations of the medium", work.evaluations);
        if reference.source == Source::Spectral {
            let calls = work.transcendental_calls;
            done = format!("{done}, {calls} transcendental functions");
        }
        facts.extend([Fact::new("grid", grid), Fact::new("work", done)]);
    }
    if let Some(difference) = &found.difference {
        let (verdict, tone) = if difference.is_within_errors {
            ("within", Tone::Good)
        } else {
            ("beyond", Tone::Bad)
        };
        let amount = decimal(&difference.amount);
        let words = format!("{amount} to the closed form, {verdict} both errors");
        facts.push(Fact::new("difference", words).toned(tone));
    }
    let unproved = found.case.unproved().iter();
    facts.extend(unproved.map(|open| Fact::new("not proved", open.to_string()).toned(Tone::Open)));
    let name = found.case.case.name();
    Section::of(name, name, [Block::Facts(facts)])
}

/// What a source is called.
fn source(source: Source) -> &'static str {
    match source {
        Source::ClosedForm => "closed form",
        Source::Enclosure => "enclosure",
        Source::Spectral => "estimate",
    }
}

//! What a kernel reads of a volume: where its samples lie along the grid, and how grid and table are looked up.

mod deviating;
mod fit;
mod holdout;
pub(super) mod optics;

pub(super) use deviating::deviations;
pub(super) use holdout::hold_out;
pub(super) use optics::tabulated;
pub use optics::{Lookup, Optics};

use super::NotIdentified;
use super::free_places::{LEAST, THINNER, hides, lit};
use super::pose::{Made, Steps};
use super::session::Session;
use super::weights::Answers;
use crate::kernel::Volume;

/// The samples on one volume: the field is λ, and emission stands in one entry alone.
#[derive(Clone, Debug)]
struct Seen {
    volume: Volume,
    steps: Steps,
    /// The place of every sample among the entries, in order.
    entries: Vec<f64>,
    weights: Vec<f64>,
}

/// (n, cells, entries, length of the last segment by the others): numbers of entries such that samples lie between two.
const VOLUMES: [(usize, usize, usize, f64); 8] = [
    (8, 16, 64, 1.0),
    (8, 48, 58, 1.0),
    (8, 7, 51, 1.0),
    (8, 37, 64, 1.0),
    (6, 16, 58, 1.0),
    (8, 32, 64, 0.7),
    (5, 21, 51, 0.6),
    (1, 5, 64, 1.0),
];
const STEP: f64 = 0.25;
/// The optical depth of these rays.
const DEPTH: f64 = 0.5;

/// Reads off what is read of a volume.
pub(super) fn optics(
    session: &mut Session<'_>,
    answers: &Answers,
) -> Result<Optics, NotIdentified> {
    if answers.is_coarse() {
        return Err(NotIdentified::new(
            "answers have too few digits to tell places in a volume by",
        ));
    }
    let mut all = Vec::new();
    let mut depth = DEPTH;
    for volume in VOLUMES {
        let (n, _, _, last) = volume;
        if (last < 1.0 && session.divides) || !n.is_multiple_of(session.multiple) {
            continue;
        }
        all.push(seen(session, answers, volume, &mut depth)?);
    }
    fit::optics(&all, answers.unit).ok_or_else(|| {
        let rows = all.iter().flat_map(|seen| {
            let start = [
                seen.steps.segments as f64,
                seen.steps.length / seen.steps.step,
                seen.volume.cells() as f64,
                seen.volume.table.entries() as f64,
            ];
            let pairs = seen.entries.iter().zip(&seen.weights);
            pairs.map(move |(at, w)| start.iter().chain([at, w]).copied().collect())
        });
        NotIdentified::new(
            "no shift of samples, grid or table explains what samples see of a volume",
        )
        .with_rows(
            &[
                "segments",
                "length in steps",
                "cells",
                "entries",
                "place among entries",
                "weight",
            ],
            rows.collect(),
        )
    })
}

fn seen(
    session: &mut Session<'_>,
    answers: &Answers,
    (n, cells, entries, last): (usize, usize, usize, f64),
    depth: &mut f64,
) -> Result<Seen, NotIdentified> {
    let bright = answers.emission_max.min(1.0) * answers.output.high.map_or(1.0, |h| h.min(1.0));
    let length = STEP * (n as f64 - 1.0 + last);
    let steps = Steps {
        length,
        step: STEP,
        segments: n,
    };
    let volume = Volume {
        field: optics::ramp(length, cells + 1),
        table: optics::lit_entries(length, entries, *depth / length, bright),
    };
    let made = Made::of_volume(session.name(), steps, volume.clone());
    let y = session.ask_made(&made)?;
    let Some(found) = lit(answers, &y, bright) else {
        let dark = y.first().copied().unwrap_or(0.0);
        let lit = y
            .iter()
            .skip(1)
            .enumerate()
            .filter(|(_, y)| (**y - dark).abs() > 0.0);
        return Err(NotIdentified::new(
            "a sample sees more than two entries of a table, or samples stand too close",
        )
        .with_rows(
            &["entry", "answer to emission there"],
            lit.map(|(k, y)| vec![k as f64, *y]).collect(),
        ));
    };
    if hides(&found) && *depth > LEAST {
        *depth /= THINNER;
        return seen(session, answers, (n, cells, entries, last), depth);
    }
    let (entries, weights) = found.iter().map(|s| (s.at, s.weight)).unzip();
    Ok(Seen {
        volume,
        steps,
        entries,
        weights,
    })
}

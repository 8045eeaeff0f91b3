//! What makes the last sample weigh more than its segment.

use super::Lone;
use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::ray::Layers;
use crate::identify::rule::{End, Place, Wall, Whole};
use crate::identify::session::Session;
use crate::identify::weights::{Measured, nodes_of, weights};

/// Extinctions of the last segment, from one that a wall of any length is opaque at.
const EXTINCTIONS: [f64; 6] = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 0.0];
/// Those asked where there are few rays.
const FEW: [f64; 4] = [1.0, 1e-6, 1e-12, 0.0];
/// Segments.
const SEGMENTS: usize = 6;

/// What stands at the end of a ray.
#[derive(Clone, Copy, Debug)]
pub(in crate::identify) struct Walled {
    pub(in crate::identify) wall: Wall,
    /// Of its length.
    pub(in crate::identify) bracket: (f64, f64),
    /// The factor of rays that it lets through; `None` where it lets none through, or the factor is no known one.
    pub(in crate::identify) whole: Option<Whole>,
}

/// The factor of the whole ray where its last segment holds nothing: behind a wall the opacity is 1 and shows none.
fn whole_of(lone: &Lone<'_>, w: &[Measured], taus: &[f64], length: f64) -> Option<Whole> {
    let ray = taus.len() as f64 * length;
    let through: f64 = taus
        .iter()
        .map(|tau| lone.of(*tau, length, ray).1)
        .product();
    let steps = 1 - i32::from(lone.measurer.samples.sequence.late);
    let (weight, passes) = lone.of(taus[1], length, ray);
    let factor = w[1].value / (weight * passes.powi(steps));
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit + 3.0 * w[1].error / w[1].value;
    let kinds = [
        (Whole::One, 1.0),
        (Whole::ByOpacity, 1.0 / (1.0 - through)),
        (Whole::TimesOpacity, 1.0 - through),
    ];
    let found = kinds
        .iter()
        .find(|(_, f)| (factor / f - 1.0).abs() <= slack);
    found.map(|(whole, _)| *whole)
}

/// Those that are asked.
fn extinctions(session: &Session<'_>) -> &'static [f64] {
    if session.is_short() {
        &FEW
    } else {
        &EXTINCTIONS
    }
}

/// Weights of samples at all ends of segments, by their extinctions.
fn with_extra(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    taus: &[f64],
    length: f64,
) -> Result<Vec<Measured>, NotIdentified> {
    let n = taus.len() - 1;
    let layers = Layers {
        edges: taus.to_vec(),
        ..Layers::of(length, &taus[..n])
    };
    let nodes = nodes_of(Place::Front, n, true);
    Ok(weights(session, lone.measurer.answers, &layers, &nodes, &[])?.of)
}

/// The kind of the wall, and its length's bracket.
pub(in crate::identify) fn wall(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
) -> Result<Walled, NotIdentified> {
    let n = lone.measurer.suitable(session, SEGMENTS);
    let length = 0.25;
    let tau = lone.reference(length);
    let ray = n as f64 * length;
    let sequence = &lone.measurer.samples.sequence;
    // One sample too many at the front of segments is the one that stands before the wall.
    let is_extra = lone.measurer.samples.place == Place::Front && sequence.extra.is_some();
    if is_extra && sequence.swapped {
        return Err(NotIdentified::new(
            "the last sample of a turned ray with one too many weighs more than its segment",
        ));
    }
    let last = if is_extra {
        n
    } else {
        n - 1 - usize::from(sequence.last == End::Missing)
    };
    let mut parts: Vec<(f64, f64, f64)> = Vec::new();
    let mut open = None;
    for &extinction in extinctions(session) {
        let mut taus = vec![tau; n + usize::from(is_extra)];
        taus[last] = extinction;
        let w = if is_extra {
            with_extra(session, lone, &taus, length)?
        } else {
            lone.measurer.weights(session, &taus, length)?
        };
        // The one before the last weighs T α, and T p stands before the last.
        let (weight, passes) = lone.of(tau, length, ray);
        let before = w[last - 1].value / weight * passes * lone.law.scale.0;
        let part = w[last].value / before;
        let error = (w[last].error + w[last - 1].error / weight) / before;
        if extinction == 0.0 {
            open = whole_of(lone, &w, &taus, length);
        }
        parts.push((extinction, part, error));
    }
    let rows = parts
        .iter()
        .map(|(tau, part, error)| vec![*tau, *part, *error])
        .collect();
    let failed =
        NotIdentified::new("the last sample weighs more than its segment, by no known law")
            .with_rows(&["its extinction", "its weight", "error"], rows);
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit;
    let is_one = |(_, part, error): &(f64, f64, f64)| (part - 1.0).abs() <= 3.0 * error + slack;
    let is_none = |(_, part, error): &(f64, f64, f64)| part.abs() <= 3.0 * error + slack;
    let none = (0.0, 0.0);
    if parts.iter().all(is_one) {
        return Ok(Walled {
            wall: Wall::LastEmission,
            bracket: none,
            whole: None,
        });
    }
    // The last holds nothing.
    let Some((empty, full)) = parts.split_last() else {
        return Err(failed);
    };
    if full.iter().all(is_one) && is_none(empty) {
        return Ok(Walled {
            wall: Wall::Opaque,
            bracket: none,
            whole: open,
        });
    }
    // A length: the same wherever it can be told.
    if !is_none(empty) {
        return Err(failed);
    }
    let of = |tau: f64, length: f64| lone.of(tau, length, ray).0 / lone.law.scale.0;
    let told = full
        .iter()
        .filter(|(_, part, _)| *part > 1e-3 && *part < 0.999);
    let Some((tau, part, error)) = told.clone().next() else {
        return Err(failed);
    };
    let reach = |part: f64| {
        let (mut low, mut high) = (1e-6_f64, 1e18_f64);
        for _ in 0..120 {
            let middle = (low * high).sqrt();
            if of(*tau, middle) < part {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    };
    let width = 3.0 * error + 1e-9 + 64.0 * lone.measurer.answers.unit;
    let bracket = (reach(part - width), reach(part + width));
    let length = simplest(bracket.0, bracket.1);
    let fits = |(tau, part, error): &(f64, f64, f64)| {
        (of(*tau, length) - part).abs() <= 3.0 * error + slack
    };
    if !full.iter().all(fits) {
        return Err(failed);
    }
    Ok(Walled {
        wall: Wall::Length(length),
        bracket,
        whole: open,
    })
}

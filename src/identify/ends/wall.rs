//! What makes the last sample weigh more than its segment.

use super::Lone;
use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::rule::Wall;
use crate::identify::session::Session;

/// Extinctions of the last segment, from one that a wall of any length is opaque at.
const EXTINCTIONS: [f64; 6] = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 0.0];
/// Segments.
const SEGMENTS: usize = 6;

/// The kind of the wall, and its length's bracket.
pub(in crate::identify) fn wall(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
) -> Result<(Wall, (f64, f64)), NotIdentified> {
    let n = lone.measurer.suitable(session, SEGMENTS);
    let length = 0.25;
    let tau = lone.reference(length);
    let ray = n as f64 * length;
    let mut rows = Vec::new();
    let mut parts = Vec::new();
    for extinction in EXTINCTIONS {
        let mut taus = vec![tau; n];
        taus[n - 1] = extinction;
        let w = lone.measurer.weights(session, &taus, length)?;
        // w[n−2] = T α, and T p stands before the last.
        let (weight, passes) = lone.of(tau, length, ray);
        let before = w[n - 2].value / weight * passes * lone.law.scale.0;
        let part = w[n - 1].value / before;
        let error = (w[n - 1].error + w[n - 2].error / weight) / before;
        rows.push(vec![extinction, part, error]);
        parts.push((extinction, part, error));
    }
    let failed =
        NotIdentified::new("the last sample weighs more than its segment, by no known law")
            .with_rows(&["its extinction", "its weight", "error"], rows);
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit;
    let is_one = |(_, part, error): &(f64, f64, f64)| (part - 1.0).abs() <= 3.0 * error + slack;
    let is_none = |(_, part, error): &(f64, f64, f64)| part.abs() <= 3.0 * error + slack;
    let none = (0.0, 0.0);
    if parts.iter().all(is_one) {
        return Ok((Wall::LastEmission, none));
    }
    let (empty, full) = (&parts[5], &parts[..5]);
    if full.iter().all(is_one) && is_none(empty) {
        return Ok((Wall::Opaque, none));
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
    Ok((Wall::Length(length), bracket))
}

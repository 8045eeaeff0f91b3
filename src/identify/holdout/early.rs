//! Rays about an early end.

use super::kinds::{Make, USUAL};
use super::ray::ray;
use super::{Kind, Miss, Terms, ask_one};
use crate::identify::random::Random;
use crate::identify::rule::Rule;
use crate::identify::session::Session;
use crate::identify::silence::Silence;
use crate::real::Native;

/// How near to its early end a ray is made to come.
const NEAR: f64 = 2e-3;

/// Rays that just end early, and that just do not: elsewhere a threshold does not show.
pub(super) fn about_the_end(
    session: &mut Session<'_>,
    rule: &Rule,
    terms: &Terms<'_>,
    random: &mut Random,
    misses: &mut Vec<Miss>,
) -> Result<Kind, Silence> {
    let mut kind = Kind::of("about to end early".into());
    let make = Make {
        depth: [1.0, 1.0],
        segments: [16, 24],
        ..USUAL
    };
    let shapes = if session.is_short() { 1 } else { 2 };
    for _ in 0..shapes {
        let shape = ray(session, random, make, (false, 0), terms);
        let scaled = |scale: f64| {
            let mut ray = shape.clone();
            let all = [&mut ray.segments.edges, &mut ray.segments.middles];
            for samples in all {
                samples.extinction.iter_mut().for_each(|tau| *tau *= scale);
            }
            ray
        };
        let taken = |scale: f64| {
            let ray = scaled(scale);
            let (segments, step) = rule.cut(&ray);
            let composed = rule.composed(&segments, step, Native::<f64>::new());
            composed.terms.len()
        };
        // By a transmittance thick rays end, by a weight thin ones: where the number of samples changes.
        let scales: Vec<f64> = (0..40).map(|k| 1e-3 * 1.4_f64.powi(k)).collect();
        let change = scales.windows(2).find(|w| taken(w[0]) != taken(w[1]));
        let Some(&[mut low, mut high]) = change else {
            continue;
        };
        let before = taken(low);
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            if taken(middle) == before {
                low = middle;
            } else {
                high = middle;
            }
        }
        for scale in [low * (1.0 - NEAR), high * (1.0 + NEAR)] {
            let mut ray = scaled(scale);
            ray.name = session.name();
            ask_one(session, (rule, terms), &ray, &mut kind, misses)?;
        }
    }
    Ok(kind)
}

//! Exponentials in binary32 that are off to one side: what many thin segments let through together.
//!
//! Rounding turns either way, and of n random depths leaves the root of n times a unit; an exponential that is always too
//! large by k units leaves n k of them. Depths of which another mean is off as much tell that from a factor of the depth.

use super::deviation::{Deviation, right_of};
use super::number::simplest_near;
use super::random::Random;
use super::ray::Layers;
use super::rule::{Place, Rule, Scheme};
use super::session::Session;
use super::silence::Silence;
use super::weights::impulse;
use super::{Identification, Precision};
use crate::kernel::Declaration;
use crate::real::Native;
use serde::Serialize;

/// By how much exponentials are off in the mean.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Exponential {
    /// In units of 2^(−24), which are those in the last place of a number between 1/2 and 1; above 0 where they are too
    /// large.
    pub units: f64,
    /// By how much that differs between rays of thinner and of thicker segments, and what rounding leaves.
    pub error: f64,
}

/// Bits of the format of which that is said.
const BITS: u32 = 24;
/// Segments of rays, and the depth of all of them together.
const THIN: [(usize, f64); 3] = [(4_200, 2.0), (2_100, 2.0), (3_000, 2.0)];
/// The same of thick ones: what is added to what is let through shows there many times as much.
const THICK: (usize, f64) = (40, 80.0);
/// Between what parts of the units that thin ones say thick ones have to be, but for so many: units in the last place are
/// half as large a part of a number as of another one.
const PARTS: (f64, f64) = (0.4, 1.2);
const BUT_FOR: f64 = 0.6;
/// The length of segments, a number of few bits.
const STEP: f64 = 0.25;
/// Units beyond which exponentials are off: rounding to one side in every product leaves less.
const LEAST: f64 = 1.5;
/// Rays agree within this part of what they say, or this many units.
const AGREE: f64 = 0.05;

/// The exponential of a plain rule whose answers are in binary32, where it is off.
pub(super) fn exponential(
    session: &mut Session<'_>,
    rule: &Rule,
    precision: Option<Precision>,
    typical: f64,
) -> Result<Option<Exponential>, Silence> {
    let Scheme::Sample { place, .. } = &rule.scheme else {
        return Ok(None);
    };
    let is_plain = Rule {
        channels: rule.channels,
        ..right_of(rule)
    } == *rule;
    if precision != Some(Precision::Bits(BITS)) || !is_plain {
        return Ok(None);
    }
    let mut random = Random::new(131);
    let mut all = Vec::new();
    for cut in THIN {
        match units(session, (rule, *place), typical, cut, &mut random)? {
            Some(units) => all.push(units),
            None => return Ok(None),
        }
        // Most are not off, and one ray tells.
        if all[0].abs() < LEAST {
            return Ok(None);
        }
    }
    let (low, high) = all
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), units| {
            (low.min(*units), high.max(*units))
        });
    let units = f64::midpoint(low, high);
    let error = 0.5 * (high - low) + AGREE;
    let thick = self::units(session, (rule, *place), typical, THICK, &mut random)?;
    let size = units.abs();
    let (least, most) = PARTS;
    let of_thick = thick.map(|thick| thick * units.signum());
    let is_exponential =
        of_thick.is_some_and(|of| of >= least * size - BUT_FOR && of <= most * size + BUT_FOR);
    let agree = high - low <= 2.0 * AGREE * size.max(1.0);
    Ok(
        (is_exponential && agree && units.abs() >= LEAST).then(|| Exponential {
            units: simplest_near(units, error / units.abs()),
            error,
        }),
    )
}

/// By how many units each of n segments, of that depth together, lets through more than the rule says.
fn units(
    session: &mut Session<'_>,
    (rule, place): (&Rule, Place),
    typical: f64,
    (n, depth): (usize, f64),
    random: &mut Random,
) -> Result<Option<f64>, Silence> {
    let n = n.next_multiple_of(session.multiple);
    let mean = depth / n as f64;
    let mut taus: Vec<f64> = random
        .many(n, 0.0, 2.0 * mean)
        .into_iter()
        .map(|depth| depth * typical / STEP)
        .collect();
    // The light of the last one is seen through all others, and known to a unit.
    if let Some(last) = taus.last_mut() {
        *last = typical / STEP;
    }
    let layers = Layers::of(STEP, &taus);
    let index = isize::try_from(n).unwrap_or(isize::MAX) - 1;
    let Some(node) = place.node(index) else {
        return Ok(None);
    };
    let ray = session.ray(&layers, &[impulse(n, node, 1.0)]);
    let got = session.ask(&ray)?;
    let composed = rule.composed(&ray.segments, STEP, Native::<f64>::new());
    let want = rule.radiance(&composed, &ray.segments, 0, Native::<f64>::new());
    let off = (got.first().copied().unwrap_or(f64::NAN) / want).ln();
    let unit = (-f64::from(BITS)).exp2();
    let units = off / (n as f64 - 1.0) / unit;
    Ok(units.is_finite().then_some(units))
}

/// Where a kernel declares that its exponentials are better.
pub(super) fn deviation(found: &Identification, declaration: &Declaration) -> Option<Deviation> {
    let off = found.exponential?;
    let declared = declaration.exp_ulp?;
    let size = off.units.abs();
    // At depths that are next to nothing.
    let allowed = declared.at(THIN[0].1 / THIN[0].0 as f64);
    (size - off.error > allowed).then(|| Deviation {
        value: Some(size),
        bracket: Some((size - off.error, size + off.error)),
        instead_of: Some(format!("{allowed:.1} ulp, as declared")),
        ..super::deviation::plain(
            "exponential",
            "what thousands of thin segments let through",
            &off.to_string(),
        )
    })
}

impl std::fmt::Display for Exponential {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let side = if self.units > 0.0 { "large" } else { "small" };
        write!(
            f,
            "exponentials are too {side} by about {:.1} ulp",
            self.units.abs()
        )
    }
}

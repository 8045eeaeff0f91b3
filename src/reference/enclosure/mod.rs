//! The integral as an interval that is proved to contain it, to any number of digits.
//!
//! On a panel τ is replaced by the polynomial that has its values at Chebyshev points, and C τ e^(−t) by another;
//! what they leave out is bounded by the medium's values on an ellipse around the panel in the complex plane, enclosed
//! in rectangles, so that nothing can hide between the points. All else is interval arithmetic in MPFR, rounded
//! outwards. Panels are halved until the bounds are small; where the medium takes another way (a kink, a jump) the
//! ray is cut, and what is too short to tell is enclosed by its range. At an end where the medium is a series of roots it
//! is integrated in a variable in which it is analytic there: λ = a ± w vᵖ.

mod branches;
mod crossing;
mod ellipse;
mod germ;
mod march;
mod narrow;
mod number;
mod rectangle;
mod run;
mod stretch;
mod substitution;
mod transform;

use super::chebyshev::log2_abs;
use super::{Quantity, Work};
use crate::real::MAX_BITS;
use crate::symbolic::{Interval, Program};
use march::{March, Settings};
use rug::{Float, Rational};
use run::{constants, hull};
use stretch::{Ray, Stretch};

pub use rectangle::Rectangle;
pub use run::range;
pub use substitution::substituted;
pub use transform::Points;

/// Bits beyond the tolerance that numbers have.
const ROUNDING_BITS: u32 = 64;
/// Bits of the first, rough pass.
const ROUGH_BITS: u32 = 24;
/// Bits beyond those asked for that are aimed at.
const TARGET_BITS: u32 = 8;
/// Where light of both signs cancels by this many bits more than were asked for, its sum is not told from 0.
const CANCELLED_BITS: u32 = 128;
/// Panels are as short as the precision can be, by so many bits, where the medium has no bound.
const SHORT_BITS: u32 = 128;
/// Passes before it is given up.
const PASSES: u32 = 8;

/// What is enclosed: C and τ along the ray, in this order, as a program of λ.
pub(super) struct Medium<'c> {
    pub(super) program: Program,
    pub(super) length: Rational,
    /// Where kinks and jumps are, in so many bits, as far as they are known; others are found.
    pub(super) breaks: &'c dyn Fn(u32) -> Vec<Interval>,
}

/// Why there is no enclosure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotEnclosed {
    /// It was not asked for.
    #[error("an estimate was asked for")]
    NotTried,
    /// A medium that is code.
    #[error("the medium is code and no formula")]
    NoFormulas,
    /// No bound could be had around a place.
    #[error("no bound of C and tau near lambda = {lambda}")]
    NotBounded {
        /// Where, to the nearest binary64.
        lambda: f64,
    },
    /// More panels or points than are allowed.
    #[error("more panels than are allowed, at lambda = {lambda}")]
    TooMuchWork {
        /// Where it was given up.
        lambda: f64,
    },
    /// More kinks and jumps than are looked for.
    #[error("more kinks and jumps than are looked for")]
    TooManyBranches,
    /// τ < 0.
    #[error("tau < 0 near lambda = {lambda}")]
    NegativeExtinction {
        /// Where, to the nearest binary64.
        lambda: f64,
    },
    /// The bits asked for were not reached.
    #[error("enclosed to {reached} bits only")]
    TooFewBits {
        /// Those that are certain.
        reached: u32,
    },
}

/// t(D) or I(D) enclosed to `bits` significant bits, and what was done for it.
pub(super) fn enclose(
    medium: &Medium<'_>,
    quantity: Quantity,
    bits: u32,
) -> Result<(Interval, Work), NotEnclosed> {
    let mut work = Work::default();
    // log₂ of the tolerance: first of a bold guess of the size, then of what was found.
    let mut allowed = -f64::from(ROUGH_BITS);
    let mut target = ROUGH_BITS;
    let mut more = 0;
    let mut deeper = 64.0;
    let mut reached = 0;
    let length = log2_abs(&Float::with_val(64, &medium.length));
    for _ in 0..PASSES {
        let precision = (target + ROUNDING_BITS + more).min(MAX_BITS);
        let (depth, light) = match quantity {
            Quantity::Depth => (allowed, None),
            Quantity::Radiance => (-f64::from(target), Some(allowed)),
        };
        let settings = Settings {
            precision,
            depth,
            light,
            limit: (target as usize).next_power_of_two().max(64),
            shortest: length + allowed.min(0.0) - f64::from(precision + SHORT_BITS),
        };
        let mut march = March::new(medium, settings);
        let end = Interval::point(precision, &medium.length);
        let stretches = parts(medium, &end, precision).ok_or(NotEnclosed::TooManyBranches)?;
        march.run(&stretches)?;
        if !reaches_the_end(&stretches) {
            march.finish(&end)?;
        }
        work.panels = march.work.panels;
        work.points = march.work.points;
        work.evaluations += march.work.points;
        let brightest = march.brightest;
        let found = match quantity {
            Quantity::Depth => march.depth,
            Quantity::Radiance => march.light,
        };
        if found.is_zero() {
            return Ok((found, work));
        }
        let least = if found.contains_zero() {
            f64::NEG_INFINITY
        } else {
            log2_abs(found.lower()).min(log2_abs(found.upper()))
        };
        let off = log2_abs(&found.width());
        if least - off >= f64::from(bits) {
            return Ok((found, work));
        }
        if least == f64::NEG_INFINITY {
            if off < brightest - f64::from(bits + CANCELLED_BITS) {
                return Ok((found, work));
            }
            allowed -= deeper;
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            // Positive, and saturates.
            let cancelled = (brightest - allowed).max(0.0) as u32;
            more = cancelled.saturating_sub(target).min(MAX_BITS);
            deeper *= 4.0;
            continue;
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        // Positive, and saturates.
        let got = (least - off).max(0.0) as u32;
        reached = got;
        if target >= bits + TARGET_BITS {
            // Roundings were worse than foreseen.
            more += bits.saturating_sub(got) + ROUNDING_BITS;
        }
        target = bits + TARGET_BITS;
        allowed = least - f64::from(target);
    }
    Err(NotEnclosed::TooFewBits { reached })
}

/// All values of a program on an interval, in as many bits.
pub(super) fn values(program: &Program, input: &Interval) -> Vec<Option<Interval>> {
    hull(program, &constants(program, input.bits()), input)
}

/// The ray in parts that go one way each.
fn parts(medium: &Medium<'_>, end: &Interval, precision: u32) -> Option<Vec<Stretch>> {
    // With fewer bits, so that what is beyond a break is certainly beyond it.
    let breaks = (medium.breaks)(precision - ROUNDING_BITS / 2);
    let shortest = Float::with_val(64, end.upper()) >> (precision - ROUNDING_BITS / 2);
    let constants = constants(&medium.program, precision);
    let ray = Ray {
        program: &medium.program,
        constants: &constants,
        rough: &run::constants(&medium.program, crossing::ROUGH_BITS),
        length: &medium.length,
        breaks: &breaks,
        shortest: &shortest,
    };
    ray.stretches(end.lower())
}

/// A part of the ray on which a medium is analytic: λ = from + width·uᵖ, or to − width·(1 − u)ᵖ where that is its far end.
pub(super) struct Section {
    /// λ at the near end.
    pub(super) from: Float,
    /// λ at the far end.
    pub(super) to: Float,
    /// p.
    pub(super) power: u32,
    /// Whether the power is that of the far end.
    pub(super) is_far: bool,
}

/// The ray in such parts, their ends in so many bits; `None` where there are more than are looked for.
pub(super) fn sections(medium: &Medium<'_>, precision: u32) -> Option<Vec<Section>> {
    let end = Interval::point(precision, &medium.length);
    let mut sections: Vec<Section> = Vec::new();
    let mut from = Float::new(precision);
    for stretch in parts(medium, &end, precision)? {
        let [near, far] = stretch.ends().map(|place| place.midpoint());
        if stretch.branches.is_none() {
            // What is too short to tell is divided between its neighbours.
            from = Float::with_val(precision, near + far) >> 1_u32;
            if let Some(last) = sections.last_mut() {
                last.to.clone_from(&from);
            }
            continue;
        }
        let substitution = stretch.substitution.as_ref();
        sections.push(Section {
            from: std::mem::replace(&mut from, far.clone()),
            to: far,
            power: substitution.map_or(1, |s| s.power),
            is_far: substitution.is_some_and(|s| s.is_far),
        });
    }
    if let Some(last) = sections.last_mut() {
        last.to = end.midpoint();
    }
    Some(sections)
}

/// Whether D itself, and no number near it, is the end of the last of these.
fn reaches_the_end(stretches: &[Stretch]) -> bool {
    let last = stretches.last().and_then(|last| last.substitution.as_ref());
    last.is_some_and(|substitution| substitution.is_far)
}

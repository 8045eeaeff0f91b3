//! The ray between two breaks, and the medium sampled there.

use super::super::ReferenceError;
use super::super::enclosure::{self, Section};
use super::super::medium::Medium;
use super::Work;
use crate::case::Structure;
use crate::real::counted::count;
use crate::real::{CountedReal, MpfrReal};
use crate::symbolic::Interval;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};

/// Roots of a higher degree than this are left to grading.
const MAX_ROOT: u32 = 12;
/// Bits beyond those of numbers that places of cuts are searched with.
const CUT_BITS: u32 = 64;
/// Bits that a place near a root has more, a unit of the power, and at most: λ differs from the root's place by vᵖ.
const ROOT_BITS: u32 = 32;
const MAX_ROOT_BITS: u32 = 96;

/// A part of the ray inside of which the medium is analytic as far as is known, with λ = from + width·vᵖ, v in
/// [0, 1], or λ = to − width·(1 − v)ᵖ: p > 1 where τ or C·τ is a series of p-th roots at that end, which are
/// analytic in v.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    from: Float,
    to: Float,
    width: Float,
    power: u32,
    /// Whether the power is that of the far end.
    is_far: bool,
    bits: u32,
    /// Whether the left end is a break, whose value may belong to the other side, or a root.
    pub(super) is_open_left: bool,
    /// Whether the right end is.
    pub(super) is_open_right: bool,
}

/// τ and C·τ times dλ/dv.
pub(super) type Sample = (Float, Float);

impl Stretch {
    /// The stretches between the breaks of a case: those that its formulas have, or those that are known.
    pub(super) fn all(case: &dyn Medium, bits: u32) -> Vec<Stretch> {
        let sections = Stretch::sections(case, bits).unwrap_or_else(|| known(case, bits));
        let last = sections.len().saturating_sub(1);
        let stretches = sections.into_iter().enumerate().map(|(index, section)| {
            let Section {
                from,
                to,
                power,
                is_far,
            } = section;
            Stretch {
                width: Float::with_val(from.prec(), &to - &from),
                from,
                to,
                power,
                is_far,
                bits,
                is_open_left: index > 0 || power > 1 && !is_far,
                is_open_right: index < last || power > 1 && is_far,
            }
        });
        stretches.collect()
    }

    /// What formulas tell.
    fn sections(case: &dyn Medium, bits: u32) -> Option<Vec<Section>> {
        let breaks = |bits| case.break_places(bits).into_iter().flatten().collect();
        let medium = enclosure::Medium {
            program: case.integrand()?,
            length: case.length(),
            breaks: &breaks,
        };
        enclosure::sections(&medium, bits + CUT_BITS)
    }

    /// Evaluates the medium at v.
    pub(super) fn sample(
        &self,
        case: &dyn Medium,
        v: &Float,
        work: &mut Work,
    ) -> Result<Sample, ReferenceError> {
        let bits = self.bits;
        let lambda = self.place(v);
        let place = CountedReal::from(MpfrReal::from(lambda));
        let (transfer, counts) = count(|| case.at(&place));
        work.evaluations += 1;
        work.transcendental_calls += counts.transcendentals();
        let number = |x: CountedReal<MpfrReal>| Float::from(x.into_inner());
        let (emission, mut extinction) = (number(transfer.emission), number(transfer.extinction));
        if !extinction.is_finite() || !emission.is_finite() {
            return Err(ReferenceError::MediumNotFinite {
                lambda: number(place).to_f64(),
                extinction: extinction.to_f64(),
                emission: emission.to_f64(),
            });
        }
        let mut slope = Float::with_val(bits, &self.width * self.power);
        if self.power > 1 {
            slope *= Float::with_val(bits, self.beside_root(v).pow(self.power - 1));
        }
        extinction.set_prec(bits);
        extinction *= &slope;
        let source = Float::with_val(bits, &extinction * &emission);
        Ok((extinction, source))
    }

    /// λ at v.
    pub(super) fn place(&self, v: &Float) -> Float {
        let more = (ROOT_BITS * (self.power - 1)).min(MAX_ROOT_BITS);
        let bits = self.bits + more;
        let mut step = Float::with_val(bits, self.beside_root(v).pow(self.power));
        step *= &self.width;
        if self.is_far {
            Float::with_val(bits, &self.to - step)
        } else {
            step + &self.from
        }
    }

    /// v, or 1 − v where the root is at the far end.
    fn beside_root(&self, v: &Float) -> Float {
        if self.is_far {
            Float::with_val(self.bits, 1 - v)
        } else {
            v.clone()
        }
    }
}

/// The sections between the breaks that a case tells of.
fn known(case: &dyn Medium, bits: u32) -> Vec<Section> {
    let length = Float::with_val(bits, case.length());
    let structure = case.structure();
    // What is not known well enough is left to grading.
    let narrow = Float::with_val(bits, &length >> (bits - bits / 8));
    let mut cuts: Vec<Float> = case
        .break_places(bits)
        .iter()
        .flatten()
        .filter(|place| place.is_finite() && place.width() <= narrow)
        .map(Interval::midpoint)
        .filter(|place| *place > narrow && Float::with_val(bits, &length - place) > narrow)
        .collect();
    cuts.sort_by(Float::total_cmp);
    cuts.dedup_by(|b, a| Float::with_val(bits, &*b - &*a) <= narrow);
    let mut ends = vec![Float::new(bits)];
    ends.extend(cuts);
    ends.push(length);
    let sections = ends.windows(2).enumerate().filter_map(|(index, pair)| {
        let [from, to] = pair else { return None };
        Some(Section {
            from: from.clone(),
            to: to.clone(),
            power: if index == 0 {
                root_at_near_end(&structure)
            } else {
                1
            },
            is_far: false,
        })
    });
    sections.collect()
}

/// The p of p-th roots that the structure states at λ = 0; 1 for none.
fn root_at_near_end(structure: &Structure) -> u32 {
    let near = structure.breaks.iter();
    let near = near.filter(|b| b.part.as_ref().is_some_and(|part| *part == 0));
    let powers = near.flat_map(|b| b.extinction.iter().chain(&b.source));
    let root = powers
        .map(Rational::denom)
        .fold(Integer::from(1), Integer::lcm);
    root.to_u32().filter(|root| *root <= MAX_ROOT).unwrap_or(1)
}

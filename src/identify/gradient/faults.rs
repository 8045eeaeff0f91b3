//! Which term of a gradient is wrong.

use super::Ray;
use super::own::{Entry, ROUNDINGS, Side};
use crate::identify::deviation::Deviation;
use crate::identify::number::simplest;
use crate::identify::precision::Precision;

/// A derivative that somebody may take for the right one.
struct Candidate {
    name: &'static str,
    does: &'static str,
    of: fn(&Entry, Side) -> f64,
}

/// By τ: with e = 1 − α, direct = T C, S from behind, the right one is α′ (T C − S/e).
const BY_EXTINCTION: [Candidate; 7] = [
    Candidate {
        name: "gradient-direct-unattenuated",
        does: "the direct term of the derivative by τ lacks the transmittance in front of the sample",
        of: |e, _| e.slope * (e.direct / e.front - e.behind / (1.0 - e.opacity)),
    },
    Candidate {
        name: "gradient-transmittance",
        does: "the direct term of the derivative by τ has the transmittance in front of the sample, not behind it",
        of: |e, _| e.slope / (1.0 - e.opacity) * (e.direct - e.behind),
    },
    Candidate {
        name: "gradient-own-light",
        does: "the sample's own light counts among what shines from behind it",
        of: |e, _| e.slope * (e.direct - (e.behind + e.own) / (1.0 - e.opacity)),
    },
    Candidate {
        name: "gradient-detached-transmittance",
        does: "what the sample dims has no part in the derivative by τ",
        of: |e, _| e.slope * e.direct,
    },
    Candidate {
        name: "gradient-light-behind",
        does: "the light from behind is not divided by 1 − α",
        of: |e, _| e.slope * (e.direct - e.behind),
    },
    Candidate {
        name: "gradient-of-opacity",
        does: "the derivative is that by the opacity α, not by τ",
        of: |e, _| e.direct - e.behind / (1.0 - e.opacity),
    },
    Candidate {
        name: "gradient-per-depth",
        does: "the derivative by τ lacks the length of the segment",
        of: |e, _| e.slope / e.length * (e.direct - e.behind / (1.0 - e.opacity)),
    },
];

/// By C: the right one is a T α.
const BY_EMISSION: [Candidate; 4] = [
    Candidate {
        name: "gradient-emission-unattenuated",
        does: "the derivative by C is the opacity, without the transmittance",
        of: |e, side| e.cotangent(side) * e.opacity,
    },
    Candidate {
        name: "gradient-emission-transmittance",
        does: "the derivative by C is the transmittance, without the opacity",
        of: |e, side| e.cotangent(side) * e.front,
    },
    Candidate {
        name: "gradient-emission-per-length",
        does: "the derivative by C is divided by the length of the segment",
        of: |e, side| e.cotangent(side) * e.weight / e.length,
    },
    Candidate {
        name: "gradient-cotangents",
        does: "the derivative by C does not know the cotangents",
        of: |e, _| e.weight,
    },
];

/// Derivatives of less than that many tolerances tell no factor.
const CLEAR: f64 = 64.0;

/// What is wrong, found on some rays and held out on the others.
pub(super) fn named(all: &[Ray], unit: f64, precision: Precision) -> Vec<Deviation> {
    let mut found = Vec::new();
    if precision.unit() > 2.0 * unit {
        let value = match precision {
            Precision::Bits(count) | Precision::Digits(count) => f64::from(count),
        };
        let does = format!("no derivative has more than {precision}; radiances have more");
        found.push(Deviation {
            exact: true,
            ..deviation("gradient-format", Some(value), None, does)
        });
    }
    let unit = unit.max(precision.unit());
    let by_extinction = one_side(all, &[Side::Extinction], &BY_EXTINCTION, unit);
    let channels = all.first().map_or(0, |ray| ray.answered.len() - 1);
    let sides: Vec<Side> = (0..channels).map(Side::Emission).collect();
    let by_emission = one_side(all, &sides, &BY_EMISSION, unit);
    for one in by_extinction.into_iter().chain(by_emission) {
        // An end is one of both.
        if !found.iter().any(|known| known.name == one.name) {
            found.push(one);
        }
    }
    found
}

fn deviation(
    name: &'static str,
    value: Option<f64>,
    bracket: Option<(f64, f64)>,
    does: String,
) -> Deviation {
    Deviation {
        name,
        value,
        bracket,
        exact: false,
        probe: "the kernel's own values",
        validated: Vec::new(),
        does,
        instead_of: None,
    }
}

/// A derivative with its place among those of its ray.
#[derive(Clone, Copy)]
struct One<'r> {
    entry: &'r Entry,
    side: Side,
    got: f64,
    is_last: bool,
    held_out: bool,
}

impl One<'_> {
    fn truth(&self) -> f64 {
        self.entry.truth(self.side).map_or(f64::NAN, |m| m.value)
    }

    fn tolerance(&self, unit: f64) -> f64 {
        self.entry.tolerance(self.side, unit)
    }

    fn is(&self, wanted: f64, unit: f64) -> bool {
        // A wrong term may be larger than the right one.
        let rounding = ROUNDINGS * unit * wanted.abs();
        (self.got - wanted).abs() <= self.tolerance(unit) + rounding
    }

    /// No answer where there is one to give.
    fn is_lost(&self, unit: f64) -> bool {
        self.got == 0.0 && self.truth().abs() > CLEAR * self.tolerance(unit)
    }
}

fn one_side(all: &[Ray], sides: &[Side], candidates: &[Candidate], unit: f64) -> Option<Deviation> {
    let mut every: Vec<One<'_>> = Vec::new();
    for ray in all {
        for side in sides {
            let last = ray.entries.iter().rposition(|entry| entry.weight > 0.0);
            every.extend(ray.of(*side).enumerate().map(|(at, (entry, got))| One {
                entry,
                side: *side,
                got,
                is_last: Some(at) == last,
                held_out: ray.probe.held_out,
            }));
        }
    }
    let by = match sides {
        [Side::Extinction] => "τ",
        _ => "C",
    };
    let of_nothing = every.iter().filter(|one| !one.got.is_finite()).count();
    if of_nothing > 0 {
        let total = every.len();
        let does = format!(
            "{of_nothing} of {total} derivatives by {by} are not finite, and the radiances are"
        );
        return Some(deviation("gradient-not-finite", None, None, does));
    }
    every.retain(|one| {
        one.entry.truth(one.side).is_some() && !one.entry.is_at_rest(one.side, one.got)
    });
    if every.iter().all(|one| one.is(one.truth(), unit)) {
        return None;
    }
    if every.iter().all(|one| one.got == 0.0) {
        let does = format!("all derivatives by {by} are exactly 0, and the radiances change");
        return Some(deviation("gradient-zero", None, None, does));
    }
    lost(&every, by, unit)
        .or_else(|| scaled(&every, by, unit))
        .or_else(|| {
            candidates.iter().find_map(|candidate| {
                let of = |one: &One<'_>| (candidate.of)(one.entry, one.side);
                let is = every.iter().all(|one| one.is(of(one), unit));
                is.then(|| deviation(candidate.name, None, None, candidate.does.into()))
            })
        })
        .or_else(|| passed_through(&every, unit))
}

/// A constant factor of all.
fn scaled(every: &[One<'_>], by: &str, unit: f64) -> Option<Deviation> {
    let clear = every
        .iter()
        .filter(|one| !one.held_out && one.truth().abs() > CLEAR * one.tolerance(unit));
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for one in clear {
        let (factor, off) = (
            one.got / one.truth(),
            one.tolerance(unit) / one.truth().abs(),
        );
        (low, high) = (low.max(factor - off), high.min(factor + off));
    }
    if !(low.is_finite() && high.is_finite() && low <= high) {
        return None;
    }
    let factor = simplest(low, high);
    let is = |one: &One<'_>| (one.got - factor * one.truth()).abs() <= 2.0 * one.tolerance(unit);
    if !every.iter().all(is) {
        return None;
    }
    if (factor + 1.0).abs() <= 0.0 {
        let does = format!("the derivative by {by} has the other sign");
        return Some(deviation("gradient-sign", None, None, does));
    }
    let does = format!("the derivative by {by} is multiplied by {factor:?}");
    Some(deviation(
        "gradient-factor",
        Some(factor),
        Some((low, high)),
        does,
    ))
}

/// Derivatives that are 0: of last samples, behind an end, above a clamp, of what holds next to nothing.
fn lost(every: &[One<'_>], by: &str, unit: f64) -> Option<Deviation> {
    let is_lost = |one: &&One<'_>| one.is_lost(unit);
    let gone: Vec<&One<'_>> = every.iter().filter(is_lost).collect();
    if gone.is_empty() {
        return None;
    }
    let rest: Vec<&One<'_>> = every.iter().filter(|one| !one.is_lost(unit)).collect();
    let is_right = rest.iter().all(|one| one.is(one.truth(), unit));
    let mut lasts = every.iter().filter(|one| one.is_last);
    if is_right && gone.iter().all(|one| one.is_last) && lasts.all(|one| one.is_lost(unit)) {
        let does = format!("the derivative by {by} of the last sample is 0");
        return Some(deviation("gradient-last-sample", None, None, does));
    }
    // The border between what is lost and what is not, where there is one; both on rays held out and on the others.
    let border = |of: &dyn Fn(&Entry) -> f64| {
        let most = gone
            .iter()
            .map(|one| of(one.entry))
            .fold(f64::NEG_INFINITY, f64::max);
        let clear = rest
            .iter()
            .filter(|one| one.truth().abs() > CLEAR * one.tolerance(unit));
        let least = clear.map(|one| of(one.entry)).fold(f64::INFINITY, f64::min);
        let is_seen = |held_out: bool| gone.iter().any(|one| one.held_out == held_out);
        (most < least && is_seen(true) && is_seen(false)).then_some((most, least))
    };
    // In front of an end what is behind it is missing, which is no more than is left there.
    let within = |left: f64| {
        rest.iter().all(|one| {
            let bright = one.entry.direct.abs().max(one.entry.own.abs()) / one.entry.front;
            one.is(one.truth(), unit)
                || (one.got - one.truth()).abs() <= 4.0 * left * one.entry.length * bright
        })
    };
    if let Some(bracket) = border(&|entry| entry.front).filter(|bracket| within(bracket.1)) {
        let under = simplest(bracket.0, bracket.1);
        let does = format!(
            "derivatives are 0 where the transmittance is under {under:?}, and the radiance is not: the backward pass ends early"
        );
        return Some(deviation(
            "gradient-early-end",
            Some(under),
            Some(bracket),
            does,
        ));
    }
    if is_right && let Some((low, high)) = border(&|entry| -entry.opacity) {
        let bracket = (-high, -low);
        let above = simplest(bracket.0, bracket.1);
        let does = format!(
            "derivatives by {by} are 0 where the opacity is above {above:?}, and the radiance changes"
        );
        return Some(deviation(
            "gradient-clamp",
            Some(above),
            Some(bracket),
            does,
        ));
    }
    if is_right && let Some(bracket) = border(&|entry| entry.extinction * entry.length) {
        let under = simplest(bracket.0, bracket.1);
        let does = format!(
            "derivatives by {by} are 0 where the depth of a segment is under {under:?}, and the radiance changes"
        );
        return Some(deviation("gradient-thin", Some(under), Some(bracket), does));
    }
    None
}

/// Values that are held fast by a clamp, and derivatives that are not.
fn passed_through(every: &[One<'_>], unit: f64) -> Option<Deviation> {
    let is_flat = |one: &&One<'_>| {
        one.truth().abs() <= one.tolerance(unit) && one.got.abs() > CLEAR * one.tolerance(unit)
    };
    let wrong: Vec<&One<'_>> = every
        .iter()
        .filter(|one| !one.is(one.truth(), unit))
        .collect();
    if !wrong.iter().all(is_flat) {
        return None;
    }
    let least = wrong
        .iter()
        .map(|one| one.entry.opacity)
        .fold(f64::INFINITY, f64::min);
    let right = every
        .iter()
        .filter(|one| one.is(one.truth(), unit) && one.truth() != 0.0);
    let most = right.map(|one| one.entry.opacity).fold(0.0, f64::max);
    let seen = |held_out: bool| wrong.iter().any(|one| one.held_out == held_out);
    if most > least || !seen(true) || !seen(false) {
        return None;
    }
    let above = simplest(most, least);
    let does = format!(
        "derivatives are not 0 where the opacity would be above {above:?}, and there the radiance does not change: the gradient goes through a clamp"
    );
    Some(deviation(
        "gradient-through-clamp",
        Some(above),
        Some((most, least)),
        does,
    ))
}

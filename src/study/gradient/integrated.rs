//! t(λ) and I(λ) at many places of a medium without closed forms.

use crate::case::{Case, SymbolicCase};
use crate::quadrature::{Collocation, collocation};
use crate::real::{Format, Mpfr, MpfrReal, Real};
use rug::Float;

/// Bits of the sums.
const BITS: u32 = 160;
/// Gauss–Legendre points of a panel, and as many more as tell what the first leave.
const POINTS: (u32, u32) = (16, 24);
/// No panel is longer than this part of the ray.
const PANELS: u32 = 64;

/// t and I at some places.
pub(super) struct Integrals {
    /// t.
    pub(super) depth: Vec<Float>,
    /// I, of what lies in front.
    pub(super) radiance: Vec<Float>,
    /// How far two rules are apart at most, in either; an estimate. 0 of closed forms.
    pub(super) error: f64,
}

/// By Gauss–Legendre collocation in panels between the places and the breaks of the case; what differs between 16 and
/// 24 points a panel is the error.
pub(super) fn integrals(case: &SymbolicCase, places: &[f64]) -> Integrals {
    let format = Mpfr { bits: BITS };
    let knots = knots(case, places);
    let marched = |points| {
        let rule = collocation(points, format).ok()?;
        Some(march(case, &rule, &knots))
    };
    // Both numbers of points are among those that there are.
    let (Some(coarse), Some(fine)) = (marched(POINTS.0), marched(POINTS.1)) else {
        return nowhere(places);
    };
    let mut error: f64 = 0.0;
    for (coarse, fine) in coarse.iter().zip(&fine) {
        let off = |a: &Float, b: &Float| Float::with_val(BITS, a - b).to_f64().abs();
        error = error
            .max(off(&coarse.0, &fine.0))
            .max(off(&coarse.1, &fine.1));
    }
    let mut found = nowhere(&[]);
    for place in places {
        // Every place is a knot.
        let index = knots.partition_point(|knot| knot < place);
        if let Some((depth, radiance)) = fine.get(index) {
            found.depth.push(depth.clone());
            found.radiance.push(radiance.clone());
        }
    }
    Integrals { error, ..found }
}

fn nowhere(places: &[f64]) -> Integrals {
    let nan = || {
        places
            .iter()
            .map(|_| Float::with_val(BITS, f64::NAN))
            .collect()
    };
    Integrals {
        depth: nan(),
        radiance: nan(),
        error: 0.0,
    }
}

/// 0, the places, the breaks, and enough between them, ascending.
fn knots(case: &SymbolicCase, places: &[f64]) -> Vec<f64> {
    let length = case.length().to_f64();
    let even = (0..=PANELS).map(|i| length * f64::from(i) / f64::from(PANELS));
    let breaks = case.break_places(f64::MANTISSA_DIGITS).into_iter();
    let breaks = breaks.flatten().map(|place| place.midpoint().to_f64());
    let mut knots: Vec<f64> = even.chain(breaks).chain(places.iter().copied()).collect();
    knots.retain(|knot| (0.0..=length).contains(knot));
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    knots
}

/// t and I at every knot.
fn march(case: &SymbolicCase, rule: &Collocation<MpfrReal>, knots: &[f64]) -> Vec<(Float, Float)> {
    let format = Mpfr { bits: BITS };
    let (mut depth, mut radiance) = (format.int(0), format.int(0));
    let mut found = vec![(depth.to_float(), radiance.to_float())];
    for ends in knots.windows(2) {
        let &[near, far] = ends else { continue };
        let near = format.binary64(near);
        let width = format.binary64(far) - &near;
        let at = |node: &MpfrReal| width.clone() * node + &near;
        let lambda: Vec<MpfrReal> = rule.nodes.iter().map(at).collect();
        let transfers = case.transfers(&case.fields(&lambda));
        let (mut all, mut light) = (format.int(0), format.int(0));
        let nodes = rule.weights.iter().zip(&rule.integrals);
        let values = transfers.emission.iter().zip(&transfers.extinction);
        for ((weight, row), (emission, extinction)) in nodes.zip(values) {
            let mut inside = format.int(0);
            for (part, extinction) in row.iter().zip(&transfers.extinction) {
                inside += &(part.clone() * extinction);
            }
            let here = inside * &width + &depth;
            let source = emission.clone() * extinction * weight;
            light += &(source * &(-here).exp());
            all += &(extinction.clone() * weight);
        }
        radiance += &(light * &width);
        depth += &(all * &width);
        found.push((depth.to_float(), radiance.to_float()));
    }
    found
}

//! What roundoff may do: a bound of `|Q_f − Q_∞|/|Q_∞|` known before the run.
//!
//! The model is fl(a ∘ b) = (a ∘ b)(1 + δ) + ε, |δ| ≤ u and |ε| ≤ η: η = 0 where nothing underflows, u = 0 in a
//! fixed-point format. Exponentials are good to 2 u. C and τ come in with v units of error (v = 1 for rounded
//! constants), d with 1; so x = τ d has X = v + 2. To first order, all C, τ ≥ 0 and τ d ≤ 1 where opacities are linear;
//! ρ stands for the sum, and ρ/(1 − ρ) for all orders together.
//!
//! **Floating point.** α has a units: X + 2 by expm1, X + 4 by the relative opacity, X if linear. x e^(−x) ≤ 1 − e^(−x)
//! is why X is enough. By subtraction it has X + 1 and an absolute 2 u besides, that of e^(−x).
//!
//! Compositing: a term C α T has a + v + 2 units and those of T; summing adds n (naive, back to front), log₂ n + 1
//! (pairwise, tree) or 3 + 2 n² u (Neumaier). T from opacities is rounded twice a segment, 2 n units; what α is off
//! by, e = α a u, changes T behind it, and that changes the radiance by no more than e T max C, since
//! Σ α T ≤ 1 behind any segment: summed, a u max C (1 − T(D)), or a/g units with g = Q/(max C (1 − T(D))), which is 1 in
//! a slab. The absolute 2 u of the subtraction add, here and there, 4 n max C/Q units. T = e^(−t) from depths is off by
//! t (X + s) + 2 units, s being what the sum of the depths adds; Σ t α T ≤ Σ α T in a slab, so that t counts as 1 there
//! and as t(D) elsewhere. T as what remains has the product's unit as one more of α, and n of its own; where it is
//! summed otherwise than naively, the sum of 1 and what is absorbed, at most 2, is off by an absolute 2 log₂ n + 2 or
//! 4 n² u units, each of which counts as n max C/Q.
//!
//! Nested rules: all weights and terms are positive. t has v + 6 + n units, counted as in T from depths (up to 3 times under
//! Simpson's weights, since x/sinh x ≤ 1); products, weights, d and the sum add 2 v + 10 + n.
//!
//! Pre-integration: a segment's own radiance has c units: in closed form 4 for each of at most bits + 16 terms of its
//! series, whose sizes add up to at most e, and 6 a piece of depth 1; by N trapezoids N + 10 + N (N + 6), as
//! the first node's weight is 1/(2 N) beside t e^(−t) ≤ 1/e. T has X + 8 (or N + 8) for the depth and 3 n, the sum n.
//!
//! **Underflow** leaves ε, n K η in all, with K = (bits + 26) max(1, C) max(1, τ) max(1, d).
//!
//! **Fixed point.** Sums are exact. x is off by ε = η (τ + d + 1), α by ε + 2 η, and a segment changes I by no more than
//! max(1, C) (2 (ε + 2 η) + 6 η): n times that; with T from depths, min(n, t + 1) (n ε + η) besides. Nested rules: T is
//! off by n ε′ + η with ε′ = 3 η d + τ η + η, a term by max C τ times that and η (τ + C + 5), the sum by n times this,
//! which d shrinks and η n τ C enlarges. Pre-integration: nothing is promised.

use super::method::Kind;
use super::range::Rounding;
use crate::method::{Accumulation, Compositing, CompositingOrder, OpacityFormula, Summation};

/// What the bound depends on besides method and format.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facts {
    /// n.
    pub(super) n: f64,
    /// The same everywhere.
    pub(super) uniform: bool,
    /// v.
    pub(super) input: f64,
    /// t(D), that of the method's own samples where it is larger.
    pub(super) depth: f64,
    /// The largest τ d of a segment.
    pub(super) thickest: f64,
    /// The largest τ.
    pub(super) extinction: f64,
    /// The largest C.
    pub(super) emission: f64,
    /// d.
    pub(super) step: f64,
    /// max C/Q_∞.
    pub(super) inverse: f64,
    /// 1/g.
    pub(super) contrast: f64,
    /// log₂ of the largest numbers, which may lie beyond binary64: C, τ, d, 1/Q_∞.
    pub(super) logs: [f64; 4],
}

/// The bounds of one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promise {
    /// By the roundings of a format without ends.
    pub(super) roundoff: f64,
    /// What underflow may add.
    pub(super) underflow: f64,
}

impl Promise {
    /// Digits for such a relative error, at least 0.
    pub(super) fn digits(error: f64) -> f64 {
        if error < 1.0 { -error.log10() } else { 0.0 }
    }
}

pub(super) fn promise(kind: Kind, facts: &Facts, rounding: &Rounding) -> Promise {
    if rounding.is_absolute() {
        let roundoff = fixed(kind, facts, rounding.log2_quantum.exp2());
        return Promise {
            roundoff,
            underflow: 0.0,
        };
    }
    let u = rounding.unit;
    let first = u * match kind {
        Kind::Trapezoid | Kind::Simpson => nested(kind, facts),
        Kind::Composited(compositing) => composited(compositing, facts, u),
        Kind::ClosedSegments => {
            let bits = f64::from(rounding.bits);
            let own = 20.0 + 4.0 * (bits + 16.0) + 6.0 * (facts.thickest.ceil() + 1.0);
            preintegrated(own, 8.0, facts)
        }
        Kind::SubIntervals(count) => {
            let count = f64::from(count);
            let own = count + 10.0 + count * (count + 6.0);
            preintegrated(own, count + 8.0, facts)
        }
    };
    let roundoff = if first < 0.5 {
        first / (1.0 - first)
    } else {
        f64::INFINITY
    };
    let [emission, extinction, step, inverse] = facts.logs;
    let larger: f64 = [emission, extinction, step]
        .map(|log| log.max(0.0))
        .iter()
        .sum();
    let terms = facts.n * (f64::from(rounding.bits) + 26.0);
    let underflow = terms.log2() + rounding.log2_quantum + larger + inverse;
    Promise {
        roundoff,
        underflow: underflow.exp2(),
    }
}

/// How much the units of t count.
fn weight_of_depth(facts: &Facts, uniform: f64) -> f64 {
    if facts.uniform {
        uniform
    } else {
        facts.depth.max(uniform)
    }
}

fn nested(kind: Kind, facts: &Facts) -> f64 {
    let (weight, inner) = match kind {
        Kind::Simpson => (3.0, 3.0),
        _ => (1.0, 0.0),
    };
    let depth = facts.input + 6.0 + inner + facts.n;
    weight_of_depth(facts, weight) * depth + 2.0 * facts.input + 12.0 + facts.n
}

fn composited(compositing: Compositing, facts: &Facts, u: f64) -> f64 {
    let Facts { n, input, .. } = *facts;
    let x = input + 2.0;
    let (opacity, absolute) = match compositing.opacity {
        OpacityFormula::Subtraction => (x + 1.0, 4.0 * n * facts.inverse),
        OpacityFormula::Expm1 => (x + 2.0, 0.0),
        OpacityFormula::Relative => (x + 4.0, 0.0),
        OpacityFormula::Linear => (x, 0.0),
    };
    let term = opacity + input + 2.0 + absolute;
    let levels = n.log2().ceil() + 1.0;
    let summed = |summation| match summation {
        Summation::Naive => n,
        Summation::Pairwise => levels,
        Summation::Neumaier => 3.0 + 2.0 * n * n * u,
    };
    let from_opacities = opacity * facts.contrast + 2.0 * n;
    match compositing.order {
        CompositingOrder::FrontToBack {
            depth, summation, ..
        } => {
            let transmittance = match depth {
                Accumulation::Transmittances => from_opacities,
                Accumulation::Depths => weight_of_depth(facts, 1.0) * (x + summed(summation)) + 2.0,
                Accumulation::Remainder => {
                    let absorbed = match summation {
                        Summation::Naive => n,
                        Summation::Pairwise => 2.0 * levels * n * facts.inverse,
                        Summation::Neumaier => 1.0 + 4.0 * n * n * u * n * facts.inverse,
                    };
                    (opacity + 1.0) * facts.contrast + absorbed
                }
            };
            term + summed(summation) + transmittance
        }
        CompositingOrder::BackToFront => term + n + from_opacities,
        CompositingOrder::Tree => term + 2.0 * levels + from_opacities,
    }
}

fn preintegrated(own: f64, of_depth: f64, facts: &Facts) -> f64 {
    let depth = facts.input + 2.0 + of_depth;
    facts.input + own + weight_of_depth(facts, 1.0) * depth + 4.0 * facts.n + 2.0
}

/// The absolute bound, divided by Q_∞.
fn fixed(kind: Kind, facts: &Facts, eta: f64) -> f64 {
    let Facts {
        n,
        extinction,
        emission,
        step,
        ..
    } = *facts;
    let x = eta * (extinction + step + 1.0);
    let largest = emission.max(1.0);
    let absolute = match kind {
        // A quotient is off by more than quanta; of series nothing is known.
        Kind::Composited(Compositing {
            opacity: OpacityFormula::Relative,
            ..
        })
        | Kind::ClosedSegments
        | Kind::SubIntervals(_) => f64::INFINITY,
        Kind::Composited(compositing) => {
            let own = n * largest * (2.0 * (x + 2.0 * eta) + 6.0 * eta);
            match compositing.order {
                CompositingOrder::FrontToBack {
                    depth: Accumulation::Depths,
                    ..
                } => own + largest * n.min(facts.depth + 1.0) * (n * x + eta),
                _ => own,
            }
        }
        Kind::Trapezoid | Kind::Simpson => {
            let segment = 3.0 * eta * step + extinction * eta + eta;
            let transmittance = n * segment * 1.5 + eta;
            let source = emission * extinction;
            let term = source * transmittance + eta * (extinction + emission + 5.0);
            1.5 * n * term * step + eta * (2.0 * n * source + 1.0) + n * eta * eta
        }
    };
    let [.., inverse] = facts.logs;
    absolute * inverse.exp2()
}

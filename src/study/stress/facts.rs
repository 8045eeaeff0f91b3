//! What a bound depends on, from the medium's values without rounding.

use super::exact::ORACLE_BITS;
use super::medium::Medium;
use super::method::Kind;
use super::places::Places;
use super::promise::Facts;
use crate::case::{Case, Nodes, Transfer};
use crate::real::{Mpfr, MpfrReal, Real};
use rug::{Float, Rational};

/// The facts of one medium on n segments whose approximation is `approximation`.
pub(super) fn facts(medium: &Medium, n: u64, kind: Kind, approximation: &Float) -> Facts {
    let format = Mpfr { bits: ORACLE_BITS };
    let places = Places::new(medium, format);
    let step = Float::with_val(ORACLE_BITS, medium.length() / n);
    let mut largest = Largest::default();
    let depth = if medium.is_uniform() {
        largest.see(places.march(1).take(1));
        Float::with_val(ORACLE_BITS, &largest.extinction * &step) * n
    } else {
        // Whichever places a method looks at.
        let mut depth = largest.see(places.march_inside(n, Rational::from((1, 2)))) * &step;
        let inside = match kind {
            Kind::SubIntervals(count) => u64::from(count),
            Kind::Simpson => 2,
            _ => 1,
        };
        for parts in [1, inside] {
            let finer = n.saturating_mul(parts);
            let sum = largest.see(places.march(finer)) * &step / parts;
            if sum > depth {
                depth = sum;
            }
        }
        depth
    };
    let log2 = |x: &Float| MpfrReal::from(x.clone()).log2_abs();
    let inverse = Float::with_val(ORACLE_BITS, &largest.emission / approximation).abs();
    let thickest = Float::with_val(ORACLE_BITS, &largest.extinction * &step);
    let (depth, inverse) = (depth.to_f64(), inverse.to_f64());
    Facts {
        n: n as f64,
        uniform: medium.is_uniform(),
        input: if matches!(medium, Medium::Ramp { .. } | Medium::Polyline(_)) {
            4.0
        } else {
            1.0
        },
        depth,
        thickest: thickest.to_f64(),
        extinction: largest.extinction.to_f64(),
        emission: largest.emission.to_f64(),
        step: step.to_f64(),
        inverse,
        contrast: inverse * depth.min(1.0),
        logs: [
            log2(&largest.emission),
            log2(&largest.extinction),
            log2(&step),
            -log2(approximation),
        ],
    }
}

/// The largest |C| and |τ| so far.
struct Largest {
    emission: Float,
    extinction: Float,
}

impl Default for Largest {
    fn default() -> Self {
        Largest {
            emission: Float::new(ORACLE_BITS),
            extinction: Float::new(ORACLE_BITS),
        }
    }
}

impl Largest {
    /// Looks at some places; returns Σ τ.
    fn see(&mut self, transfers: impl Iterator<Item = Transfer<MpfrReal>>) -> Float {
        let mut sum = Float::new(ORACLE_BITS);
        for transfer in transfers {
            let (emission, extinction) = (transfer.emission.abs(), transfer.extinction.abs());
            sum += extinction.as_float();
            self.emission.max_mut(emission.as_float());
            self.extinction.max_mut(extinction.as_float());
        }
        sum
    }
}

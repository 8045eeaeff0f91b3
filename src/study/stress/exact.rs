//! Q_∞: what a method gives on n segments without rounding.
//!
//! Of a slab it has a closed form for every n, so that 2²⁴ segments cost nothing. With x = κ d, t = n x and
//! r = e^(−x), in units of C:
//!
//! | method | Q_∞ |
//! |---|---|
//! | exact opacities; closed pre-integration | 1 − e^(−t), whatever n |
//! | linear opacities, T from them | 1 − (1 − x)ⁿ |
//! | linear opacities, T from depths | x (1 − e^(−t))/(1 − r) |
//! | trapezoid in trapezoid | x/2 (1 + r)/(1 − r) (1 − e^(−t)) |
//! | Simpson in Simpson | x/3 (1 + 4 r + r²)/(1 − r²) (1 − e^(−t)) |
//! | pre-integration by N trapezoids | that of the trapezoid with x/N for x |
//!
//! all geometric sums. Other media are run in MPFR on their few segments.

use super::medium::Medium;
use super::method::Kind;
use super::places::Places;
use crate::case::{Case, HomogeneousSlab};
use crate::method::{Accumulation, CompositingOrder, Method, MethodError, OpacityFormula};
use crate::real::{Mpfr, MpfrReal};
use rug::ops::Pow;
use rug::{Float, Rational};

/// Bits of the oracle.
pub const ORACLE_BITS: u32 = 256;

/// What is known without rounding of one method on one medium.
#[derive(Clone, Debug)]
pub struct Exact {
    /// Q_∞.
    pub approximation: Float,
    /// I, where it has a closed form.
    pub radiance: Option<Float>,
    /// t(D), where it has a closed form.
    pub depth: Option<Float>,
    /// e^(−t(D)) is no number of MPFR's range.
    pub underflows: bool,
}

/// Q_∞ and I.
///
/// # Errors
/// [`MethodError`] where n does not suit the method.
pub fn exact(medium: &Medium, method: &Method, kind: Kind, n: u64) -> Result<Exact, MethodError> {
    method.check_segments(n)?;
    let format = Mpfr { bits: ORACLE_BITS };
    let end = MpfrReal::from(float(&medium.length()));
    let depth: Option<Float> = medium.optical_depth(&end).map(Float::from);
    let transmittance = depth.as_ref().map(|depth| (-depth.clone()).exp());
    let approximation = match medium {
        Medium::Slab(slab) => of_slab(slab, kind, n),
        _ => method.radiance(&Places::new(medium, format), n)?.into(),
    };
    Ok(Exact {
        approximation,
        radiance: medium.radiance(&end).map(Float::from),
        depth,
        underflows: transmittance.is_some_and(|t| t.is_zero()),
    })
}

fn float(q: &Rational) -> Float {
    Float::with_val(ORACLE_BITS, q)
}

/// 1 − e^(−x).
fn opacity(x: &Float) -> Float {
    -(-x.clone()).exp_m1()
}

fn of_slab(slab: &HomogeneousSlab, kind: Kind, n: u64) -> Float {
    let depth = Rational::from(&slab.extinction * &slab.length);
    let emission = float(&slab.emission);
    if depth == 0 {
        return Float::new(ORACLE_BITS);
    }
    let t = float(&depth);
    let x = float(&Rational::from(&depth / n));
    let units = match kind {
        Kind::Composited(compositing) if compositing.opacity == OpacityFormula::Linear => {
            match compositing.order {
                CompositingOrder::FrontToBack {
                    depth: Accumulation::Depths,
                    ..
                } => opacity(&t) * &x / opacity(&x),
                _ => by_linear_opacities(&x, n),
            }
        }
        Kind::Trapezoid => opacity(&t) * mean_by_trapezoid(&x),
        Kind::Simpson => {
            let r = (-x.clone()).exp();
            let sum = Float::with_val(ORACLE_BITS, &r + 4_u32) * &r + 1_u32;
            let twice = Float::with_val(ORACLE_BITS, &x * 2_u32);
            opacity(&t) * sum * &x / 3_u32 / opacity(&twice)
        }
        Kind::SubIntervals(count) => opacity(&t) * mean_by_trapezoid(&(x / count)),
        Kind::Composited(_) | Kind::ClosedSegments => opacity(&t),
    };
    units * emission
}

/// x/2 (1 + r)/(1 − r).
fn mean_by_trapezoid(x: &Float) -> Float {
    let both = (-x.clone()).exp() + 1_u32;
    both * x / 2_u32 / opacity(x)
}

/// 1 − (1 − x)ⁿ.
fn by_linear_opacities(x: &Float, n: u64) -> Float {
    if *x < 1 {
        // Without cancellation where x is small.
        let log = (-x.clone()).ln_1p() * n;
        -log.exp_m1()
    } else {
        let factor = Float::with_val(ORACLE_BITS, 1 - x);
        1 - factor.pow(n)
    }
}

//! Compositing and nested rules keep their laws in every format, within bounds that are derived.
//!
//! The model: fl(a ∘ b) = (a ∘ b)(1 + δ) + ε with |δ| ≤ u and |ε| ≤ η, where ε belongs to products alone: half the least
//! subnormal number, and in fixed point half a quantum with u = 0. Sums do not underflow.
//!
//! **The bound of compositing**, for N segments with C, α ∈ [0, 1], α being the number that the format has (so that its
//! formula does not matter): let E = |ΔI| + |ΔT| against the exact composite of the same C and α.
//!
//! Front to back an exact step takes (ΔI, ΔT) to (ΔI + C α ΔT, (1 − α) ΔT), and C α + 1 − α ≤ 1: it does not enlarge E.
//! Rounding adds to T' = T (1 − α) two roundings, to C α T two, to I' one: at most
//! ((1 + u)³ − 1)(T (1 − α) + C α T + I) + 4 η, and T (1 − α) + C α T + I ≤ T + I ≤ 1 + E. So 1 + E grows by (1 + u)³ a step:
//!
//! ```text
//! E ≤ B(N) = (1 + u)^(3N) (1 + 4 N η) − 1
//! ```
//!
//! Back to front I' = I (1 − α) + C α has two roundings and one more, on I ≤ 1 + E: the same. In a tree a leaf (C α, 1 − α)
//! has one rounding and η each; a merge multiplies, (1 + E) ≤ (1 + E₁)(1 + E₂), since I₁ + T₁ I₂ and T₁ T₂ are the
//! composite of two stretches of I + T ≤ 1, and rounds twice: N leaves and N − 1 merges stay within (1 + u)^(3N).
//!
//! For binary32 this is a little below the theorem N·2⁻²² = 4 N u, which a proof assistant has checked.

mod columns;
mod compositing;
mod nested;
mod scaling;

use rug::{Float, Rational};
use volver::real::{FormatName, Real};

/// The formats of every property.
const FORMATS: [&str; 13] = [
    "f16",
    "bf16",
    "f32",
    "f64",
    "f32-lanes",
    "f64-lanes",
    "tf32",
    "fp8-e5m2",
    "ieee:17,-126,127",
    "fixed:15",
    "mpfr:40",
    "mpfr:200",
    "fixed:2.8",
];

/// u and η of a format.
#[derive(Clone, Copy, Debug)]
struct Rounding {
    unit: f64,
    quantum: f64,
}

impl Rounding {
    fn of(format: FormatName) -> Self {
        let floating = |bits: i32, emin: i32| Rounding {
            unit: 2_f64.powi(-bits),
            // That of binary64 is below binary64.
            quantum: 2_f64.powi((emin - bits).max(-1074)),
        };
        match format {
            FormatName::F16 => floating(11, -14),
            FormatName::Bf16 => floating(8, -126),
            FormatName::F32 | FormatName::F32Lanes => floating(24, -126),
            FormatName::F64 | FormatName::F64Lanes => floating(53, -1022),
            FormatName::Ieee(format) => {
                let bits = volver::real::Format::bits(format).cast_signed();
                floating(bits, format.emin())
            }
            FormatName::Fixed(format) => Rounding {
                unit: 0.0,
                quantum: 2_f64.powi(-1 - format.fraction_bits().cast_signed()),
            },
            FormatName::Mpfr(bits) => Rounding {
                unit: 2_f64.powi(-bits.cast_signed()),
                quantum: 0.0,
            },
        }
    }

    /// B(N), a little enlarged for its own rounding.
    fn bound(self, n: u64) -> f64 {
        let n = n as f64;
        let log = 3.0 * n * self.unit.ln_1p() + (4.0 * n * self.quantum).ln_1p();
        log.exp_m1() * (1.0 + 1e-12)
    }
}

/// |x|, of no more than binary64's bits.
fn size(x: Rational) -> f64 {
    Float::with_val(64, x.abs()).to_f64()
}

/// The exact value.
fn exact<R: Real>(x: &R) -> Rational {
    x.to_rational().unwrap()
}

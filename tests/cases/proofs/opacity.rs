//! `Opacity.v`: what the two ways to an opacity lose in binary32.

use super::theory;
use rug::Float;
use volver::method::OpacityFormula;

/// Of what is exact here: binary32 and the bounds have no more than 48 of them.
const BITS: u32 = 120;

/// 1 − e^(−x).
fn exact(x: f32) -> Float {
    -Float::with_val(BITS, -x).exp_m1()
}

/// |computed − exact|.
fn lost(formula: OpacityFormula, x: f32, exact: &Float) -> Float {
    Float::with_val(BITS, formula.of(&x) - exact).abs()
}

#[test]
fn opacities_round_as_proved() {
    let theory = theory("Opacity.v");
    for bound in [
        "relative_error_at_most (/ 2 ^ 23) (rnd (- expm1)) (1 - exp (- x)).",
        "Rabs (rnd (1 - e) - (1 - exp (- x))) <= / 2 ^ 23.",
        "relative_error_at_most (/ 2 ^ 13) (rnd (1 - e)) (1 - exp (- x)).",
    ] {
        assert!(theory.contains(bound), "{bound}");
    }
    let unit = Float::with_val(BITS, 1) >> 23;
    // All depths from 2⁻³⁰ to 32, two million of them.
    for bits in (0x3080_0000_u32..0x4200_0000).step_by(143) {
        let x = f32::from_bits(bits);
        let alpha = exact(x);
        let by_expm1 = lost(OpacityFormula::Expm1, x, &alpha);
        assert!(by_expm1 <= Float::with_val(BITS, &unit * &alpha), "{x:e}");
        let by_subtraction = lost(OpacityFormula::Subtraction, x, &alpha);
        assert!(by_subtraction <= unit, "{x:e}");
        if alpha >= 1.0 / 1024.0 {
            let most = Float::with_val(BITS, &alpha) >> 13;
            assert!(by_subtraction <= most, "{x:e}");
        }
    }
}

/// At α near 2⁻¹⁰ subtraction loses more than 2⁻¹⁶ of α even where exp is rounded correctly, which leaves up
/// to 2⁻²⁵ beside 1; an exp as inaccurate as the theorem's witness loses four times as much.
#[test]
fn subtraction_loses_where_the_theorem_says() {
    let losses = (0..1000_u16).map(|k| {
        let x = f32::from(1025 + k % 16) * 2_f32.powi(-20) + f32::from(k) * 2_f32.powi(-33);
        let exact = exact(x);
        (lost(OpacityFormula::Subtraction, x, &exact) / exact).to_f64()
    });
    let most = losses.fold(0.0, f64::max);
    assert!(most > 2_f64.powi(-16), "{most:e}");
}

//! Rays through thousands of thin media, in binary32: what they let through is kept.

use super::{plan, read};
use rug::{Float, Rational};
use std::fmt::Write;
use volver::real::FormatName;

const COUNT: u32 = 2048;
/// Where e^(−τ/COUNT) is rounded by 0.44 units to the same side in every medium.
const EXTINCTION: (u32, u32) = (2104, 1024);
/// Products alone would take more than this: 2,048 · 0.44 units of 2⁻²⁴ of what is seen through half of them.
const TOLERANCE: f64 = 1e-5;

/// C of a medium, a number of few bits.
fn emission(k: u32) -> Rational {
    Rational::from((k * 37 % 64, 64))
}

/// Σ Tₖ Cₖ (1 − p) with p = e^(−τ/COUNT), Tₖ = pᵏ, and a background of 1 behind all.
fn radiance() -> Float {
    let bits = 200;
    let depth = Rational::from(EXTINCTION) / COUNT;
    let passes = Float::with_val(bits, -depth).exp();
    let opacity = Float::with_val(bits, 1 - &passes);
    let mut through = Float::with_val(bits, 1);
    let mut radiance = Float::with_val(bits, 0);
    for k in 0..COUNT {
        radiance += Float::with_val(bits, &through * &opacity) * emission(k);
        through *= &passes;
    }
    radiance + through
}

#[test]
fn thousands_of_thin_media_are_planned_in_binary32() {
    let mut text = String::from("background = 1\n");
    let (numerator, denominator) = EXTINCTION;
    for k in 0..COUNT {
        let (from, to) = (k, k + 1);
        let medium = format!(
            "[[media]]\nfrom = \"{from}/{COUNT}\"\nto = \"{to}/{COUNT}\"\nkind = \"constant\"\nextinction = \"{numerator}/{denominator}\"\nemission = \"{}\"",
            emission(k)
        );
        writeln!(text, "{medium}").unwrap();
    }
    let scene = read(&text);
    let plan = plan(&scene, TOLERANCE, "thin media");
    assert_eq!(plan.format(), FormatName::F32);
    let found = plan.run::<f32>().unwrap();
    let error = (Float::with_val(200, found.radiance[0]) - radiance()).abs();
    let claimed = plan.stored().uncertainty.rounding;
    // All models are exact: what is off is rounding, as it is foreseen.
    let part = error.to_f64() / claimed;
    assert!((1.0 / 3.0..=3.0).contains(&part), "{error} of {claimed}");
}

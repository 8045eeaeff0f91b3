//! Two powers of the step, and where they cross.

use rug::Float;
use rug::ops::Pow;
use volver::convergence::{Sample, TransitionError, transition};
use volver::real::{MpfrReal, Real};

fn samples(bits: u32, floor: f64, error: impl Fn(Float) -> Float) -> Vec<Sample> {
    (3..10)
        .map(|k| {
            let step = 0.5_f64.powi(k);
            Sample {
                n: Some(1 << k),
                step,
                error: error(Float::with_val(bits, step)),
                floor: Float::with_val(53, floor),
            }
        })
        .collect()
}

fn two_terms(d: Float) -> Float {
    -3_i32 * d.clone().pow(3_u32) + Float::with_val(200, 0.01) * d.pow(2_u32)
}

#[test]
fn both_terms_and_their_crossover_are_found() {
    let found = transition(&samples(200, 0.0, two_terms), 3.0, 2.0).unwrap();
    assert!((found.high.to_f64() + 3.0).abs() < 1e-12);
    assert!((found.low.to_f64() - 0.01).abs() < 1e-12);
    assert!(found.residual < 1e-12);
    // 3 d³ = 0.01 d²: n* = 300.
    assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 1e-6);
}

#[test]
fn magnitudes_do_not_matter() {
    let tiny = Float::with_val(200, 10).pow(-2000_i32);
    let found = transition(&samples(200, 0.0, |d| two_terms(d) * &tiny), 3.0, 2.0).unwrap();
    assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 1e-6);
    assert!(
        (MpfrReal::from(found.high).log2_abs() - (3_f64.log2() - 2000.0 * 10_f64.log2())).abs()
            < 1e-6
    );
}

#[test]
fn a_third_term_shows_in_the_residual_and_moves_the_crossover_little() {
    let third = |d: Float| two_terms(d.clone()) + 0.3 * d.pow(4_u32);
    let found = transition(&samples(200, 0.0, third), 3.0, 2.0).unwrap();
    assert!(
        found.residual > 1e-5 && found.residual < 1e-2,
        "{}",
        found.residual
    );
    assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 6.0);
}

#[test]
fn a_single_term_has_no_crossover() {
    let cubic = transition(&samples(53, 0.0, |d| 3_u32 * d.pow(3_u32)), 3.0, 2.0).unwrap();
    assert_eq!(cubic.crossover, None);
    assert!((cubic.high.to_f64() - 3.0).abs() < 1e-12);
    let quadratic = transition(&samples(53, 0.0, |d| 3_u32 * d.pow(2_u32)), 3.0, 2.0).unwrap();
    assert_eq!(quadratic.crossover, None);
    // Scatter that the low term could explain is no proof of it.
    let mut sign = 1.0;
    let mut noisy = samples(53, 0.0, |d| 3_u32 * d.pow(3_u32));
    for sample in &mut noisy {
        sample.error *= 1.0 + 0.02 * sign;
        sign = -sign;
    }
    assert_eq!(transition(&noisy, 3.0, 2.0).unwrap().crossover, None);
}

#[test]
fn a_term_as_small_as_the_floor_is_not_significant() {
    // At d = 1/512 the low term is 2e-9 d², 7e-15, and the error 2e-8.
    let hidden = |d: Float| 3_u32 * d.clone().pow(3_u32) + 2e-9 * d.pow(2_u32);
    let seen = transition(&samples(200, 0.0, hidden), 3.0, 2.0).unwrap();
    assert!(seen.crossover.is_some());
    let masked = transition(&samples(200, 1e-14, hidden), 3.0, 2.0).unwrap();
    assert_eq!(masked.crossover, None);
}

#[test]
fn only_the_finest_four_levels_above_the_floor_count() {
    let mut disturbed = samples(200, 1e-12, two_terms);
    // Coarse levels and those at the floor say anything.
    disturbed[0].error = Float::with_val(53, 100);
    disturbed[5].error = Float::with_val(53, 2.9e-11);
    disturbed[6].error = Float::with_val(53, f64::NAN);
    let found = transition(&disturbed, 3.0, 2.0).unwrap();
    assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 1e-3);
    disturbed.remove(1);
    disturbed.remove(1);
    assert_eq!(
        transition(&disturbed, 3.0, 2.0),
        Err(TransitionError::TooFewLevels { usable: 3 })
    );
}

#[test]
fn orders_and_steps_that_say_nothing_are_refused() {
    let good = samples(53, 0.0, two_terms);
    for (high, low) in [
        (2.0, 3.0),
        (2.0, 2.0),
        (f64::NAN, 1.0),
        (f64::INFINITY, 1.0),
    ] {
        assert!(matches!(
            transition(&good, high, low),
            Err(TransitionError::Orders { .. })
        ));
    }
    let mut same = good.clone();
    for sample in &mut same {
        sample.step = 0.1;
    }
    assert_eq!(transition(&same, 3.0, 2.0), Err(TransitionError::Singular));
    for sample in &mut same {
        sample.step = 0.0;
    }
    assert_eq!(transition(&same, 3.0, 2.0), Err(TransitionError::Singular));
}

//! Models of errors that follow the laws exactly, and of a random walk.

use crate::convergence::random::Random;
use rug::Float;
use volver::convergence::{ErrorModel, RoundoffLaw, Split};

const BITS: u32 = 24;

fn float(x: f64) -> Float {
    Float::with_val(64, x)
}

/// A level where the parts are what they are given as.
fn level(discretization: f64, input: f64, arithmetic: f64) -> Split {
    Split {
        total: float(discretization + input + arithmetic),
        discretization: float(discretization),
        truncation: float(0.0),
        input: float(input),
        arithmetic: float(arithmetic),
        of_depth: Some(float(arithmetic / 4.0)),
        resolution: float(1e-40),
        bits: 256,
    }
}

/// D = a n^−p and A = b n^q at n = 8 … 1024.
fn model(a: f64, p: f64, b: f64, q: f64) -> ErrorModel {
    let splits: Vec<(u64, Split)> = (3..=10)
        .map(|k| {
            let n = f64::from(1 << k);
            (1_u64 << k, level(a * n.powf(-p), 0.0, b * n.powf(q)))
        })
        .collect();
    let splits: Vec<(u64, &Split)> = splits.iter().map(|(n, split)| (*n, split)).collect();
    ErrorModel::new(&splits, BITS, Some(p))
}

#[test]
fn laws_that_hold_exactly_are_found() {
    let unit = 0.5_f64.powi(24);
    let model = model(1.0, 2.0, 0.75 * unit, 0.5);
    let law = model.laws.arithmetic.unwrap();
    assert!((law.exponent - 0.5).abs() < 1e-12 && law.half_width < 1e-6);
    assert!((law.log2_constant - 0.75_f64.log2()).abs() < 1e-12);
    assert_eq!(law.levels, 8);
    assert!((law.log2_at(20.0, 24.0) - (0.75_f64.log2() - 24.0 + 10.0)).abs() < 1e-10);
    // A quarter of it comes of the depth, three quarters of the radiance.
    let of = |law: Option<RoundoffLaw>| law.unwrap().log2_constant;
    assert!((of(model.laws.of_depth) - 0.1875_f64.log2()).abs() < 1e-12);
    assert!((of(model.laws.of_radiance) - 0.5625_f64.log2()).abs() < 1e-12);
    // There is no input rounding to fit a law to.
    assert_eq!(model.laws.input, None);
}

/// n* = (a/b)^(1/(p+q)); the least of a² n^−2p + b² n^2q lies at n^(2(p+q)) = p a²/(q b²).
#[test]
fn the_crossing_and_the_best_accuracy_are_those_in_closed_form() {
    for (a, p, b, q) in [
        (1.0, 2.0, 1e-8, 0.5),
        (0.3, 1.0, 6e-8, 1.0),
        (4.0, 4.0, 1e-16, 0.25),
        // Beyond the finest level: carried on by the order.
        (1.0, 1.0, 1e-12, 0.5),
    ] {
        let model = model(a, p, b, q);
        let crossing = (a / b).powf(1.0 / (p + q));
        let found = model.crossing().unwrap();
        // The search steps by 2^(1/32).
        assert!(
            (found / crossing).log2().abs() < 1.0 / 16.0,
            "{found} for {crossing}"
        );
        let n = (p * a * a / (q * b * b)).powf(0.5 / (p + q));
        let error = (a * n.powf(-p)).hypot(b * n.powf(q));
        let best = model.best().unwrap();
        assert!((best.log2_n - n.log2()).abs() < 1.0 / 16.0);
        assert!((best.log2_error - error.log2()).abs() < 0.01);
    }
}

/// Roundoff scales with 2^−bits and nothing else does.
#[test]
fn the_fewest_bits_for_a_tolerance_reach_it_and_one_less_does_not() {
    let model = model(1.0, 2.0, 1e-8, 0.5);
    for log2_tolerance in [-10.0, -20.0, -40.0, -100.0] {
        let bits = model.bits_for(log2_tolerance).unwrap();
        let best = |bits: u32| {
            let b = 1e-8 * f64::from(24_i32 - bits.cast_signed()).exp2();
            let n = (2.0 / (0.5 * b * b)).powf(0.5 / 2.5);
            n.powf(-2.0).hypot(b * n.sqrt()).log2()
        };
        assert!(
            best(bits) <= log2_tolerance + 0.01,
            "{bits} for {log2_tolerance}"
        );
        assert!(
            best(bits - 1) > log2_tolerance - 0.01,
            "{bits} for {log2_tolerance}"
        );
    }
}

/// n⁻² ≤ 2⁻²⁰⁰ takes 2¹⁰⁰ segments.
#[test]
fn a_tolerance_that_takes_too_many_segments_has_no_bits() {
    assert_eq!(model(1.0, 2.0, 1e-8, 0.5).bits_for(-200.0), None);
}

#[test]
fn a_method_without_one_of_the_parts_has_no_crossing() {
    let exact: Vec<(u64, Split)> = (3..=10).map(|k| (1 << k, level(0.0, 0.0, 1e-8))).collect();
    let splits: Vec<(u64, &Split)> = exact.iter().map(|(n, split)| (*n, split)).collect();
    let model = ErrorModel::new(&splits, BITS, None);
    assert_eq!(model.crossing(), None);
    // Without discretization the coarsest level is the best.
    let best = model.best().unwrap();
    assert!((best.log2_error - 1e-8_f64.log2()).abs() < 1e-9);
    let clean: Vec<(u64, Split)> = (3..=10).map(|k| (1 << k, level(0.1, 0.0, 0.0))).collect();
    let splits: Vec<(u64, &Split)> = clean.iter().map(|(n, split)| (*n, split)).collect();
    assert_eq!(ErrorModel::new(&splits, BITS, Some(1.0)).crossing(), None);
    let none = ErrorModel::new(&[], BITS, Some(1.0));
    assert_eq!(
        (none.crossing(), none.best(), none.bits_for(-10.0)),
        (None, None, None)
    );
}

/// A few levels whose arithmetic rounding happens to fall promise nothing beyond them: what is rounded last is there at every n.
/// Independent errors of inputs do fall, as n^(−1/2).
#[test]
fn rounding_does_not_vanish_beyond_the_finest_level() {
    let falling = |input: f64, arithmetic: f64| {
        let splits: Vec<(u64, Split)> = (3..=8)
            .map(|k| {
                let n = f64::from(1 << k);
                (1_u64 << k, level(n.powi(-4), input / n, arithmetic / n))
            })
            .collect();
        let splits: Vec<(u64, &Split)> = splits.iter().map(|(n, split)| (*n, split)).collect();
        ErrorModel::new(&splits, BITS, Some(4.0))
    };
    let best = falling(0.0, 1e-6).best().unwrap();
    assert!((best.log2_error - (1e-6_f64.log2() - 8.0)).abs() < 0.01);
    let inputs = falling(1e-6, 0.0);
    let far = inputs.log2_rounding(28.0, f64::from(BITS));
    assert!((far - (1e-6_f64.log2() - 8.0 - 10.0)).abs() < 0.01);
}

/// What the oracle's own rounding may hide is no data.
#[test]
fn errors_below_the_resolution_are_left_out() {
    let errors: Vec<(u64, Float, Float)> = (3..=12)
        .map(|k| (1 << k, float(1e-9), float(if k < 7 { 1e-8 } else { 1e-12 })))
        .collect();
    assert_eq!(RoundoffLaw::fit(&errors, BITS).unwrap().levels, 6);
    assert_eq!(RoundoffLaw::fit(&errors[..7], BITS), None);
}

/// Normal errors whose deviation grows like √n: the interval holds ½ about as often as it says, and the
/// constant is that of the root mean square, not of the median.
#[test]
fn random_walks_have_the_exponent_one_half() {
    let mut random = Random::new(11);
    let trials = 400;
    let mut holds = 0;
    let mut constant = 0.0;
    for _ in 0..trials {
        let errors: Vec<(u64, Float, Float)> = (3..=12)
            .map(|k| {
                let n = f64::from(1 << k);
                (1_u64 << k, float(n.sqrt() * random.normal()), float(0.0))
            })
            .collect();
        let law = RoundoffLaw::fit(&errors, 0).unwrap();
        holds += i32::from((law.exponent - 0.5).abs() <= law.half_width);
        // At the middle of the ladder, where the slope does not matter.
        constant += law.log2_at(7.5, 0.0) - 3.75;
    }
    assert!(holds > trials * 88 / 100, "{holds} of {trials}");
    assert!((constant / f64::from(trials)).abs() < 0.3, "{constant}");
}

//! binary32 against binary64 of the C library: some arguments, and all of them.

use super::{FUNCTIONS, Function, results};
use std::num::NonZero;
use std::thread;
use volver::real::lanes::Width;

/// The largest error of results, in units in the last place of the truth.
fn worst(function: Function, row: &[f32], results: &[f32]) -> f64 {
    let mut worst: f64 = 0.0;
    for (&x, &result) in row.iter().zip(results) {
        let truth = function.of_f64(f64::from(x));
        #[allow(clippy::cast_possible_truncation)]
        let nearest = truth as f32;
        if truth.is_nan() || nearest.is_infinite() || result.is_infinite() {
            // Where the range ends it ends as rounding has it.
            assert!(
                result == nearest || (truth.is_nan() && result.is_nan()),
                "{function:?} of {x:e}: {result:e}, not {nearest:e}"
            );
            continue;
        }
        // Two neighbours of the truth differ by a unit; below the normal numbers all do by the same.
        let size = truth.abs().max(f64::from(f32::MIN_POSITIVE));
        let unit = f64::from_bits(size.to_bits() >> 52 << 52) * f64::from(f32::EPSILON);
        let error = (f64::from(result) - truth).abs() / unit;
        assert!(
            error <= function.units(),
            "{function:?} of {x:e}: {result:e}, {error} units off"
        );
        worst = worst.max(error);
    }
    worst
}

/// Whether results fall where arguments rise: bits of negative numbers rise as these fall.
fn falls(row: &[f32], results: &[f32]) -> bool {
    let both = row.windows(2).zip(results.windows(2));
    let mut known = both.filter(|(x, _)| x[0].is_finite() && x[1].is_finite());
    known.any(|(x, result)| {
        if x[0] < x[1] {
            result[1] < result[0]
        } else {
            result[1] > result[0]
        }
    })
}

/// Every pattern from `first` on, `count` of them.
fn patterns(first: u32, count: u32, stride: u32) -> Vec<f32> {
    (0..count)
        .map(|i| f32::from_bits(first.wrapping_add(i * stride)))
        .collect()
}

#[test]
fn some_of_binary32_are_within_their_units() {
    // A prime stride meets every exponent and every last digit.
    let row = patterns(0, 1 << 18, 16_381);
    let near = patterns(1.0_f32.to_bits(), 1 << 16, 37);
    for function in FUNCTIONS {
        for row in [&row, &near] {
            let one = results(Width::One, function, row);
            assert!(worst(function, row, &one) > 0.4, "a test of something");
            for width in Width::there() {
                let side_by_side = results(width, function, row);
                let same =
                    |(a, b): (&f32, &f32)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(
                    one.iter().zip(&side_by_side).all(same),
                    "{function:?} in {width}"
                );
            }
        }
    }
}

#[test]
#[ignore = "all 2³² numbers: minutes"]
fn all_of_binary32_are_within_their_units() {
    const BLOCK: u32 = 1 << 16;
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let threads = u32::try_from(threads).unwrap();
    let width = Width::current();
    thread::scope(|scope| {
        for thread in 0..threads {
            scope.spawn(move || {
                for block in (thread..BLOCK).step_by(threads as usize) {
                    let row = patterns(block * BLOCK, BLOCK, 1);
                    for function in FUNCTIONS {
                        let results = results(width, function, &row);
                        worst(function, &row, &results);
                        let is_monotone = matches!(function, Function::Exp | Function::ExpM1);
                        assert!(
                            !is_monotone || !falls(&row, &results),
                            "{function:?} at {:e}",
                            row[0]
                        );
                    }
                }
            });
        }
    });
}

#[test]
fn thin_segments_have_their_opacities() {
    // α of k units of 2⁻²⁴ is k units less the square: 1 − e^(−x) may be half a unit off, expm1 by none.
    let row: Vec<f32> = (1..=4096).map(|k| -(k as f32) * 2f32.powi(-24)).collect();
    let opacities = results(Width::current(), Function::ExpM1, &row);
    for (x, opacity) in row.iter().zip(&opacities) {
        let truth = f64::from(*x).exp_m1();
        let unit = f64::from_bits(truth.abs().to_bits() >> 52 << 52) * f64::from(f32::EPSILON);
        assert!((f64::from(*opacity) - truth).abs() <= unit, "{x:e}");
    }
}

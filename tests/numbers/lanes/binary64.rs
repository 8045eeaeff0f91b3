//! binary64 against MPFR: dense arguments, hard ones, and where functions end.

use super::{FUNCTIONS, Function, results};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::Float;
use std::f64::consts::{FRAC_PI_2, LN_2};
use volver::real::lanes::Width;

/// Enough for the nearest that a number of binary64 comes to a multiple of π/2.
const BITS: u32 = 160;

/// Where digits cancel or ranges end.
const HARD: [f64; 31] = [
    0.0,
    -0.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    1e-300,
    -1e-17,
    1.1e-17,
    -1e-9,
    1e-8,
    0.346_573_590_279_972_6,
    0.346_573_590_279_972_7,
    -0.346_573_590_279_972_65,
    36.7,
    37.5,
    -37.4,
    -39.9,
    -708.4,
    -744.4,
    -745.13,
    -745.14,
    -746.1,
    709.78,
    709.79,
    710.5,
    1e300,
    f64::MAX,
    -f64::MAX,
    1_048_576.0,
    1_048_577.5,
    1_048_575.9,
];

fn arguments() -> Vec<f64> {
    let mut random = Pcg64::seed_from_u64(1);
    let mut row = HARD.to_vec();
    // 6381956970095103 · 2⁷⁹⁷ is 2⁻⁶¹ from a multiple of π/2.
    row.push(6_381_956_970_095_103.0 * 2f64.powi(797));
    for i in 0..6_000_u32 {
        let part = random.next_u64() as f64 / 2f64.powi(64) - 0.5;
        let large = f64::from(random.next_u32() % 700_000);
        row.extend([
            part,
            1_500.0 * part,
            80.0 * part,
            2.1e6 * part,
            f64::from_bits(random.next_u64()),
            large * FRAC_PI_2,
            f64::from(i) * FRAC_PI_2,
            (f64::from(i % 2_000) - 999.5) * LN_2 * (1.0 + 1e-6 * part),
        ]);
    }
    row.retain(|x| x.is_finite());
    row.truncate(row.len() / 16 * 16);
    row
}

/// The error in units in the last place of the truth; `None` where the range ends, and ends as rounding has it.
fn error(truth: &Float, result: f64) -> Option<f64> {
    let nearest = truth.to_f64();
    if nearest.is_infinite() || result.is_infinite() {
        assert_eq!(nearest, result);
        return None;
    }
    let exponent = truth.get_exp().unwrap_or(-2_000).max(-1021);
    let off = Float::with_val(2_200, result) - truth;
    Some((off.abs() << (53 - exponent)).to_f64())
}

#[test]
fn binary64_is_within_its_units_of_mpfr() {
    let row = arguments();
    for function in FUNCTIONS {
        let one = results(Width::One, function, &row);
        let mut worst: f64 = 0.0;
        for (&x, &result) in row.iter().zip(&one) {
            let truth = function.by_mpfr(Float::with_val(BITS, x));
            if let Some(error) = error(&truth, result) {
                assert!(
                    error <= function.units(),
                    "{function:?} of {x:e}: {result:e}, {error} units off"
                );
                worst = worst.max(error);
            }
        }
        assert!(
            worst > 0.5,
            "{function:?} is not rounded correctly, {worst}"
        );
        for width in Width::there() {
            let side_by_side = results(width, function, &row);
            let same = one
                .iter()
                .zip(&side_by_side)
                .all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(same, "{function:?} in {width}");
        }
    }
}

#[test]
fn zeros_keep_their_signs() {
    let row = [-0.0_f64; 16];
    for function in [Function::ExpM1, Function::Sin] {
        let results = results(Width::current(), function, &row);
        assert!(
            results
                .iter()
                .all(|result| *result == 0.0 && result.is_sign_negative())
        );
    }
}

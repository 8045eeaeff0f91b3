//! The random numbers: the generator's own, the same everywhere, evenly spread, independent.

use half::f16;
use quickcheck::quickcheck;
use rug::{Integer, Rational};
use volver::quadrature::{Draw, Draws, Sampling};
use volver::real::{Format, Mpfr, Native, Real};

fn numerators(seed: u64, n: u64, count: usize) -> Vec<u64> {
    let mut draws = Draws::new(seed, n);
    (0..count).map(|_| draws.draw().numerator).collect()
}

/// From a Python program written after O'Neill (2014), section 6.3.3, whose PCG XSL RR 128/64 gives
/// numpy's `PCG64` outputs from numpy's state; its state filled as `rand_core`'s documentation of
/// `seed_from_u64` says (PCG32 words, little-endian).
#[test]
fn draws_are_those_of_an_independent_generator() {
    const EXPECTED: [(u64, u64, [u64; 4]); 4] = [
        (
            0,
            1,
            [
                7_564_909_391_151_301,
                155_812_612_888_405,
                1_025_935_399_264_694,
                8_854_219_913_528_956,
            ],
        ),
        (
            1,
            8,
            [
                1_996_411_753_175_996,
                7_324_413_504_670_057,
                2_300_494_305_498_231,
                1_833_101_091_603_199,
            ],
        ),
        (
            42,
            1024,
            [
                3_435_734_683_894_042,
                8_392_039_470_619_202,
                3_319_444_427_849_065,
                4_604_684_641_515_746,
            ],
        ),
        (
            u64::MAX,
            3,
            [
                5_647_581_194_010_662,
                1_509_832_314_434_459,
                4_134_509_769_800_189,
                6_585_173_436_678_269,
            ],
        ),
    ];
    for (seed, n, expected) in EXPECTED {
        assert_eq!(numerators(seed, n, 4), expected, "seed {seed}, n {n}");
    }
}

#[test]
fn a_draw_is_the_same_number_in_every_format_up_to_one_rounding() {
    let mut draws = Draws::new(7, 16);
    for _ in 0..1000 {
        let draw = draws.draw();
        let exact = Rational::from((draw.numerator, 1_u64 << 53));
        let value = |x: Option<Rational>| x.unwrap();
        // 53 bits hold it exactly.
        assert_eq!(value(draw.at(Native::<f64>::new()).to_rational()), exact);
        assert_eq!(value(draw.at(Mpfr { bits: 400 }).to_rational()), exact);
        let narrow = Native::<f16>::new();
        assert_eq!(draw.at(narrow), narrow.ratio(&exact));
    }
}

/// χ² over 64 cells has 63 degrees of freedom: mean 63, deviation 11.2. Its 10⁻⁶ and 1 − 10⁻⁶
/// quantiles are 23.2 and 131.4 (mpmath 1.3, gammainc). The draws are fixed, so this never flickers.
#[test]
fn draws_are_spread_evenly() {
    for n in [8_u64, 64, 1024] {
        let mut cells = [0.0_f64; 64];
        let count = 64_000;
        for numerator in numerators(3, n, count) {
            cells[(numerator >> 47) as usize] += 1.0;
        }
        let mean = count as f64 / 64.0;
        let chi_square: f64 = cells.iter().map(|c| (c - mean).powi(2) / mean).sum();
        assert!((23.2..131.4).contains(&chi_square), "χ² = {chi_square}");
    }
}

#[test]
fn levels_and_seeds_draw_independently() {
    let count = 10_000;
    let centred = |seed, n| -> Vec<f64> {
        let draws = numerators(seed, n, count);
        draws
            .iter()
            .map(|&d| d as f64 / (1_u64 << 53) as f64 - 0.5)
            .collect()
    };
    let streams = [
        (0, 8),
        (0, 9),
        (0, 16),
        (1, 8),
        (1, 7),
        (2, 8),
        (u64::MAX, 8),
    ];
    for (i, &(seed, n)) in streams.iter().enumerate() {
        for &(other_seed, other_n) in &streams[..i] {
            let products: f64 = centred(seed, n)
                .iter()
                .zip(centred(other_seed, other_n))
                .map(|(a, b)| a * b)
                .sum();
            // Σab has deviation √count/12 for independent uniforms; 5 of them.
            let limit = 5.0 * (count as f64).sqrt() / 12.0;
            assert!(
                products.abs() < limit,
                "({seed}, {n}) and ({other_seed}, {other_n})"
            );
        }
    }
}

quickcheck! {
    fn a_draw_lies_in_the_segment_that_exact_arithmetic_says(numerator: u64, n: u64) -> bool {
        let (numerator, n) = (numerator >> 11, (n >> 12).max(1));
        let (index, part) = Draw { numerator }.segment(n);
        let scaled = Rational::from((numerator, 1_u64 << 53)) * n;
        let (fraction, floor) = scaled.fract_floor(Integer::new());
        floor == index as u64 && fraction == part
    }
}

#[test]
fn a_draw_just_below_one_is_in_the_last_segment() {
    let last = Draw {
        numerator: (1 << 53) - 1,
    };
    assert_eq!(last.segment(1000).0, 999);
    assert_eq!(Draw { numerator: 0 }.segment(1000), (0, Rational::new()));
}

#[test]
fn samplings_print_as_their_rows_are_called() {
    assert_eq!(Sampling::Shared.to_string(), "monte-carlo");
    assert_eq!(Sampling::Independent.to_string(), "monte-carlo-independent");
    assert_eq!(Sampling::Stratified.to_string(), "monte-carlo-stratified");
}

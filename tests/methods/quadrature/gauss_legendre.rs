//! Gauss–Legendre tables against closed forms and mpmath.

use rug::{Float, Rational};
use std::sync::Arc;
use volver::quadrature::{Rule, UnitRule};

fn table(points: u32, bits: u32) -> Arc<UnitRule> {
    Rule::GaussLegendre(points).table(bits).unwrap()
}

/// What a table promises: within 2^−(bits + 64).
fn assert_close(value: &Rational, exact: &Float, bits: u32) {
    let error = Float::with_val(64, exact - value).abs();
    assert!(
        error <= Float::with_val(64, Float::i_exp(1, -((bits + 64).cast_signed()))),
        "off by {error} at {bits} bits"
    );
}

/// Nodes (1 ∓ 1/√3)/2, weights ½; nodes ½ and (1 ∓ √(3/5))/2, weights 5/18, 4/9, 5/18
/// (Abramowitz and Stegun 1964, table 25.4).
#[test]
fn two_and_three_points_have_their_closed_forms() {
    for bits in [8, 53, 200, 2000] {
        let precise = |q: Rational| Float::with_val(bits + 200, q);
        let two = table(2, bits);
        let root = precise(Rational::from((1, 3))).sqrt();
        assert_close(&two.nodes[0], &((1 - root.clone()) / 2_u32), bits);
        assert_close(&two.nodes[1], &((1 + root.clone()) / 2_u32), bits);
        for weight in &two.weights {
            assert_close(weight, &precise((1, 2).into()), bits);
        }
        let three = table(3, bits);
        let root = precise(Rational::from((3, 5))).sqrt();
        assert_close(&three.nodes[0], &((1 - root.clone()) / 2_u32), bits);
        assert_eq!(three.nodes[1], Rational::from((1, 2)));
        assert_close(&three.nodes[2], &((1 + root.clone()) / 2_u32), bits);
        for (weight, exact) in three.weights.iter().zip([(5, 18), (4, 9), (5, 18)]) {
            assert_close(weight, &precise(exact.into()), bits);
        }
    }
}

#[test]
fn one_point_is_the_midpoint() {
    let one = table(1, 300);
    assert_eq!(one.nodes, [Rational::from((1, 2))]);
    assert_eq!(one.weights.len(), 1);
    assert_close(&one.weights[0], &Float::with_val(64, 1), 300);
}

/// mpmath 1.3 at 90 digits: roots of `mpmath.legendre` (a hypergeometric series, no recurrence) by
/// the secant method, weights from (1 − x²)/((m + 1) Pₘ₊₁(x))²; 72 digits printed.
#[test]
fn tables_agree_with_mpmath() {
    // 72 digits are 239 bits: 64 guard bits promised, so 170 bits and less can be judged.
    for bits in [53, 113, 170] {
        for line in include_str!("mpmath.csv").lines().skip(1) {
            let columns: Vec<&str> = line.split(',').collect();
            let number = |text: &str| Float::with_val(300, Float::parse(text).unwrap());
            let points = columns[0].parse().unwrap();
            // A table of a thousand points takes a second, and its precision is nothing special.
            if points > 100 && bits > 53 {
                continue;
            }
            let k: usize = columns[1].parse().unwrap();
            let rule = table(points, bits);
            assert_close(&rule.nodes[k - 1], &number(columns[2]), bits);
            assert_close(&rule.weights[k - 1], &number(columns[3]), bits);
        }
    }
}

/// Every precision has a table of its own, as precise as it promises: this is what a cache keyed by
/// points alone would break.
#[test]
fn a_table_is_kept_for_its_own_precision() {
    let coarse = table(7, 24);
    let fine = table(7, 1000);
    assert!(Arc::ptr_eq(&coarse, &table(7, 24)));
    assert!(!Arc::ptr_eq(&coarse, &fine));
    let size = |q: &Rational| q.denom().significant_bits();
    // The 24 bits asked for, with 96 to compute with and what a fraction adds.
    assert!(size(&coarse.nodes[0]) <= 24 + 96 + 8);
    assert!(size(&fine.nodes[0]) > 1000);
}

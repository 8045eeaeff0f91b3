//! A rule of degree k integrates polynomials up to degree k exactly, and no further; composed over n
//! segments it has the order that it states.

use quickcheck::QuickCheck;
use rug::ops::Pow;
use rug::{Float, Rational};
use volver::quadrature::{Rule, UnitRule};

const NEWTON_COTES: [Rule; 6] = [
    Rule::RiemannLeft,
    Rule::RiemannRight,
    Rule::Midpoint,
    Rule::Trapezoid,
    Rule::Simpson,
    Rule::Boole,
];

const GAUSS: [u32; 7] = [1, 2, 3, 5, 8, 20, 64];

/// Degree of exactness, from the literature (Davis and Rabinowitz 1984): the test's own, not the code's.
fn literature_degree(rule: Rule) -> u32 {
    match rule {
        Rule::RiemannLeft | Rule::RiemannRight => 0,
        Rule::Midpoint | Rule::Trapezoid => 1,
        Rule::Simpson => 3,
        Rule::Boole => 5,
        Rule::GaussLegendre(points) => 2 * points - 1,
    }
}

/// Σ wₖ xₖᵏ.
fn moment(rule: &UnitRule, degree: u32) -> Rational {
    rule.nodes
        .iter()
        .zip(&rule.weights)
        .map(|(x, w)| Rational::from(x.pow(degree)) * w)
        .sum()
}

fn integral(degree: u32) -> Rational {
    Rational::from((1, degree + 1))
}

fn log2_error(rule: &UnitRule, degree: u32) -> f64 {
    let error = Float::with_val(64, moment(rule, degree) - integral(degree));
    let (mantissa, exponent) = error.to_f64_exp();
    mantissa.abs().log2() + f64::from(exponent)
}

#[test]
fn degrees_and_orders_are_those_of_the_literature() {
    let gauss = GAUSS.map(Rule::GaussLegendre);
    for rule in NEWTON_COTES.into_iter().chain(gauss) {
        assert_eq!(rule.degree(), literature_degree(rule), "{rule}");
        assert_eq!(rule.order(), literature_degree(rule) + 1, "{rule}");
    }
}

#[test]
fn newton_cotes_rules_are_exact_to_their_degree_and_no_further() {
    #[expect(clippy::needless_pass_by_value, reason = "quickcheck gives values")]
    fn check(numerators: Vec<i16>, denominator: u8) -> bool {
        NEWTON_COTES.into_iter().all(|rule| {
            let degree = literature_degree(rule);
            let table = rule.table(53).unwrap();
            // A random polynomial of that degree: missing coefficients are 1.
            let coefficient = |k: u32| {
                let numerator = numerators.get(k as usize).copied().unwrap_or(1);
                Rational::from((numerator, u16::from(denominator) + 1))
            };
            let by_rule: Rational = (0..=degree)
                .map(|k| coefficient(k) * moment(&table, k))
                .sum();
            let exact: Rational = (0..=degree).map(|k| coefficient(k) * integral(k)).sum();
            // One power more, which the polynomial's exact part does not change.
            by_rule == exact && moment(&table, degree + 1) != integral(degree + 1)
        })
    }
    let mut quickcheck = QuickCheck::new().tests(500);
    quickcheck.quickcheck(check as fn(Vec<i16>, u8) -> bool);
}

#[test]
fn gauss_rules_are_exact_to_their_degree_and_no_further() {
    let all = [11, 53, 400].map(|bits| (bits, &GAUSS[..]));
    for (bits, points) in all.into_iter().chain([(2000, &GAUSS[..5])]) {
        for &points in points {
            let rule = Rule::GaussLegendre(points);
            let table = rule.table(bits).unwrap();
            let degree = literature_degree(rule);
            for k in 0..=degree {
                let error = log2_error(&table, k);
                assert!(
                    error < -f64::from(bits + 60),
                    "{rule}, {bits} bits, x^{k}: 2^{error}"
                );
            }
            // Its error on the next power is (m!)⁴ / ((2m + 1) ((2m)!)²), about 2^(−4m).
            let missed = log2_error(&table, degree + 1);
            assert!(
                missed > -f64::from(bits + 60) || f64::from(bits + 60) < 4.0 * f64::from(points),
                "{rule} is exact beyond its degree at {bits} bits"
            );
        }
    }
}

/// ∫₀¹ of the monic Legendre polynomial squared: what m points miss at x^(2m).
#[test]
fn gauss_rules_miss_the_next_power_by_what_theory_says() {
    for points in GAUSS {
        let table = Rule::GaussLegendre(points).table(2000).unwrap();
        let factorial = |k: u32| Rational::from(rug::Integer::from(rug::Integer::factorial(k)));
        let expected = factorial(points).pow(4) / (factorial(2 * points).pow(2) * (2 * points + 1));
        let missed = integral(2 * points) - moment(&table, 2 * points);
        let relative = Float::with_val(64, missed / expected - 1);
        assert!(relative.abs() < 1e-300, "{points} points");
    }
}

#[test]
fn a_thousand_points_satisfy_their_moments() {
    let table = Rule::GaussLegendre(1000).table(53).unwrap();
    assert_eq!(table.nodes.len(), 1000);
    let error = |k: u32| {
        // In rationals the powers would take millions of bits each.
        let mut sum = Float::new(400);
        for (x, w) in table.nodes.iter().zip(&table.weights) {
            sum += Float::with_val(400, x).pow(k) * Float::with_val(400, w);
        }
        Float::with_val(64, sum - integral(k)).abs()
    };
    for k in [0, 1, 2, 3, 10, 99, 500, 1000, 1999] {
        assert!(
            error(k) < Float::with_val(64, Float::i_exp(1, -113)),
            "x^{k}"
        );
    }
}

#[test]
fn weights_sum_to_one_and_symmetric_rules_are_symmetric() {
    let rules = [Rule::Midpoint, Rule::Trapezoid, Rule::Simpson, Rule::Boole];
    for rule in rules.into_iter().chain(GAUSS.map(Rule::GaussLegendre)) {
        let table = rule.table(53).unwrap();
        let count = table.nodes.len();
        assert_eq!(table.weights.len(), count);
        assert!(table.nodes.is_sorted_by(|a, b| a < b), "{rule}");
        for k in 0..count {
            let mirrored = Rational::from(1 - &table.nodes[count - 1 - k]);
            assert_eq!(table.nodes[k], mirrored, "{rule}");
            assert_eq!(table.weights[k], table.weights[count - 1 - k], "{rule}");
            assert!(table.weights[k] > 0, "{rule}");
        }
        let excess = Float::with_val(64, table.weights.iter().sum::<Rational>() - 1_u32);
        assert!(
            excess.abs() <= Float::with_val(64, Float::i_exp(1, -113)),
            "{rule}"
        );
    }
}

/// e^x on n segments: the pairwise orders of the composite rule's error, in rationals and 600 bits.
#[test]
fn composite_rules_have_their_order() {
    let gauss = [1, 2, 3, 5].map(Rule::GaussLegendre);
    for rule in NEWTON_COTES.into_iter().chain(gauss) {
        let table = rule.table(600).unwrap();
        let error = |n: u32| {
            let mut sum = Float::new(600);
            for j in 0..n {
                for (x, w) in table.nodes.iter().zip(&table.weights) {
                    let place = Float::with_val(600, Rational::from(x + j) / n);
                    sum += place.exp() * Float::with_val(600, w);
                }
            }
            sum / n - (Float::with_val(600, 1).exp() - 1_u32)
        };
        let ratio = Float::with_val(64, error(32) / error(64)).to_f64();
        let order = f64::from(literature_degree(rule) + 1);
        assert!(
            (ratio.log2() - order).abs() < 0.02,
            "{rule}: 2^{}",
            ratio.log2()
        );
    }
}

#[test]
fn closed_rules_say_how_they_divide_an_interval() {
    for (rule, intervals) in
        NEWTON_COTES
            .into_iter()
            .zip([Some(1), Some(1), None, Some(1), Some(2), Some(4)])
    {
        assert_eq!(rule.intervals(), intervals, "{rule}");
        let table = rule.table(53).unwrap();
        if let Some(intervals) = intervals {
            let on_grid = |x: &Rational| Rational::from(x * intervals).is_integer();
            assert!(table.nodes.iter().all(on_grid), "{rule}");
        }
    }
    assert_eq!(Rule::GaussLegendre(3).intervals(), None);
}

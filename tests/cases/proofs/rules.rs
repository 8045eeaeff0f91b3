//! The rules that the theorems are about are the rules that the code has, and so are the constants.

use super::theory;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};
use volver::quadrature::Rule;

/// The constant c of `panel_bound Q r c`, in `Quadrature.v` or by the formula of `TaylorRule.v`.
pub(crate) fn panel_constant(rule: Rule) -> Float {
    let sharp = match rule {
        Rule::RiemannLeft | Rule::RiemannRight => Some(2),
        Rule::Midpoint => Some(24),
        Rule::Trapezoid => Some(12),
        Rule::Simpson => Some(2880),
        Rule::Boole | Rule::GaussLegendre(_) => None,
    };
    match sharp {
        Some(denominator) => Float::with_val(200, 1) / denominator,
        None => taylor_constant(rule),
    }
}

/// `taylor_constant`: (1/2)^m/(m+1)! + Σ |w| |c − 1/2|^m / m!, m being the rule's order.
fn taylor_constant(rule: Rule) -> Float {
    let m = rule.order();
    let table = rule.table(200).unwrap();
    let half = Rational::from((1, 2));
    let nodes = table.nodes.iter().zip(&table.weights);
    let moments = nodes.map(|(c, w)| w.clone().abs() * Rational::from(c - &half).abs().pow(m));
    let moment = moments.fold(Rational::new(), |sum, term| sum + term);
    let factorial = |n| Float::with_val(200, Integer::from(Integer::factorial(n)));
    Float::with_val(200, half.pow(m)) / factorial(m + 1)
        + Float::with_val(200, moment) / factorial(m)
}

/// "[(0, 1/6); (1/2, 2/3); (1, 1/6)]".
fn as_coq(rule: Rule) -> String {
    let table = rule.table(53).unwrap();
    let pairs = table.nodes.iter().zip(&table.weights);
    let pairs: Vec<String> = pairs.map(|(c, w)| format!("({c}, {w})")).collect();
    format!("[{}]", pairs.join("; "))
}

#[test]
fn tables_are_those_of_the_theory() {
    let theory = theory("Quadrature.v");
    for (name, rule) in [
        ("riemann_left", Rule::RiemannLeft),
        ("riemann_right", Rule::RiemannRight),
        ("midpoint", Rule::Midpoint),
        ("trapezoid", Rule::Trapezoid),
        ("simpson", Rule::Simpson),
        ("boole", Rule::Boole),
    ] {
        let definition = format!("Definition {name} : rule := {}.", as_coq(rule));
        assert!(theory.contains(&definition), "{definition}");
    }
}

#[test]
fn constants_are_those_of_the_theorems() {
    let theory = theory("Quadrature.v");
    for (name, rule) in [
        ("riemann_left", Rule::RiemannLeft),
        ("riemann_right", Rule::RiemannRight),
        ("midpoint", Rule::Midpoint),
        ("trapezoid", Rule::Trapezoid),
        ("simpson", Rule::Simpson),
    ] {
        let denominator = Float::with_val(200, panel_constant(rule).recip_ref());
        let theorem = format!(
            "Theorem {name}_panel : panel_bound {name} {} (1 / {}).",
            rule.order(),
            denominator.to_integer().unwrap()
        );
        assert!(theory.contains(&theorem), "{theorem}");
    }
}

/// `exact_below`, for the rules whose nodes are irrational.
#[test]
fn gauss_rules_are_exact_below_their_order() {
    for points in [1, 2, 3, 5, 8] {
        let rule = Rule::GaussLegendre(points);
        let table = rule.table(200).unwrap();
        assert!(table.nodes.iter().all(|c| *c >= 0 && *c <= 1));
        let half = Rational::from((1, 2));
        for k in 0..rule.order() {
            let nodes = table.nodes.iter().zip(&table.weights);
            let terms = nodes.map(|(c, w)| w.clone() * Rational::from(c - &half).pow(k));
            let sum = terms.fold(Rational::new(), |sum, term| sum + term);
            let power = half.clone().pow(k + 1);
            let opposite = (-half.clone()).pow(k + 1);
            let exact = (power - opposite) / (k + 1);
            let error = (sum - exact).abs();
            assert!(
                error < Rational::from((1, Integer::from(1) << 200)),
                "{points} {k}"
            );
        }
    }
}

/// The general constant is the larger one where a sharp one is known, or one of them is wrong.
#[test]
fn sharp_constants_are_below_the_general_one() {
    for rule in [
        Rule::RiemannLeft,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
    ] {
        assert!(panel_constant(rule) <= taylor_constant(rule), "{rule}");
    }
}

//! What a segment with several values does, as statements.

use super::Statement;
use super::expression::{combination, factor, number, scaled};
use super::law::Layer;
use super::set;
use crate::identify::rule::{Scale, Segment};
use rug::Rational;

/// Extinctions in front, in the middle and at the back.
const EXTINCTIONS: [&str; 3] = ["f", "m", "b"];

/// A segment with the length d; `emission` gives C at its three places.
pub(super) fn segment(
    depth: &[Rational; 3],
    weights: &Segment,
    scale: Scale,
    emission: &[String; 3],
) -> Layer {
    let mut statements = vec![
        set("f", "tau_edges[i]"),
        set("m", "tau_middles[i]"),
        set("b", "tau_edges[i + 1]"),
        set("x", along(depth)),
    ];
    let three = three(weights, &mut statements);
    let mut light = Vec::new();
    for (weight, emission) in three.iter().zip(emission) {
        if let Some(weight) = weight {
            light.push(format!("{} * {emission}", factor(weight)));
        }
    }
    let first = three[0].as_deref().unwrap_or("0.0");
    let light = match light.as_slice() {
        [] => "0.0".into(),
        all => all.join(" + "),
    };
    Layer {
        statements,
        first: scaled(first, scale),
        light: scaled(&light, scale),
        passes: "exp(-x)".into(),
    }
}

/// d (c₀ f + c₁ m + c₂ b).
fn along(parts: &[Rational; 3]) -> String {
    format!("d * {}", factor(&combination(parts, EXTINCTIONS)))
}

/// c times an expression, where c is not 0.
fn part(c: &Rational, expression: &str) -> Option<String> {
    let parts = [c.clone(), Rational::new(), Rational::new()];
    (!c.is_zero()).then(|| combination(&parts, [expression, "", ""]))
}

/// Weights in front, in the middle and at the back.
fn three(weights: &Segment, all: &mut Vec<Statement>) -> [Option<String>; 3] {
    let named = |name: &str| Some(name.to_string());
    match weights {
        Segment::Opacity { parts } => {
            all.push(set("alpha", "-expm1(-x)"));
            parts.each_ref().map(|c| part(c, "alpha"))
        }
        Segment::LinearInDepth { swapped } => {
            all.push(Statement::If(
                // Where x is small, differences lose what the series keeps.
                format!("x * x < {}", number(1e-4)),
                vec![
                    set(
                        "near",
                        "x * (1 / 2.0 - x * (1 / 6.0 - x * (1 / 24.0 - x * (1 / 120.0 - x / 720))))",
                    ),
                    set(
                        "far",
                        "x * (1 / 2.0 - x * (1 / 3.0 - x * (1 / 8.0 - x * (1 / 30.0 - x / 144))))",
                    ),
                ],
                vec![
                    set("near", "1 + expm1(-x) / x"),
                    set("far", "-expm1(-x) / x - exp(-x)"),
                ],
            ));
            if *swapped {
                [named("far"), None, named("near")]
            } else {
                [named("near"), None, named("far")]
            }
        }
        Segment::Linear => {
            all.push(set("near", "linear(f * d, b * d)"));
            all.push(set("far", "-expm1(-d * (f + b) / 2) - near"));
            [named("near"), None, named("far")]
        }
        Segment::Quadrature { parts, half } => {
            let middle = format!("d * m * exp(-{})", along(half));
            [
                part(&parts[0], "d * f"),
                part(&parts[1], &middle),
                part(&parts[2], "d * b * exp(-x)"),
            ]
        }
        Segment::Sum { parts } => [
            part(&parts[0], "d * f"),
            part(&parts[1], "d * m"),
            part(&parts[2], "d * b"),
        ],
        Segment::Halves => {
            all.push(set("near", "-expm1(-f * d / 2)"));
            all.push(set("far", "exp(-f * d / 2) * -expm1(-b * d / 2)"));
            [named("near"), None, named("far")]
        }
    }
}

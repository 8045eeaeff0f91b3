//! What a segment with several values does, in signs.

use super::law::scale;
use super::{Line, combination, factor, formula, words};
use crate::identify::rule::{Scale, Segment};
use rug::Rational;

const EXTINCTIONS: [&str; 3] = ["τ_f", "τ_m", "τ_b"];
const EMISSIONS: [&str; 3] = ["C_f", "C_m", "C_b"];

/// d Σ c τ over the three places.
fn along(parts: &[Rational; 3]) -> String {
    format!("dⱼ {}", factor(&combination(parts, EXTINCTIONS)))
}

/// The depth of segment j, and what it adds.
pub(super) fn described(depth: &[Rational; 3], weights: &Segment, of: Scale) -> Vec<Line> {
    let times = scale(of).map_or_else(String::new, |scale| format!("{scale} "));
    let mut all = vec![formula(format!("xⱼ = {}", along(depth)))];
    let light = |inner: &str| formula(format!("Lⱼ = {times}{inner}"));
    let whole = |inner: &str| {
        if times.is_empty() {
            light(inner)
        } else {
            light(&factor(inner))
        }
    };
    match weights {
        Segment::Opacity { parts } => {
            let emission = factor(&combination(parts, EMISSIONS));
            all.push(light(&format!("(1 − exp(−xⱼ)) {emission}")));
        }
        Segment::LinearInDepth { swapped } => {
            let (near, far) = if *swapped {
                ("C_b", "C_f")
            } else {
                ("C_f", "C_b")
            };
            all.push(whole(&format!("(1 − eⱼ) {near} + (eⱼ − exp(−xⱼ)) {far}")));
            all.push(formula("eⱼ = (1 − exp(−xⱼ))/xⱼ"));
            all.push(words(
                "the emission is linear in the optical depth between the ends of a segment",
            ));
        }
        Segment::Linear => {
            all.push(light("∫ C τ exp(−t) dλ"));
            all.push(words(
                "extinction and emission are linear between the ends of a segment, and integrated exactly",
            ));
        }
        Segment::Quadrature { parts, half } => {
            let terms = ["τ_f C_f", "τ_m C_m exp(−yⱼ)", "τ_b C_b exp(−xⱼ)"];
            all.push(light(&format!("dⱼ {}", factor(&combination(parts, terms)))));
            if !parts[1].is_zero() {
                all.push(formula(format!("yⱼ = {}", along(half))));
            }
        }
        Segment::Sum { parts } => {
            let terms = ["τ_f C_f", "τ_m C_m", "τ_b C_b"];
            all.push(light(&format!("dⱼ {}", factor(&combination(parts, terms)))));
        }
        Segment::Halves => {
            all.push(whole(
                "(1 − exp(−½ dⱼ τ_f)) C_f + exp(−½ dⱼ τ_f) (1 − exp(−½ dⱼ τ_b)) C_b",
            ));
        }
    }
    all.push(words(
        "f, m, b: at the front, in the middle and at the back of segment j",
    ));
    all
}

//! Formulas of parts, in words.

use crate::identify::rule::{Curve, Depth, Power, Segment, Shape, Weight};
use rug::Rational;

pub(super) fn of_segment(weights: &Segment) -> String {
    let opacity = "the opacity of a segment is multiplied by";
    match weights {
        Segment::Opacity { parts } => format!("{opacity} {}", sum(parts, "C")),
        Segment::LinearInDepth { swapped: false } => "emission is linear in optical depth".into(),
        Segment::LinearInDepth { swapped: true } => {
            "emission is linear in optical depth, front and back changed places".into()
        }
        Segment::Linear => "C and τ are linear along segments, integrated exactly".into(),
        Segment::Quadrature { parts, half } => format!(
            "τ C T is summed, d ({}), with a depth of d ({}) to the middle",
            sum(parts, "τCT"),
            sum(half, "τ")
        ),
        Segment::Sum { parts } => format!(
            "τ C is summed, d ({}), as though segments absorbed nothing",
            sum(parts, "τC")
        ),
        Segment::Halves => "each half of a segment has the values at its end".into(),
    }
}

/// "1/2 front + 1/2 back", of what there is.
pub(super) fn sum(parts: &[Rational; 3], what: &str) -> String {
    let names = ["in front", "in the middle", "at the back"];
    let terms = parts.iter().zip(names).filter(|(part, _)| !part.is_zero());
    let terms: Vec<String> = terms
        .map(|(part, name)| {
            if *part == 1 {
                format!("{what} {name}")
            } else {
                format!("{part} {what} {name}")
            }
        })
        .collect();
    if terms.is_empty() {
        "0".into()
    } else {
        terms.join(" + ")
    }
}

pub(super) fn of_depth(depth: &Depth) -> String {
    let mut factors = Vec::new();
    if is_other(depth.factor, 1.0) {
        factors.push(short(depth.factor));
    }
    let all = [
        ("τ", depth.extinction),
        ("d", depth.length),
        ("D", depth.ray),
    ];
    for (name, power) in all {
        factors.extend(raised(name, power));
    }
    if factors.is_empty() {
        "1".into()
    } else {
        factors.join(" ")
    }
}

fn raised(name: &str, power: Power) -> Option<String> {
    match power.halves {
        0 => None,
        2 => Some(name.into()),
        halves if halves % 2 == 0 => Some(format!("{name}^{}", halves / 2)),
        halves => Some(format!("{name}^({halves}/2)")),
    }
}

pub(super) fn shape(shape: Shape) -> &'static str {
    match shape {
        Shape::Exponential => "e^(−x)",
        Shape::Linear => "1 − x",
        Shape::Reciprocal => "1/(1 + x)",
        Shape::Quadratic => "1 − x + x²/2",
        Shape::CrankNicolson => "(1 − x/2)/(1 + x/2)",
        Shape::Clear => "all",
    }
}

pub(super) fn weight(weight: Weight) -> String {
    let with = |first: String, passes: Power| {
        let through = raised("p", passes);
        std::iter::once(first)
            .chain(through)
            .collect::<Vec<_>>()
            .join(" ")
    };
    match weight {
        Weight::Opacity { opacity, passes } => {
            with(raised("α", opacity).unwrap_or_else(|| "1".into()), passes)
        }
        Weight::Depth { depth, passes } => with(of_depth(&depth), passes),
        Weight::Own { depth, shape: of } => {
            format!("1 − p, p = {} with x = {}", shape(of), of_depth(&depth))
        }
    }
}

pub(super) fn curve(curve: Curve) -> Option<String> {
    Some(match curve {
        Curve::Linear => return None,
        Curve::Gamma(power) => format!("x^{}", short(power)),
        Curve::Srgb => "that of sRGB".into(),
        Curve::Reinhard => "x/(1 + x)".into(),
        Curve::Exposure => "1 − e^(−x)".into(),
    })
}

pub(super) fn is_other(x: f64, plain: f64) -> bool {
    (x - plain).abs() > 0.0
}

/// A number with all digits that it has, without rows of zeros.
pub(in crate::identify) fn short(x: f64) -> String {
    let size = x.abs();
    if x.is_finite() && size > 0.0 && !(1e-4..1e6).contains(&size) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}

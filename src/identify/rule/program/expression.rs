//! Expressions as text that means the same in Python and C.

use crate::identify::rule::{Depth, Power, Scale, Shape};
use rug::Rational;

/// A literal that is a binary64 in both languages, never an integer.
pub(super) fn number(x: f64) -> String {
    format!("{x:?}")
}

/// A rational as a literal, or a quotient of literals.
fn ratio(q: &Rational) -> String {
    let near = q.to_f64();
    if Rational::from_f64(near).is_some_and(|exact| exact == *q) {
        return number(near);
    }
    format!("{}.0 / {}.0", q.numer(), q.denom())
}

/// Σ cₖ xₖ without what is multiplied by 0 or 1.
pub(super) fn combination(parts: &[Rational; 3], of: [&str; 3]) -> String {
    let mut sum = String::new();
    for (part, x) in parts.iter().zip(of) {
        if part.is_zero() {
            continue;
        }
        let (sign, size) = if *part < 0 {
            (" - ", Rational::from(-part))
        } else {
            (" + ", part.clone())
        };
        match (sum.is_empty(), sign) {
            (true, " - ") => sum.push('-'),
            (true, _) => {}
            (false, sign) => sum.push_str(sign),
        }
        if size != 1 {
            sum.push_str(&ratio(&size));
            sum.push_str(" * ");
        }
        sum.push_str(x);
    }
    if sum.is_empty() { "0.0".into() } else { sum }
}

/// In parentheses, where it is a sum, so that it may be a factor.
pub(super) fn factor(expression: &str) -> String {
    let mut depth = 0;
    let mut is_sum = false;
    for (at, c) in expression.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '+' | '-' if depth == 0 => is_sum |= expression[..at].ends_with(' '),
            _ => {}
        }
    }
    if is_sum {
        format!("({expression})")
    } else {
        expression.into()
    }
}

/// x to a power above 0.
fn raised(x: &str, power: f64) -> String {
    let halves = (2.0 * power).round();
    if halves.total_cmp(&2.0).is_eq() {
        x.into()
    } else if halves.total_cmp(&4.0).is_eq() {
        format!("{x} * {x}")
    } else if halves.total_cmp(&1.0).is_eq() {
        format!("sqrt({x})")
    } else {
        format!("pow({x}, {})", number(power))
    }
}

/// A product of powers, times a number.
pub(super) fn product(scale: f64, powers: &[(&str, Power)]) -> String {
    let mut above = Vec::new();
    if (scale - 1.0).abs() > 0.0 {
        above.push(number(scale));
    }
    let mut below = String::new();
    for (x, power) in powers {
        if *power > Power::ZERO {
            above.push(raised(x, power.exponent()));
        } else if *power < Power::ZERO {
            let under = raised(x, -power.exponent());
            let under = if under.contains(" * ") {
                format!("({under})")
            } else {
                under
            };
            below.push_str(" / ");
            below.push_str(&under);
        }
    }
    if above.is_empty() {
        above.push("1.0".into());
    }
    above.join(" * ") + &below
}

impl Depth {
    /// κ τ^a d^b D^c.
    pub(super) fn program(&self, extinction: &str, length: &str) -> String {
        let powers = [
            (extinction, self.extinction),
            (length, self.length),
            ("lam[n]", self.ray),
        ];
        product(self.factor, &powers)
    }
}

impl Shape {
    /// 1 − p and p of a name.
    pub(super) fn program(self, x: &str) -> (String, String) {
        let (opacity, passes) = match self {
            Shape::Exponential => ("-expm1(-x)", "exp(-x)"),
            Shape::Linear => ("x", "1 - x"),
            Shape::Reciprocal => ("x / (1 + x)", "1 / (1 + x)"),
            Shape::Quadratic => ("x - x * x / 2", "1 - x + x * x / 2"),
            Shape::CrankNicolson => ("x / (1 + x / 2)", "(1 - x / 2) / (1 + x / 2)"),
            Shape::Clear => ("0.0", "1.0"),
        };
        (renamed(opacity, x), renamed(passes, x))
    }
}

/// The name x replaced, but not within other names.
fn renamed(expression: &str, name: &str) -> String {
    if name == "x" {
        return expression.into();
    }
    let protected = expression.replace("expm1", "\u{1}").replace("exp", "\u{2}");
    let renamed = protected.replace('x', name);
    renamed.replace('\u{1}', "expm1").replace('\u{2}', "exp")
}

/// An expression times a scale.
pub(super) fn scaled(expression: &str, scale: Scale) -> String {
    if (scale.0 - 1.0).abs() > 0.0 {
        format!("{} * {}", number(scale.0), factor(expression))
    } else {
        expression.into()
    }
}

/// The nearest multiple of a step.
pub(super) fn nearest_multiple(x: &str, step: f64) -> String {
    format!(
        "floor(({x} + {}) / {step}) * {step}",
        number(step / 2.0),
        step = number(step)
    )
}

/// The multiple of a step that is not above.
pub(super) fn multiple_below(x: &str, step: f64) -> String {
    format!("floor({x} / {step}) * {step}", step = number(step))
}

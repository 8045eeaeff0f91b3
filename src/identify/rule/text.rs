//! The formula as plain text, line by line.

mod law;
mod segment;
mod words;

use super::{Curve, Place, Rule, Scheme, Whole};
use rug::Rational;
use std::fmt::{self, Write as _};

/// A line of a rule's description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// In signs.
    Formula(String),
    /// In words alone.
    Words(String),
}

/// In signs.
fn formula(text: impl Into<String>) -> Line {
    Line::Formula(text.into())
}

/// In words.
fn words(text: impl Into<String>) -> Line {
    Line::Words(text.into())
}

/// A number with the digits that it needs.
fn number(x: f64) -> String {
    let size = x.abs();
    // Of 1/255 nobody knows the decimals.
    let reciprocal = (1000.0 / x).round() / 1000.0;
    let is_short = format!("{size:?}").len() <= 6;
    if !is_short && reciprocal <= 65_536.0 && (1.0 / reciprocal).total_cmp(&x).is_eq() {
        return format!("1/{}", number(reciprocal));
    }
    let text = if size >= 1e6 || (size > 0.0 && size < 1e-4) {
        format!("{x:e}")
    } else {
        format!("{x}")
    };
    text.replacen('-', "−", usize::from(x < 0.0))
}

/// Σ c x, of the parts that are not 0.
fn combination(parts: &[Rational; 3], of: [&str; 3]) -> String {
    let mut sum = String::new();
    for (part, x) in parts.iter().zip(of) {
        if part.is_zero() {
            continue;
        }
        let is_negative = *part < 0;
        match (sum.is_empty(), is_negative) {
            (true, true) => sum.push('−'),
            (true, false) => {}
            (false, true) => sum.push_str(" − "),
            (false, false) => sum.push_str(" + "),
        }
        let size = Rational::from(part.abs_ref());
        if size != 1 {
            let _ = write!(sum, "{size} ");
        }
        sum.push_str(x);
    }
    if sum.is_empty() { "0".into() } else { sum }
}

/// In parentheses, where it is a sum.
fn factor(sum: &str) -> String {
    let is_sum = sum.contains(" + ") || sum.contains(" − ");
    if is_sum || sum.starts_with('−') {
        format!("({sum})")
    } else {
        sum.into()
    }
}

/// g in signs.
fn curved(curve: Curve, x: &str) -> Option<String> {
    Some(match curve {
        Curve::Linear => return None,
        Curve::Gamma(power) => format!("{x}^({})", number(power)),
        Curve::Srgb => format!("12.92 {x} where {x} ≤ 0.0031308, else 1.055 {x}^(1/2.4) − 0.055"),
        Curve::Reinhard => format!("{x}/(1 + {x})"),
        Curve::Exposure => format!("1 − exp(−{x})"),
    })
}

/// The sum, with what is added to it.
fn sum(rule: &Rule, light: &str, passes: &str) -> String {
    let mut text = String::from("I = ");
    match rule.whole {
        Whole::One => {}
        Whole::ByOpacity => text.push_str("1/(1 − T) "),
        Whole::TimesOpacity => text.push_str("(1 − T) "),
    }
    let _ = write!(text, "Σⱼ Tⱼ {light}");
    if rule.background.abs() > 0.0 {
        let _ = write!(text, " + {} T", number(rule.background));
    }
    if rule.offset < 0.0 {
        let _ = write!(text, " − {}", number(-rule.offset));
    } else if rule.offset > 0.0 {
        let _ = write!(text, " + {}", number(rule.offset));
    }
    let last = if rule.sequence.late { "k<j−1" } else { "k<j" };
    let _ = write!(text, ",  Tⱼ = Π_{{{last}}} {passes}");
    let has_whole = rule.whole != Whole::One || rule.background.abs() > 0.0;
    if has_whole {
        text.push_str(",  T = the product over all");
    }
    text
}

/// All lines, the formula first.
pub(super) fn lines(rule: &Rule) -> Vec<Line> {
    let mut all = match &rule.scheme {
        Scheme::Sample { place, law } => {
            let described = law::described(law);
            let mut all = vec![formula(sum(rule, &described.light, &described.passes))];
            all.extend(described.lines);
            all.push(words(match place {
                Place::Front => "samples at the front of segments",
                Place::Middle => "samples in the middle of segments",
                Place::Back => "samples at the back of segments",
            }));
            all
        }
        Scheme::Segments {
            depth,
            weights,
            scale,
        } => {
            let mut all = vec![formula(sum(rule, "Lⱼ", "exp(−xₖ)"))];
            all.extend(segment::described(depth, weights, *scale));
            all
        }
    };
    all.extend(words::of(rule));
    all
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, line) in lines(self).iter().enumerate() {
            if k > 0 {
                f.write_str("\n")?;
            }
            let (Line::Formula(text) | Line::Words(text)) = line;
            f.write_str(text)?;
        }
        Ok(())
    }
}

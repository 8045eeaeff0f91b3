//! What one sample does, in signs.

use super::{Line, factor, formula, number, words};
use crate::identify::rule::{Depth, Law, Power, Range, Scale, Shape, Step, Table, Weight};

/// The parts of a description.
pub(super) struct Described {
    /// Weight and emission.
    pub(super) light: String,
    /// p of sample k, as a factor.
    pub(super) passes: String,
    pub(super) lines: Vec<Line>,
}

/// The law of sample j.
pub(super) fn described(law: &Law) -> Described {
    let mut lines = Vec::new();
    let x = law.depth.text("xⱼ");
    let by_power = is_by_power(law);
    // Short where one exponential says all.
    let is_inline = law.shape == Shape::Exponential
        && !by_power
        && law.range.depth_max.is_none()
        && law.range.series.is_none()
        && law.range.table.is_none()
        && x.starts_with("xⱼ = ");
    let depth = x.strip_prefix("xⱼ = ").unwrap_or("xⱼ");
    let cover = if (law.cover.0 - 1.0).abs() > 0.0 {
        format!("{} ", number(law.cover.0))
    } else {
        String::new()
    };
    let opacity = if is_inline {
        format!("1 − exp(−{depth})")
    } else {
        opacity(law)
    };
    let opacity = if cover.is_empty() {
        opacity
    } else {
        format!("{cover}{}", factor(&opacity))
    };
    lines.push(formula(format!("αⱼ = {opacity}")));
    if !is_inline && (!by_power || law.range.series.is_some()) {
        lines.push(formula(x));
    }
    let weight = weight(law);
    let light = match weight {
        Ok(product) if product.is_empty() => "Cⱼ".into(),
        Ok(product) => format!("{product} Cⱼ"),
        Err(own) => {
            lines.push(formula(format!("wⱼ = {own}")));
            "wⱼ Cⱼ".into()
        }
    };
    lines.extend(range(&law.range, law.shape));
    if let Some(bits) = law.length_bits {
        lines.push(words(format!(
            "lengths of segments are rounded to {bits} significant bits"
        )));
    }
    let passes = if law.eps > 0.0 {
        format!("(1 − αₖ + {})", number(law.eps))
    } else if law.eps < 0.0 {
        format!("(1 − αₖ − {})", number(-law.eps))
    } else {
        "(1 − αₖ)".into()
    };
    Described {
        light,
        passes,
        lines,
    }
}

/// Whether the opacity of a unit is raised to a power; a table has no need to.
fn is_by_power(law: &Law) -> bool {
    law.is_by_power() && law.range.table.is_none()
}

/// α of x.
fn opacity(law: &Law) -> String {
    if is_by_power(law) {
        let of_unit = Depth {
            length: Power::ZERO,
            ..law.depth
        };
        let unit = of_unit.text("");
        let unit = unit.trim_start_matches(" = ");
        return format!("1 − (1 − uⱼ)^(dⱼ),  uⱼ = 1 − exp(−{unit})");
    }
    shape(law.shape, "xⱼ")
}

/// 1 − p of the name of a depth.
fn shape(shape: Shape, x: &str) -> String {
    match shape {
        Shape::Exponential => format!("1 − exp(−{x})"),
        Shape::Linear => x.into(),
        Shape::Reciprocal => format!("{x}/(1 + {x})"),
        Shape::Quadratic => format!("{x} − {x}²/2"),
        Shape::CrankNicolson => format!("{x}/(1 + {x}/2)"),
        Shape::Clear => "0".into(),
    }
}

/// The product that the weight is, or the formula of one that is none.
fn weight(law: &Law) -> Result<String, String> {
    let scale = if (law.scale.0 - 1.0).abs() > 0.0 {
        Some(number(law.scale.0))
    } else {
        None
    };
    let powers = |parts: Vec<String>| {
        let all = scale.clone().into_iter().chain(parts);
        all.collect::<Vec<String>>().join(" ")
    };
    match law.weight {
        Weight::Opacity { opacity, passes } => {
            let parts = [power("αⱼ", opacity), power("(1 − αⱼ)", passes)];
            Ok(powers(parts.into_iter().flatten().collect()))
        }
        Weight::Depth { depth, passes } => {
            let depth = depth.text("");
            let depth = depth.trim_start_matches(" = ");
            let depth = match law.range.opacity_max {
                Some(most) => format!("min({depth}, {})", number(most)),
                None => depth.into(),
            };
            let parts = [Some(depth), power("(1 − αⱼ)", passes)];
            Err(powers(parts.into_iter().flatten().collect()))
        }
        Weight::Own { depth, shape: own } => {
            let depth = depth.text("");
            let depth = depth.trim_start_matches(" = ");
            let y = if own == Shape::Exponential {
                depth
            } else {
                "yⱼ"
            };
            let of_depth = shape(own, y);
            let scaled = match &scale {
                Some(scale) => format!("{scale} {}", factor(&of_depth)),
                None => of_depth,
            };
            Err(if y == "yⱼ" {
                format!("{scaled},  yⱼ = {depth}")
            } else {
                scaled
            })
        }
    }
}

/// x to a power, unless that is 0.
fn power(x: &str, power: Power) -> Option<String> {
    let halves = power.halves;
    Some(match halves {
        0 => return None,
        2 => x.into(),
        1 if x.starts_with('(') => format!("√{x}"),
        1 => format!("√({x})"),
        4 => format!("{x}²"),
        6 => format!("{x}³"),
        _ if halves % 2 == 0 => format!("{x}^({})", halves / 2).replace('-', "−"),
        _ => format!("{x}^({halves}/2)").replace('-', "−"),
    })
}

impl Depth {
    /// name = κ τ^a d^b D^c.
    fn text(&self, name: &str) -> String {
        let mut parts = Vec::new();
        if (self.factor - 1.0).abs() > 0.0 {
            parts.push(number(self.factor));
        }
        let powers = [
            ("τⱼ", self.extinction),
            ("dⱼ", self.length),
            ("D", self.ray),
        ];
        let mut under = String::new();
        for (x, exponent) in powers {
            if exponent < Power::ZERO {
                let positive = Power {
                    halves: exponent.halves.saturating_neg(),
                };
                under.extend(power(x, positive).map(|x| format!("/{x}")));
            } else {
                parts.extend(power(x, exponent));
            }
        }
        if parts.is_empty() {
            parts.push("1".into());
        }
        format!("{name} = {}{under}", parts.join(" "))
    }
}

/// Where the law does not hold, line by line.
fn range(range: &Range, of: Shape) -> Vec<Line> {
    let mut all = Vec::new();
    let mut say = |limit: Option<f64>, text: &dyn Fn(String) -> String| {
        all.extend(limit.map(|limit| words(text(number(limit)))));
    };
    say(range.extinction_max, &|x| {
        format!("an extinction above {x} counts as {x}")
    });
    say(range.depth_max, &|x| {
        format!("a depth above {x} counts as {x}")
    });
    say(range.skip, &|x| {
        format!("a sample of an opacity under {x} is skipped")
    });
    say(range.skip_extinction, &|x| {
        format!("a sample of an extinction under {x} is skipped")
    });
    say(range.opacity_max, &|x| {
        format!("an opacity above {x} counts as {x}")
    });
    say(range.quantum, &|x| {
        let of = if range.quantised.is_of_unit() {
            "the opacities uⱼ"
        } else {
            "opacities"
        };
        let down = if range.quantised.is_below() {
            " down"
        } else {
            ""
        };
        format!("{of} are rounded{down} to multiples of {x}")
    });
    if let Some(threshold) = range.uncorrected_under {
        let (length, threshold) = (number(range.uncorrected_length), number(threshold));
        all.push(formula(format!(
            "αⱼ = 1 − exp(−{length} τⱼ) where that is at most {threshold}, whatever the step"
        )));
    }
    if let Some(series) = range.series {
        all.push(words(format!(
            "where the depth is under {} the opacity is the series up to power {}",
            number(series.below),
            series.terms
        )));
    }
    if let Some(table) = range.table {
        all.extend(looked_up(table, of));
    }
    all
}

fn looked_up(table: Table, of: Shape) -> Vec<Line> {
    let step = number(table.step);
    let how = match table.between {
        Step::Nearest => {
            format!("opacities come from a table over depths, step {step}: the nearest entry")
        }
        Step::Below => {
            format!("opacities come from a table over depths, step {step}: the entry before")
        }
        Step::Linear => {
            format!("opacities come from a table over depths, step {step}: linear between entries")
        }
        Step::NearestExtinction => {
            format!("opacities come from a table over extinctions, step {step}: the nearest entry")
        }
        Step::PowersOfTwo => format!(
            "exponentials are linear between powers of two, one of which is at the depth {step}"
        ),
    };
    let mut all = vec![words(how)];
    let is_of_depth = table.between != Step::NearestExtinction;
    if let Some(top) = table.top.filter(|_| is_of_depth) {
        all.push(words(format!(
            "the table ends at the depth {}",
            number(top)
        )));
    }
    if of != Shape::Exponential && table.between == Step::PowersOfTwo {
        all.push(formula("1 − αⱼ ≈ exp(−xⱼ)"));
    }
    all
}

/// A factor in words, unless it is 1.
pub(super) fn scale(scale: Scale) -> Option<String> {
    ((scale.0 - 1.0).abs() > 0.0).then(|| number(scale.0))
}

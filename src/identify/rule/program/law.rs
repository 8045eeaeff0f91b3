//! What one sample does, as statements.

use super::expression::{factor, multiple_below, nearest_multiple, number, product, scaled};
use super::{Statement, at_most, set, when};
use crate::identify::rule::{Depth, Law, Power, Quantised, Range, Step, Table, Weight};

/// What one step of the march does, as statements and expressions.
pub(super) struct Layer {
    pub(super) statements: Vec<Statement>,
    /// The weight of its first sample.
    pub(super) first: String,
    /// Σ w C.
    pub(super) light: String,
    /// p.
    pub(super) passes: String,
}

/// (w, p) of a sample with that extinction and the length d.
pub(super) fn law(law: &Law, extinction: &str) -> (Vec<Statement>, String, String) {
    let range = &law.range;
    let mut all = Vec::new();
    if let Some(bits) = law.length_bits {
        all.push(set("d", format!("rounded(d, {bits})")));
    }
    let mut t = extinction;
    if let Some(most) = range.extinction_max {
        all.push(set("t", t));
        all.push(at_most("t", most));
        t = "t";
    }
    all.push(set("x", law.depth.program(t, "d")));
    if let Some(most) = range.depth_max {
        all.push(at_most("x", most));
    }
    let follows_shape = follows_shape(law, &mut all, t);
    let is_skipped = corrected(law, &mut all, t);
    let mut rest = Vec::new();
    limited(range, &mut rest);
    let weight = weight(law, &mut rest, t);
    if is_plain(law) && follows_shape {
        let (_, passes) = law.shape.program("x");
        all.retain(|statement| !matches!(statement, Statement::Set("p", _)));
        all.extend(rest);
        return (all, weight, passes);
    }
    let has_eps = law.eps.abs() > 0.0;
    let eps = number(law.eps);
    if !has_eps && is_skipped.is_none() {
        all.extend(rest);
        return (all, weight, "p".into());
    }
    rest.push(set("w", weight));
    if has_eps {
        rest.push(super::change("p", '+', eps.as_str()));
    }
    match is_skipped {
        Some(condition) => {
            let clear = if has_eps {
                format!("1 + {eps}")
            } else {
                "1.0".into()
            };
            let none = vec![set("w", "0.0"), set("p", clear)];
            all.push(Statement::If(condition, none, rest));
        }
        None => all.extend(rest),
    }
    (all, "w".into(), "p".into())
}

/// Whether p is an expression that stands in one place only.
fn is_plain(law: &Law) -> bool {
    let needs_passes = match law.weight {
        Weight::Opacity { passes, .. } | Weight::Depth { passes, .. } => passes != Power::ZERO,
        Weight::Own { .. } => false,
    };
    law.range
        == Range {
            depth_max: law.range.depth_max,
            extinction_max: law.range.extinction_max,
            uncorrected_length: law.range.uncorrected_length,
            ..Range::default()
        }
        && law.eps.abs() <= 0.0
        && (law.cover.0 - 1.0).abs() <= 0.0
        && !needs_passes
}

/// α and p of x before anything corrects them; whether they are those of the shape at x.
fn follows_shape(law: &Law, all: &mut Vec<Statement>, t: &str) -> bool {
    if let Some(table) = law.range.table {
        looked_up(law, table, all, t);
        return false;
    }
    if law.is_by_power() {
        let of_unit = Depth {
            length: Power::ZERO,
            ..law.depth
        };
        all.push(set(
            "unit",
            format!("1 - exp(-{})", of_unit.program(t, "d")),
        ));
        if let Some(quantum) = law
            .range
            .quantum
            .filter(|_| law.range.quantised.is_of_unit())
        {
            all.push(set("unit", multiple(law.range.quantised, "unit", quantum)));
        }
        all.push(set("p", "pow(1 - unit, d)"));
        all.push(set("alpha", "1 - p"));
        return false;
    }
    let (opacity, passes) = law.shape.program("x");
    all.push(set("alpha", opacity));
    all.push(set("p", passes));
    true
}

fn looked_up(law: &Law, table: Table, all: &mut Vec<Statement>, t: &str) {
    let step = table.step;
    if table.between == Step::NearestExtinction {
        all.push(set("y", nearest_multiple(t, step)));
        all.push(set("y", law.depth.program("y", "d")));
    } else {
        all.push(set("y", "x"));
        if let Some(top) = table.top {
            all.push(at_most("y", top));
        }
    }
    let of_shape = |all: &mut Vec<Statement>| {
        let (opacity, passes) = law.shape.program("y");
        all.push(set("alpha", opacity));
        all.push(set("p", passes));
    };
    match table.between {
        Step::NearestExtinction => of_shape(all),
        Step::Nearest => {
            all.push(set("y", nearest_multiple("y", step)));
            of_shape(all);
        }
        Step::Below => {
            all.push(set("y", multiple_below("y", step)));
            of_shape(all);
        }
        Step::PowersOfTwo => {
            all.push(set("y", format!("({} - y) / log(2.0)", number(step))));
            all.push(set("z", "floor(y)"));
            all.push(set("p", "(1 + y - z) * pow(2.0, z)"));
            all.push(set("alpha", "1 - p"));
        }
        Step::Linear => {
            all.push(set("z", multiple_below("y", step)));
            all.push(set("u", format!("z + {}", number(step))));
            let (near, far) = (law.shape.program("z").0, law.shape.program("u").0);
            all.push(set("alpha", near));
            let between = format!(
                "alpha + ({} - alpha) * (y - z) / {}",
                factor(&far),
                number(step)
            );
            all.push(set("alpha", between));
            all.push(set("p", "1 - alpha"));
        }
    }
}

/// What is put in place of α and p, and the condition under which the sample counts as clear.
fn corrected(law: &Law, all: &mut Vec<Statement>, t: &str) -> Option<String> {
    let range = &law.range;
    if (law.cover.0 - 1.0).abs() > 0.0 {
        all.push(super::change("alpha", '*', number(law.cover.0)));
        all.push(set("p", "1 - alpha"));
    }
    if let Some(series) = range.series {
        let polynomial = set("alpha", taylor(series.terms));
        let then = vec![polynomial, set("p", "1 - alpha")];
        all.push(when(format!("x < {}", number(series.below)), then));
    }
    if let Some(threshold) = range.uncorrected_under {
        let depth = format!("{t} * {}", number(range.uncorrected_length));
        all.push(set("y", depth));
        let then = vec![set("alpha", "-expm1(-y)"), set("p", "exp(-y)")];
        let condition = format!("-expm1(-y) <= {}", number(threshold));
        all.push(when(condition, then));
    }
    let of_opacity = range.skip.map(|least| format!("alpha < {}", number(least)));
    let of_extinction = range
        .skip_extinction
        .map(|least| format!("{t} < {}", number(least)));
    match (of_opacity, of_extinction) {
        (Some(one), Some(other)) => Some(format!("{one} or {other}")),
        (one, other) => one.or(other),
    }
}

/// The multiple that stands in an opacity's place.
fn multiple(how: Quantised, opacity: &str, quantum: f64) -> String {
    if how.is_below() {
        multiple_below(opacity, quantum)
    } else {
        nearest_multiple(opacity, quantum)
    }
}

/// The largest opacity, and multiples.
fn limited(range: &Range, all: &mut Vec<Statement>) {
    if let Some(most) = range.opacity_max {
        let most = number(most);
        let then = vec![set("alpha", most.as_str()), set("p", format!("1 - {most}"))];
        all.push(when(format!("alpha > {most}"), then));
    }
    if let Some(quantum) = range.quantum.filter(|_| !range.quantised.is_of_unit()) {
        all.push(set("alpha", multiple(range.quantised, "alpha", quantum)));
        all.push(set("p", "1 - alpha"));
    }
}

/// w.
fn weight(law: &Law, all: &mut Vec<Statement>, t: &str) -> String {
    match law.weight {
        Weight::Opacity { opacity, passes } => {
            product(law.scale.0, &[("alpha", opacity), ("p", passes)])
        }
        Weight::Depth { depth, passes } => {
            let depth = depth.program(t, "d");
            let Some(most) = law.range.opacity_max else {
                let by = product(law.scale.0, &[("p", passes)]);
                return if by == "1.0" {
                    depth
                } else {
                    format!("{depth} * {by}")
                };
            };
            all.push(set("y", depth));
            all.push(at_most("y", most));
            product(law.scale.0, &[("y", Power::ONE), ("p", passes)])
        }
        Weight::Own { depth, shape } => {
            all.push(set("y", depth.program(t, "d")));
            scaled(&shape.program("y").0, law.scale)
        }
    }
}

/// x − x²/2 + … up to that many terms, by Horner's rule.
fn taylor(terms: u8) -> String {
    let mut inner = String::new();
    for k in (1..=terms).rev() {
        let x = if k == 1 {
            "x".into()
        } else {
            format!("x / {k}")
        };
        inner = if inner.is_empty() {
            x
        } else {
            format!("{x} * (1 - {inner})")
        };
    }
    if inner.is_empty() {
        "0.0".into()
    } else {
        inner
    }
}

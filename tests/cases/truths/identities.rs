//! Functions of s that are 0 on [0, D], or that are not, at a point or beyond.

use super::{Claim, Draw, Truth};

/// Functions that have a value on all of [0, 1].
const TOTAL: [&str; 9] = [
    "s",
    "(s - 1/2)",
    "(1 + s)",
    "(s^2 + 1)",
    "exp(s)",
    "sin(3*s)",
    "(2 - s^2)",
    "atan(s)",
    "sqrt(1 + s)",
];
/// Those of them that are above 0 on it.
const POSITIVE: [&str; 5] = ["(1 + s)", "(s^2 + 1)", "exp(s)", "(2 - s^2)", "sqrt(1 + s)"];

/// A function that is 0 on [0, 1].
fn zero(draw: &mut Draw, depth: u32) -> String {
    let u = *draw.of(&TOTAL);
    let p = *draw.of(&POSITIVE);
    let q = draw.part();
    match draw.below(if depth > 0 { 21 } else { 16 }) {
        0 => format!("(sin({u})^2 + cos({u})^2 - 1)"),
        1 => format!("(ln(exp({u})) - {u})"),
        2 => format!("(sqrt({p}^2) - {p})"),
        3 => format!("(abs({u}) - max({u}, -{u}))"),
        4 => format!("(min({u}, {q}) + max({u}, {q}) - {u} - {q})"),
        5 => format!("(exp(2*ln({p})) - {p}^2)"),
        6 => format!("(cosh({u})^2 - sinh({u})^2 - 1)"),
        7 => format!("(({u} + {q})^2 - {u}^2 - 2*({q})*{u} - ({q})^2)"),
        8 => format!("(atan({p}) + atan(1/{p}) - pi/2)"),
        9 => format!("(ln({p}^2) - 2*ln({p}))"),
        10 => format!("(sin(2*atan({u})) - 2*{u}/(1 + {u}^2))"),
        11 => format!("(sqrt({p}^2 + 2*({q})*{p} + ({q})^2) - {p} - {q})"),
        12 => format!("(abs({u})*abs({u}) - {u}^2)"),
        13 => format!("(piecewise(s < {q}, {u}, {u}) - {u})"),
        14 => format!("(erf({u}) + erf(-{u}))"),
        15 => format!("(({p}^3)^(1/3) - {p})"),
        16 => format!("{u}*{}", zero(draw, depth - 1)),
        17 => {
            let (a, b) = (zero(draw, depth - 1), zero(draw, depth - 1));
            let relation = draw.of(&["<", "<=", ">", ">="]);
            format!("piecewise(s {relation} {q}, {a}, {b})")
        }
        18 => format!("({} + {})", zero(draw, depth - 1), zero(draw, depth - 1)),
        19 => format!("sin({})", zero(draw, depth - 1)),
        // Nowhere true.
        _ => {
            let never = draw.of(&["(s - {q})^2 < 0", "s < -1", "s > 2", "s^2 + 1 <= 0"]);
            let never = never.replace("{q}", &q);
            format!(
                "piecewise({never}, {}, {})",
                draw.offset(),
                zero(draw, depth - 1)
            )
        }
    }
}

/// A function of s that is not 0 somewhere on [0, 1], and 0 elsewhere.
fn bump(draw: &mut Draw) -> String {
    let (q, c) = (draw.part(), draw.offset());
    let irrational = *draw.of(&["sqrt(1/2)", "sqrt(1/3)", "1/sqrt(5)", "(1/2)^(1/3)"]);
    match draw.below(16) {
        0 => format!("piecewise(s < {q}, 0, s <= {q}, {c}, 0)"),
        1 => format!("piecewise(abs(s - {q}) <= 0, {c}, 0)"),
        2 => format!("piecewise((s - {q})^2 <= 0, {c}, 0)"),
        3 => format!("piecewise(s <= 0, {c}, 0)"),
        4 => format!("piecewise(s >= 1, {c}, 0)"),
        5 => format!("piecewise(s > 0, piecewise(s < 1, 0, {c}), 0)"),
        6 => format!("piecewise(abs(s - {irrational}) <= 0, {c}, 0)"),
        7 => format!("piecewise(s^2 < ({q})^2, 0, s^2 <= ({q})^2, {c}, 0)"),
        8 => format!("piecewise(s <= {q}, piecewise(s >= {q}, {c}, 0), 0)"),
        9 => format!("max(0, {}*(s - {q}))", c.trim_start_matches('-')),
        10 => format!("piecewise(s < {q}, 0, {c}*(s - {q}))"),
        11 => format!("(abs(s - {q}) + s - {q})"),
        12 => format!("piecewise(abs(s - {q}) > 0, 0, {c})"),
        13 => format!("piecewise(-(s - {q})^2 >= 0, {c}, 0)"),
        14 => format!("piecewise(s^2 - 2*({q})*s + ({q})^2 <= 0, {c}, 0)"),
        _ => format!("{c}*s*exp(s)"),
    }
}

/// 0 where it has a value, which is not everywhere on [0, 1].
fn gap(draw: &mut Draw) -> String {
    let q = draw.part();
    match draw.below(10) {
        0 => "0*ln(s)".into(),
        1 => format!("0/(s - {q})"),
        2 => format!("0*sqrt({q} - s)"),
        3 => "0*ln(abs(s) - s)".into(),
        4 => format!("((s - {q})^0 - 1)"),
        5 => "(s/s - 1)".into(),
        6 => "0*tan(2*s)".into(),
        7 => format!("(ln(s - {q}) - ln(s - {q}))"),
        8 => format!("piecewise(abs(s - {q}) <= 0, 0*ln(s - {q}), 0)"),
        _ => format!("0*sqrt(-(s - {q})^2)"),
    }
}

pub(super) fn draw(draw: &mut Draw) -> Claim {
    let zero = zero(draw, 2);
    let (truth, all) = match draw.below(5) {
        0 | 1 => (Truth::True, zero),
        2 | 3 => {
            let bump = bump(draw);
            (Truth::False, format!("({zero} + {bump})"))
        }
        _ => {
            let gap = gap(draw);
            (Truth::Partial, format!("({zero} + {gap})"))
        }
    };
    Claim::of_identity(truth, "1", &all)
}

//! How a study is put in words.

use crate::convergence::{Fit, RoundoffLaw, Verdict};
use crate::document::Tone;
use crate::study::sweep::{Errors, Line, Part, Results, State, Theory};
use rug::Float;

/// What stands where there is no figure.
pub(super) const NONE: &str = "-";

/// The parts of an error, in the order of all plots.
pub(in crate::report) const PARTS: [(Part, &str); 5] = [
    (Part::Total, "total"),
    (Part::Discretization, "discretization"),
    (Part::Truncation, "truncation"),
    (Part::Input, "input rounding"),
    (Part::Arithmetic, "arithmetic rounding"),
];

/// "2.003 ± 0.021"; without a window the last pair's order, which has no interval: "~2.00".
pub(super) fn order(fit: &Fit) -> String {
    match (fit.order, fit.half_width) {
        (Some(order), _) if fit.window.is_none() => format!("~{order:.2}"),
        (Some(order), Some(half_width)) if half_width < 0.0005 => {
            format!("{order:.4} ± {half_width:.4}")
        }
        (Some(order), Some(half_width)) => format!("{order:.3} ± {half_width:.3}"),
        _ => NONE.into(),
    }
}

/// The order that theory gives.
pub(super) fn theory(theory: Theory) -> String {
    match theory {
        Theory::Order(order) => format!("{order}"),
        Theory::Exact => "exact".into(),
        Theory::Blind(general, here) => format!("{general}, here {here}"),
        Theory::Unknown => "unknown".into(),
    }
}

/// "0.52 ± 0.11".
pub(super) fn exponent(law: Option<RoundoffLaw>) -> String {
    law.map_or(NONE.into(), |law| {
        format!("{:.2} ± {:.2}", law.exponent, law.half_width)
    })
}

/// n*, to the digits it means.
pub(in crate::report) fn crossing(line: &Line) -> String {
    let split = line.summary.split.as_ref();
    let crossing = split.and_then(|split| split.crossing);
    crossing.map_or(NONE.into(), |n| {
        if n < 1e4 {
            format!("{n:.0}")
        } else {
            format!("{n:.1e}")
        }
    })
}

/// The least error that can be reached: "3.2e-8".
pub(in crate::report) fn best(line: &Line) -> String {
    let split = line.summary.split.as_ref();
    let best = split.and_then(|split| split.best);
    best.map_or(NONE.into(), |best| {
        scientific(&Float::with_val(64, best.log2_error).exp2())
    })
}

/// How good or bad the order of a line's discretization is, or of its total where that is all there is.
pub(super) fn judged(line: &Line) -> Tone {
    if line.contradicts_theory() {
        Tone::Bad
    } else {
        tone(line.summary.order().verdict)
    }
}

/// How good or bad a verdict is where theory says nothing.
pub(super) fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Confirmed | Verdict::Exact => Tone::Good,
        _ => Tone::Open,
    }
}

/// Two digits of a number of any magnitude.
fn scientific(x: &Float) -> String {
    let narrow = x.to_f64();
    if narrow == 0.0 || narrow.is_subnormal() || !narrow.is_finite() {
        return if x.is_zero() {
            "0".into()
        } else {
            x.to_string_radix(10, Some(2))
        };
    }
    format!("{narrow:.1e}")
}

/// What happened at some levels, one remark each.
pub(super) fn warnings(line: &Line) -> Vec<String> {
    let mut warnings = Vec::new();
    for (state, words) in [
        (State::NotFinite, "NotFinite: NaN or ∞"),
        (
            State::BranchDiverged,
            "BranchDiverged: the run stood on another side of a jump than in MPFR, its error is not split",
        ),
        (
            State::Unsettled,
            "Unsettled: more bits went on changing a part, its error is not split",
        ),
    ] {
        let levels = levels(line, |found| *found == state);
        if !levels.is_empty() {
            warnings.push(format!("n = {levels}: {words}"));
        }
    }
    let mut reasons: Vec<&String> = Vec::new();
    for level in &line.row.levels {
        if let State::Refused(reason) = &level.state
            && !reasons.contains(&reason)
        {
            reasons.push(reason);
        }
    }
    for reason in reasons {
        let levels = levels(line, |found| *found == State::Refused(reason.clone()));
        warnings.push(format!("n = {levels}: Refused: {reason}"));
    }
    if line.contradicts_theory() {
        let found = line.summary.order();
        let what = match line.summary.split {
            Some(_) => "discretization",
            None => "total",
        };
        warnings.push(format!(
            "{what}: {} {} where theory says {}",
            order(found),
            found.verdict,
            theory(line.row.expected)
        ));
    }
    warnings
}

fn levels(line: &Line, of: impl Fn(&State) -> bool) -> String {
    let levels = line.row.levels.iter().filter(|level| of(&level.state));
    let levels: Vec<String> = levels.map(|level| level.n.to_string()).collect();
    match &levels[..] {
        [first, .., last] if levels.len() > 4 => {
            format!("{first} … {last} ({} levels)", levels.len())
        }
        _ => levels.join(", "),
    }
}

/// "12 lines: 10 Confirmed, 2 Blind".
pub(super) fn summary(results: &Results) -> String {
    let mut counts: Vec<(Verdict, usize)> = Vec::new();
    let lines = results.lines.iter().filter(|line| !line.swept);
    let mut all = 0;
    for line in lines {
        all += 1;
        let verdict = line.summary.order().verdict;
        match counts.iter_mut().find(|(v, _)| *v == verdict) {
            Some((_, count)) => *count += 1,
            None => counts.push((verdict, 1)),
        }
    }
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let counts: Vec<String> = counts
        .iter()
        .map(|(v, count)| format!("{count} {v}"))
        .collect();
    let lines = if all == 1 { "line" } else { "lines" };
    if counts.is_empty() {
        return format!("{all} {lines}");
    }
    let what = match results.header.errors {
        Errors::Split => "discretization",
        Errors::Total => "total",
    };
    format!("{all} {lines}, {what}: {}", counts.join(", "))
}

/// What the table says; a word and its meaning each.
pub(super) const LEGEND: [(&str, &str); 6] = [
    (
        "discretization",
        "order of Q∞ − I, where Q∞ is the method without rounding, with its interval and verdict on theory; ~ is the last pair's, without an interval",
    ),
    (
        "total",
        "order of the whole error Q − I in the format, roundoff being its floor",
    ),
    (
        "q arithmetic",
        "arithmetic rounding grows as n^q, with its 95 % interval: 1/2 a random walk, 1 a bias",
    ),
    (
        "q input",
        "the same of the rounding of C, τ and s: -1/2 independent errors, 0 a bias",
    ),
    (
        "n*",
        "from there on roundoff is larger than discretization, by the fitted model",
    ),
    (
        "best",
        "the least error that any n reaches in the format, by the fitted model",
    ),
];

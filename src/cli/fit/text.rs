//! A fit as text of at most 80 columns.

use super::Report;
use rug::Float;
use std::fmt::Write;
use volver::convergence::table::FloorSource;
use volver::convergence::{Fit, Verdict, Window};
use volver::method::Expected;

pub(super) fn render(report: &Report, color: bool) -> String {
    let mut text = String::new();
    let fit = &report.fit;
    let mut line = |label: &str, value: &str| {
        // Writing to a String does not fail.
        let _ = writeln!(text, "{label:<9} {value}");
    };
    line("order", &order(fit));
    line(
        "window",
        &fit.window.as_ref().map_or("none".to_string(), window),
    );
    if let Some(log2) = fit.log2_constant {
        line(
            "constant",
            &format!("{} in |e| = c d^p", power_of_two(log2)),
        );
    }
    line("floor", &floor(report));
    let expected = match report.expected {
        Some(Expected::Order(p)) => format!(" (expected {p})"),
        Some(Expected::Exact) => " (expected exact)".into(),
        Some(Expected::Blind { .. } | Expected::Unknown) | None => String::new(),
    };
    line(
        "verdict",
        &format!("{}{expected}", paint(fit.verdict, color)),
    );
    for note in &fit.notes {
        line("note", &note.to_string());
    }
    text.push('\n');
    table(report, &mut text);
    text
}

fn order(fit: &Fit) -> String {
    match (fit.order, fit.half_width) {
        (Some(order), Some(half_width)) => {
            let window = fit.window.is_some();
            let remark = if window {
                ""
            } else {
                " (last pair and spread)"
            };
            format!("{order:.4} ± {half_width:.4}{remark}")
        }
        _ => "none".into(),
    }
}

fn window(window: &Window) -> String {
    let range = match (window.coarsest_n, window.finest_n) {
        (Some(coarsest), Some(finest)) => format!("n = {coarsest} to {finest}"),
        _ => format!(
            "step {:.4e} to {:.4e}",
            window.coarsest_step, window.finest_step
        ),
    };
    let levels = window.last + 1 - window.first;
    format!(
        "{range}, {levels} levels, pairwise orders within {}",
        window.tolerance
    )
}

fn floor(report: &Report) -> String {
    let source = match report.floor_source {
        FloorSource::Column => "from the table",
        FloorSource::Given => "as given",
        FloorSource::Digits => "half a unit of the last digit",
        FloorSource::Unknown => return "unknown".into(),
    };
    let cut = match &report.fit.cut {
        Some(cut) => format!("; cuts from level {}", cut.level),
        None => String::new(),
    };
    format!("{} ({source}){cut}", short(&report.fit.floor))
}

/// One line a level: the order of a line is that of the pair with the level before.
fn table(report: &Report, text: &mut String) {
    let fit = &report.fit;
    let _ = writeln!(
        text,
        "{:>5}  {:>10}  {:>11}  {:>12}  {:>9}",
        "level", "n", "step", "error", "order"
    );
    for (level, sample) in report.samples.iter().enumerate() {
        let n = sample.n.map_or("-".to_string(), |n| n.to_string());
        let pair = fit.pairs.iter().find(|p| p.coarse + 1 == level);
        let order = pair.map_or("-".to_string(), |p| format!("{:.4}", p.order));
        let inside = fit
            .window
            .is_some_and(|w| (w.first..=w.last).contains(&level));
        let mark = match &fit.cut {
            Some(cut) if level >= cut.level => "  floor",
            _ if inside => "  window",
            _ => "",
        };
        let _ = writeln!(
            text,
            "{level:>5}  {n:>10}  {:>11.4e}  {:>12}  {order:>9}{mark}",
            sample.step,
            short(&sample.error),
        );
    }
}

/// Five significant digits, whatever the magnitude.
fn short(x: &Float) -> String {
    if x.is_zero() {
        "0".into()
    } else {
        x.to_string_radix(10, Some(5))
    }
}

/// 2^log₂ with five significant digits; −6645 is 10^−2000, which binary64 does not hold.
fn power_of_two(log2: f64) -> String {
    short(&Float::with_val(64, log2).exp2())
}

/// Green passes or is good news, yellow is inconclusive, red is wrong.
fn paint(verdict: Verdict, color: bool) -> String {
    let code = match verdict {
        Verdict::Confirmed | Verdict::Fitted | Verdict::Exact => 32,
        Verdict::PreAsymptotic
        | Verdict::FloorLimited
        | Verdict::TooFewLevels
        | Verdict::Oscillatory
        | Verdict::Blind => 33,
        Verdict::TooLow
        | Verdict::TooHigh
        | Verdict::Stalled
        | Verdict::Diverged
        | Verdict::NotFinite => 31,
    };
    if color {
        format!("\x1b[{code}m{verdict}\x1b[0m")
    } else {
        verdict.to_string()
    }
}

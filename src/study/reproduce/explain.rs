//! Why the paper's figure and the order differ, read off the measured errors.

use super::protocol;
use crate::convergence::{Fit, OrderInterval, Sample, StochasticFit, Verdict, transition};
use crate::method::{Expected, Limit, Part};
use crate::real::{MpfrReal, Real};
use std::fmt::Write;

/// Figures are printed with two decimals.
const PRINTED: f64 = 0.005;
/// More than this between paper and protocol is not the protocol's doing.
const UNEXPLAINED: f64 = 0.02;
/// A binary64 error that is off by this part of itself has met its roundoff.
const ROUNDOFF_SHARE: f64 = 0.05;

/// What was measured of one deterministic entry.
pub(super) struct Evidence<'a> {
    pub(super) paper: Option<f64>,
    pub(super) limits: &'a [Limit],
    pub(super) expected: Expected,
    /// The fit that the order comes from, and its samples.
    pub(super) fit: &'a Fit,
    pub(super) samples: &'a [Sample],
    /// The protocol's levels in binary64, and the same in exact arithmetic.
    pub(super) in_binary64: &'a [Sample],
    pub(super) in_exact: &'a [Sample],
}

/// One line, or nothing where paper and order agree and the verdict needs no explanation.
pub(super) fn explain(evidence: &Evidence<'_>) -> Option<String> {
    let fit = evidence.fit;
    let Some(order) = fit.order else {
        return roundoff_cut(evidence);
    };
    // Without a window the half-width is a spread, which excuses nothing.
    let half_width = fit.half_width.filter(|_| fit.window.is_some());
    let differs = evidence
        .paper
        .is_some_and(|paper| (paper - order).abs() > PRINTED + half_width.unwrap_or(0.0));
    let transition = transition_note(evidence);
    if !differs && fit.verdict == Verdict::Confirmed && transition.is_none() {
        return None;
    }
    match fit.verdict {
        Verdict::Blind => return Some(degenerate(evidence, order)),
        Verdict::Stalled => return Some(stalled(evidence)),
        _ => {}
    }
    if transition.is_some() {
        return transition;
    }
    if fit.verdict != Verdict::Confirmed
        && let Some(note) = roundoff_cut(evidence)
    {
        return Some(note);
    }
    if differs {
        contributions(evidence, order)
    } else {
        None
    }
}

/// Where the format's own roundoff ended the ladder.
fn roundoff_cut(evidence: &Evidence<'_>) -> Option<String> {
    let cut = evidence.fit.cut.as_ref()?;
    let n = evidence.samples.get(cut.level)?.n?;
    Some(format!(
        "roundoff floor: the errors meet the format's own roundoff at n = {n}"
    ))
}

/// What the protocol's window and binary64's roundoff each add to the order, the larger first.
fn contributions(evidence: &Evidence<'_>, order: f64) -> Option<String> {
    let in_exact = protocol::order(evidence.in_exact)?;
    let in_binary64 = protocol::order(evidence.in_binary64)?;
    let window = in_exact - order;
    let roundoff = in_binary64 - in_exact;
    let mut causes = Vec::new();
    if window.abs() > PRINTED {
        causes.push((window.abs(), pre_asymptotic(evidence, window)));
    }
    if roundoff.abs() > PRINTED
        && let Some(text) = roundoff_floor(evidence, roundoff)
    {
        causes.push((roundoff.abs(), text));
    }
    causes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut texts: Vec<String> = causes.into_iter().map(|(_, text)| text).collect();
    if let Some(paper) = evidence.paper
        && (paper - in_binary64).abs() > UNEXPLAINED
    {
        texts.push(format!(
            "this protocol gives {in_binary64:.2}, not the paper's {paper:.2}"
        ));
    }
    if texts.is_empty() {
        texts.push(pre_asymptotic(evidence, window));
    }
    Some(texts.join("; "))
}

fn pre_asymptotic(evidence: &Evidence<'_>, effect: f64) -> String {
    format!(
        "pre-asymptotic window ({effect:+.2}): pairwise orders {} over n = {}",
        list(&pairwise(evidence.in_exact)),
        span(evidence.in_exact)
    )
}

/// Where binary64 first leaves exact arithmetic, and what becomes of the pairwise orders there.
fn roundoff_floor(evidence: &Evidence<'_>, effect: f64) -> Option<String> {
    let level = evidence
        .in_binary64
        .iter()
        .zip(evidence.in_exact)
        .position(|(rounded, exact)| {
            let difference = (rounded.error.clone() - &exact.error).abs();
            difference > exact.error.clone().abs() * ROUNDOFF_SHARE
        })?;
    let n = evidence.in_binary64.get(level)?.n?;
    let from = level.saturating_sub(1);
    Some(format!(
        "roundoff floor ({effect:+.2}): from n = {n} binary64's pairwise orders are {}, in exact arithmetic {}",
        list(pairwise(evidence.in_binary64).get(from..)?),
        list(pairwise(evidence.in_exact).get(from..)?),
    ))
}

/// A sub-integration that is the limit in the end, but not yet at the coarse levels.
fn transition_note(evidence: &Evidence<'_>) -> Option<String> {
    let orders = || evidence.limits.iter().filter(|limit| !limit.vanishes);
    let low = orders().filter_map(|limit| limit.order).reduce(f64::min)?;
    let high = orders()
        .filter_map(|limit| limit.order)
        .filter(|&order| order > low)
        .reduce(f64::min)?;
    let by_sub_integration = orders()
        .filter(|limit| limit.order.is_some_and(|order| order <= low))
        .all(|limit| limit.part == Part::SubIntervals);
    let measured = pairwise(evidence.samples);
    let highest = measured.iter().copied().reduce(f64::max)?;
    if !by_sub_integration || highest < f64::midpoint(low, high) {
        return None;
    }
    let length = evidence.samples.first().map(|s| (s.step, s.n))?;
    let mut text = format!(
        "transition to the sub-integration's order {low}: pairwise orders {} over n = {}",
        list(&measured),
        span(evidence.samples)
    );
    let crossover = transition(evidence.samples, high, low)
        .ok()
        .and_then(|t| t.crossover)
        .zip(length.1);
    if let Some((step, n)) = crossover {
        let crossover = length.0 * n as f64 / step;
        let _ = write!(text, ", crossover near n = {crossover:.0}");
    }
    Some(text)
}

fn degenerate(evidence: &Evidence<'_>, order: f64) -> String {
    let vanishing: Vec<String> = evidence
        .limits
        .iter()
        .filter(|limit| limit.vanishes)
        .filter_map(|limit| Some(format!("{} (order {})", limit.part, limit.order?)))
        .collect();
    let general = match evidence.expected {
        Expected::Blind { general, .. } => format!(" where {general} is the general order"),
        _ => String::new(),
    };
    format!(
        "degenerate case: no error from the {}, so it shows {order:.2}{general}; last pairwise orders {}",
        vanishing.join(", "),
        list(tail(&pairwise(evidence.samples)))
    )
}

fn stalled(evidence: &Evidence<'_>) -> String {
    let limit = evidence
        .samples
        .last()
        .map_or(f64::NAN, |sample| sample.error.to_f64());
    format!(
        "unconverging: the error tends to {limit:.2e}, last pairwise orders {}",
        list(tail(&pairwise(evidence.samples)))
    )
}

/// The same for an entry with replicas: the paper's figure is one run, `order` is what was measured.
pub(super) fn explain_stochastic(
    paper: Option<f64>,
    fit: &StochasticFit,
    order: Option<OrderInterval>,
    single_runs: &[f64],
) -> Option<String> {
    if fit.verdict == Verdict::Stalled {
        let bias = fit.levels.last()?.mean;
        let orders: Vec<f64> = fit
            .levels
            .windows(2)
            .map(|pair| {
                (pair[0].mean / pair[1].mean).abs().ln() / (pair[0].step / pair[1].step).ln()
            })
            .collect();
        return Some(format!(
            "unconverging linearisation: the mean error tends to {bias:.2e}, its pairwise orders {}",
            list(&orders)
        ));
    }
    let order = order?;
    let paper = paper?;
    if (order.low - PRINTED..=order.high + PRINTED).contains(&paper) {
        return None;
    }
    let least = single_runs.iter().copied().reduce(f64::min)?;
    let most = single_runs.iter().copied().reduce(f64::max)?;
    Some(format!(
        "single run: {} runs by themselves fit {least:.2} … {most:.2}; their standard deviation has order {:.2}",
        fit.replicas, order.order
    ))
}

fn pairwise(samples: &[Sample]) -> Vec<f64> {
    let logs: Vec<(f64, f64)> = samples
        .iter()
        .map(|s| (s.step.log2(), MpfrReal::from(s.error.clone()).log2_abs()))
        .collect();
    logs.windows(2)
        .map(|pair| (pair[0].1 - pair[1].1) / (pair[0].0 - pair[1].0))
        .collect()
}

fn tail(orders: &[f64]) -> &[f64] {
    &orders[orders.len().saturating_sub(3)..]
}

fn list(orders: &[f64]) -> String {
    let texts: Vec<String> = orders.iter().map(|p| format!("{p:.2}")).collect();
    texts.join(" ")
}

/// "8 … 1024".
fn span(samples: &[Sample]) -> String {
    let n = |sample: Option<&Sample>| sample.and_then(|s| s.n).unwrap_or(0);
    format!("{} … {}", n(samples.first()), n(samples.last()))
}

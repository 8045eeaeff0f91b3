//! What is to be said of a kernel that draws random numbers, beside its orders.

use super::line::Measured;
use super::{Finding, Line, MAX_REPLICAS, Standing, Verification};
use crate::convergence::{MAX_HALF_WIDTH, ReportedError, StochasticFit, Verdict};

/// All of it, what is wrong first.
pub(super) fn findings(verification: &Verification) -> Vec<Finding> {
    if !verification.declaration.stochastic {
        return Vec::new();
    }
    let reported = reported(&verification.lines);
    if let Some(seeds) = seeds(verification) {
        // What repeats has no standard error: nothing else holds of it.
        return std::iter::once(seeds).chain(reported).collect();
    }
    let all = [bias(&verification.lines), reported, too_few(verification)];
    all.into_iter().flatten().collect()
}

fn fit(line: &Line) -> Option<&StochasticFit> {
    match &line.measured {
        Measured::Scattered(fit) => Some(fit),
        Measured::Fitted { .. } | Measured::Nothing => None,
    }
}

fn names<'a>(lines: impl Iterator<Item = &'a Line>) -> Vec<String> {
    lines.map(|line| line.name.clone()).collect()
}

/// Seeds that have no answers of their own.
fn seeds(verification: &Verification) -> Option<Finding> {
    let different = verification.different_seeds?;
    let all = verification.settings.replicas;
    let words = match different {
        _ if !verification.seeds_repeat() => return None,
        0 | 1 => format!("the seed has no effect: the answers to all {all} seeds are the same"),
        _ => format!("{all} seeds have {different} different sets of answers"),
    };
    let errs = |line: &&Line| line.measured.verdict() != Verdict::Exact;
    Some(Finding {
        words,
        channels: names(verification.lines.iter().filter(errs)),
        wrong: true,
    })
}

/// Means that are off, and do not fall for all that is known.
fn bias(lines: &[Line]) -> Option<Finding> {
    let stay = |line: &&Line| fit(line).is_some_and(|fit| fit.bias_may_stay);
    let channels: Vec<&Line> = lines.iter().filter(stay).collect();
    let most = channels.iter().filter_map(|line| {
        let level = fit(line)?.most_biased()?;
        Some(level.mean.abs() / level.standard_error)
    });
    let most = most.reduce(f64::max)?;
    let off = if most.is_finite() {
        format!("by up to {most:.0} of its standard errors")
    } else {
        "and has no standard error".into()
    };
    Some(Finding {
        words: format!("the mean is off, {off}, and nothing shows that this falls with the step"),
        wrong: channels
            .iter()
            .any(|line| line.standing == Standing::Contradicted),
        channels: names(channels.into_iter()),
    })
}

/// Standard errors that are not the scatter.
fn reported(lines: &[Line]) -> Option<Finding> {
    let wrong = |line: &&Line| line.reported.as_ref().is_some_and(ReportedError::is_wrong);
    let channels: Vec<&Line> = lines.iter().filter(wrong).collect();
    let ratios = channels
        .iter()
        .filter_map(|line| Some(line.reported?.ratio));
    let mut ratios: Vec<f64> = ratios.collect();
    ratios.sort_by(f64::total_cmp);
    let middle = *ratios.get(ratios.len() / 2)?;
    Some(Finding {
        words: if middle.is_finite() {
            format!(
                "the standard errors that it reports are {middle:.2} times the scatter of its answers"
            )
        } else {
            "standard errors that it reports are negative or no numbers".into()
        },
        channels: names(channels.into_iter()),
        wrong: true,
    })
}

/// Intervals that more seeds would make narrow enough.
fn too_few(verification: &Verification) -> Option<Finding> {
    let replicas = verification.settings.replicas;
    let needed = |line: &Line| {
        let open = matches!(
            line.measured.verdict(),
            Verdict::PreAsymptotic | Verdict::FloorLimited
        );
        let scatter = fit(line)?.deviation;
        let width = scatter.filter(|_| fit(line).is_some_and(|fit| !fit.bias_may_stay))?;
        let width = width.half_width();
        let times = (width / MAX_HALF_WIDTH).powi(2);
        // Ends of intervals are known to some ten per cent themselves.
        let needed = 1.2 * times * replicas as f64;
        let wide = open && times > 1.0 && needed <= MAX_REPLICAS as f64;
        wide.then_some(needed)
    };
    let lines = verification.lines.iter();
    let wide: Vec<(&Line, f64)> = lines
        .filter_map(|line| Some((line, needed(line)?)))
        .collect();
    let most = wide.iter().map(|(_, needed)| *needed).reduce(f64::max)?;
    let rounded = (most / 10.0).ceil() * 10.0;
    Some(Finding {
        words: format!(
            "{replicas} seeds are too few to tell an order: with --replicas {rounded} its interval would be narrow enough"
        ),
        channels: names(wide.into_iter().map(|(line, _)| line)),
        wrong: false,
    })
}

//! How a comparison is put in words.

use crate::study::tradeoff::{
    CaseResults, Cost, Goal, Outcome, Point, Results, Unit, agreement, clock_name,
};

/// A duration from nanoseconds, with two significant digits.
pub(super) fn time(nanoseconds: f64) -> String {
    let units = ["ns", "µs", "ms", "s"];
    let mut value = nanoseconds;
    let mut unit = 0;
    while value >= 999.5 && unit + 1 < units.len() {
        value /= 1000.0;
        unit += 1;
    }
    let digits = usize::from(value < 9.95);
    format!("{value:.digits$} {}", units[unit])
}

/// An error with two significant digits; `exact` where there is none to be seen.
pub(super) fn error(point: &Point) -> String {
    match point.outcome.error() {
        Some(error) if error.is_zero() => "exact".into(),
        Some(error) => {
            // rug writes 1.2e-5 itself, at any magnitude.
            let text = format!("{error:.2e}");
            text.replace("e0", "")
        }
        None => point.outcome.name().into(),
    }
}

/// The time to show for a point: what it is compared by, or nothing.
pub(super) fn time_of(point: &Point, cost: Cost) -> String {
    let shown = match cost {
        Cost::Measured => point.measured.map(|timing| timing.median),
        _ => point.modelled,
    };
    shown.map_or(String::new(), time)
}

/// Method, format, n, evaluations, operations and time of a goal.
pub(super) fn way((unit, point): (&Unit, &Point), cost: Cost) -> [String; 6] {
    [
        point.method.name(),
        unit.format.to_string(),
        point.n.to_string(),
        point.counts.evaluations().to_string(),
        point.counts.operations().to_string(),
        time_of(point, cost),
    ]
}

/// What the usual choice takes: "n 64, 64 evaluations, 12 µs", or that it does not get there.
pub(super) fn usual(goal: &Goal<'_>, cost: Cost) -> String {
    let Some((_, point)) = goal.usual else {
        return "cannot".into();
    };
    match cost {
        Cost::Evaluations => format!("n {}", point.n),
        Cost::Operations => format!("n {}, {} op.", point.n, point.counts.operations()),
        Cost::Modelled | Cost::Measured => format!("n {}, {}", point.n, time_of(point, cost)),
    }
}

/// "10^(−k)" as people type it.
pub(super) fn goal(goal: &Goal<'_>) -> String {
    format!("1e-{}", goal.digits)
}

/// Runs of goals that are reached in the same way, with the same one usual: the first and the last of each.
pub(super) fn runs<'g, 'r>(goals: &'g [Goal<'r>]) -> Vec<(&'g Goal<'r>, &'g Goal<'r>)> {
    let same = |a: Option<(&Unit, &Point)>, b: Option<(&Unit, &Point)>| match (a, b) {
        (Some((_, a)), Some((_, b))) => std::ptr::eq(a, b),
        (a, b) => a.is_none() && b.is_none(),
    };
    let chunks = goals.chunk_by(|a, b| same(a.best, b.best) && same(a.usual, b.usual));
    let ends = chunks.filter_map(|chunk| chunk.first().zip(chunk.last()));
    ends.filter(|(first, _)| first.best.is_some()).collect()
}

/// "1e-2", or "1e-11 … 1e-14" for a run of goals.
pub(super) fn range((first, last): (&Goal<'_>, &Goal<'_>)) -> String {
    if first.digits == last.digits {
        return goal(first);
    }
    format!("{} … {}", goal(first), goal(last))
}

/// Goals that nothing reaches, in one line.
pub(super) fn unreached(goals: &[Goal<'_>]) -> Option<String> {
    let first = goals.iter().find(|goal| goal.best.is_none())?;
    Some(format!(
        "nothing that was run reaches {}",
        self::goal(first)
    ))
}

/// What the errors of a case are relative to.
pub(super) fn relative(case: &CaseResults) -> String {
    if case.is_relative() {
        format!(
            "errors relative to |I| = {:.6}",
            case.radiance.to_f64().abs()
        )
    } else {
        "errors absolute, as I = 0".into()
    }
}

/// "108 runs: 102 with an error, 6 refused".
pub(super) fn states(case: &CaseResults) -> String {
    let total = case.points().count();
    let errors = case.points();
    let errors = errors.filter(|(_, point)| matches!(point.outcome, Outcome::Error { .. }));
    let errors = match errors.count() {
        0 => None,
        some => Some(format!("{some} with an error")),
    };
    let parts: Vec<String> = errors.into_iter().chain(no_errors(case)).collect();
    format!("{total} runs: {}", parts.join(", "))
}

/// Runs whose error has no logarithm: "6 refused".
pub(super) fn no_errors(case: &CaseResults) -> Vec<String> {
    let words = [
        ("exact", "exact"),
        ("not-finite", "not finite"),
        ("refused", "refused"),
    ];
    let counted = words.map(|(state, words)| {
        let of = |(_, point): &(&Unit, &Point)| point.outcome.name() == state;
        (case.points().filter(of).count(), words)
    });
    let some = counted.into_iter().filter(|(count, _)| *count > 0);
    some.map(|(count, words)| format!("{count} {words}"))
        .collect()
}

/// How far the model's time can be believed; nothing where nothing was timed.
pub(super) fn model(results: &Results) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(pinned) = results.pinned {
        let core = if pinned {
            "pinned to one core"
        } else {
            "not pinned to a core"
        };
        lines.push(format!(
            "Measured: {}, {core}; the median of repeats.",
            clock_name()
        ));
    }
    let agreed: Vec<String> = agreement(results)
        .iter()
        .filter_map(|agreement| {
            let share = 100.0 * agreement.share()?;
            let format = agreement.format.as_deref().unwrap_or("all");
            Some(format!("{format} {share:.0} % of {}", agreement.points))
        })
        .collect();
    if !agreed.is_empty() {
        lines.push(format!(
            "Modelled time within 1.5 times of measured: {}.",
            agreed.join(", ")
        ));
    }
    lines
}

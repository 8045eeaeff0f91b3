//! The words that the reports of a verification share.

use super::empty::NONE;
use super::scattered;
use crate::document::{Finding, Tone};
use crate::kernel::Quantity;
use crate::method::Expected;
use crate::study::verify::{
    Axis, Beyond, Conclusion, Counts, Line, MISSING, Measured, Standing, Steps, TakesOver,
    Verification,
};
use std::collections::BTreeMap;

/// What the signs in front of rows mean.
pub(super) const SIGNS: &str = "✓ confirmed, ✗ contradicted, ? inconclusive, · blind, ! failed";
/// What blind is.
pub(super) const BLIND: &str = "blind: the case hides the leading error of what was declared";

/// Errors as high as their logarithms, the largest first.
const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// "2", "exact", "blind"; "-" where nothing is promised.
pub(super) fn theory(expected: Option<Expected>) -> String {
    match expected {
        Some(Expected::Order(order)) => short(order),
        Some(Expected::Exact) => "exact".into(),
        Some(Expected::Blind { .. }) => "blind".into(),
        Some(Expected::Unknown) | None => NONE.into(),
    }
}

/// "2", "1.5", "1.333": in the room of a column, whatever a kernel claims.
fn short(order: f64) -> String {
    if (0.001..1e5).contains(&order) {
        format!("{}", (order * 1000.0).round() / 1000.0)
    } else {
        format!("{order:.0e}")
    }
}

/// "1.003 ± 0.021", of random numbers both parts, the larger first; nothing without a window.
pub(super) fn order(line: &Line) -> String {
    if let Measured::Scattered(fit) = &line.measured {
        return scattered::both(fit);
    }
    let order = line.measured.order();
    order.map_or(NONE.into(), |(order, half_width)| {
        format!("{order:.3} ± {:.3}", up(half_width))
    })
}

/// Rounded up to three decimals: no interval becomes a point.
fn up(half_width: f64) -> f64 {
    (half_width * 1000.0).ceil() / 1000.0
}

/// The levels of the window: "64…512", or which of the levels they are where n is not the same thing: "#3…#8".
pub(super) fn window(line: &Line) -> String {
    let Measured::Fitted { fit, samples } = &line.measured else {
        return NONE.into();
    };
    let level = |index: usize| {
        let sample = samples.get(index)?;
        Some(match sample.n {
            Some(n) => n.to_string(),
            None => format!("#{}", index + 1),
        })
    };
    let ends = fit
        .window
        .and_then(|window| level(window.first).zip(level(window.last)));
    ends.map_or(NONE.into(), |(first, last)| format!("{first}…{last}"))
}

/// The floor's magnitude: "2e-16".
pub(super) fn floor(line: &Line) -> String {
    match &line.measured {
        Measured::Fitted { fit, .. } if !fit.floor.is_zero() => {
            format!("{:.0e}", fit.floor.to_f64())
        }
        _ => NONE.into(),
    }
}

/// The largest error of all levels, as a part of the radiance: "2e-3".
pub(super) fn largest(line: &Line) -> String {
    let largest = line.largest_error().filter(|error| !error.is_nan());
    largest.map_or(NONE.into(), |largest| format!("{largest:.0e}"))
}

/// Channels on which no method of the order shows it: all in one place.
pub(super) fn unresolved(verification: &Verification) -> Vec<Finding> {
    let lines = verification.lines.iter();
    // Others are counted in their own place.
    let first = verification.quantities().first().copied();
    let lines =
        lines.filter(|line| line.standing == Standing::Unresolved && Some(line.quantity) == first);
    let (unknown, known): (Vec<&Line>, Vec<&Line>) =
        lines.partition(|line| line.expected == Some(Expected::Unknown));
    let by = if verification.is_of_method() {
        "the declared method itself does not show its order on these levels"
    } else {
        "no method of that order shows it on these levels"
    };
    let groups = [(known, by), (unknown, "theory promises no order there")];
    let said = |(lines, why): (Vec<&Line>, &str)| {
        let names: Vec<&str> = lines.iter().map(|line| line.name.as_str()).collect();
        (!names.is_empty()).then(|| {
            let said = format!("{} ({why})", names.join(", "));
            Finding::new("not resolved", said)
        })
    };
    groups.into_iter().filter_map(said).collect()
}

/// Orders that should have been shown.
fn missing(verification: &Verification) -> String {
    let missing = verification.missing();
    if missing <= MISSING {
        return String::new();
    }
    let first = verification.quantities().first().copied();
    let of_first = verification
        .lines
        .iter()
        .filter(|line| Some(line.quantity) == first);
    let required = of_first.filter(|line| line.is_required);
    let by = if verification.is_of_method() {
        "the declared method shows its order"
    } else {
        "every method of that order shows it"
    };
    format!(
        " (not confirmed on {missing} of {} channels where {by}; allowed: {MISSING})",
        required.count()
    )
}

/// The errors of all levels, one bar each: the logarithm of the largest is the highest.
pub(super) fn bars(line: &Line) -> String {
    let sizes: Vec<f64> = match &line.measured {
        Measured::Fitted { samples, .. } => samples
            .iter()
            .map(|sample| sample.error.to_f64().abs())
            .collect(),
        Measured::Scattered(fit) => scattered::sizes(fit),
        Measured::Nothing => Vec::new(),
    };
    let drawn = |size: f64| size.is_finite() && size > 0.0;
    let logarithms = || {
        sizes
            .iter()
            .filter(|size| drawn(**size))
            .map(|size| size.ln())
    };
    let high = logarithms().fold(f64::NEG_INFINITY, f64::max);
    let low = logarithms().fold(f64::INFINITY, f64::min);
    let bar = |size: &f64| {
        if !drawn(*size) {
            return ' ';
        }
        let part = if high > low {
            (size.ln() - low) / (high - low)
        } else {
            1.0
        };
        // Between 0 and 7.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let index = (part * 7.0).round() as usize;
        BARS.get(index).copied().unwrap_or(' ')
    };
    sizes.iter().map(bar).collect()
}

/// The levels without an answer, and why: levels of which the same is to be said stand together.
pub(super) fn failures(line: &Line) -> Vec<(Vec<u64>, String)> {
    let mut groups: Vec<(Vec<u64>, String)> = Vec::new();
    for failure in &line.failures {
        let why = failure.error.to_string();
        match groups.last_mut() {
            Some((levels, last)) if *last == why => levels.push(failure.segments),
            _ => groups.push((vec![failure.segments], why)),
        }
    }
    groups
}

/// "n = 8, 16: no answer in 1 s".
pub(super) fn failure((levels, why): &(Vec<u64>, String)) -> String {
    let levels: Vec<String> = levels.iter().map(ToString::to_string).collect();
    format!("n = {}: {why}", levels.join(", "))
}

/// One sign for what a channel says.
pub(super) fn sign(standing: Standing) -> &'static str {
    match standing {
        Standing::Confirmed => "✓",
        Standing::Contradicted => "✗",
        Standing::Inconclusive => "?",
        Standing::Unresolved => "–",
        Standing::Blind => "·",
        Standing::Failed => "!",
    }
}

/// "41 confirmed, 0 contradicted, 1 inconclusive, 8 not resolved, 8 blind of 58 channels".
pub(super) fn counts(counts: Counts, of: usize) -> String {
    let if_any = |count: usize, what: &str| match count {
        0 => String::new(),
        count => format!(", {count} {what}"),
    };
    format!(
        "{} confirmed, {} contradicted, {} inconclusive{}, {} blind{} of {of} channels",
        counts.confirmed,
        counts.contradicted,
        counts.inconclusive,
        if_any(counts.unresolved, "not resolved"),
        counts.blind,
        if_any(counts.failed, "failed")
    )
}

/// Values that are not those of the declared method.
pub(super) fn not_declared(verification: &Verification) -> Option<Finding> {
    let (agree, of) = verification
        .as_declared()
        .filter(|(agree, of)| agree < of)?;
    let method = verification.declaration.method?;
    let words = format!("{method} gives these values in {agree} of {of} channels only");
    Some(Finding::new("that is not what it declares", words).toned(Tone::Bad))
}

/// What was found, with its channels, or with the number of these where there are more than so many; what speaks against the
/// kernel is wrong.
pub(super) fn findings(verification: &Verification, most: usize) -> Vec<Finding> {
    let findings = verification.findings.iter().map(|found| {
        let (label, tone) = if found.wrong {
            ("wrong", Tone::Bad)
        } else {
            ("found", Tone::Open)
        };
        let channels = match &found.channels[..] {
            [] => NONE.into(),
            channels if channels.len() > most => format!("{} channels", channels.len()),
            channels => channels.join(", "),
        };
        Finding::new(label, format!("{} ({channels})", found.words)).toned(tone)
    });
    findings.collect()
}

/// Where something else takes over from discretization of a high order: finer levels do not show it.
pub(super) fn beyond(verification: &Verification, most: usize) -> Vec<Finding> {
    let mut places: BTreeMap<Beyond, Vec<&str>> = BTreeMap::new();
    for line in &verification.lines {
        if let Some(beyond) = line.beyond() {
            places.entry(beyond).or_default().push(&line.name);
        }
    }
    let said = places.into_iter().map(|(Beyond { n, by }, names)| {
        let (label, takes_over) = match by {
            TakesOver::Rounding => ("rounding", "rounding takes over"),
            TakesOver::Other => (
                "levels off",
                "more than rounding stays (a series, a table, a short constant)",
            ),
        };
        let names = if names.len() > most {
            format!("{} channels", names.len())
        } else {
            names.join(", ")
        };
        Finding::new(label, format!("finer than n = {n} {takes_over} in {names}"))
    });
    said.collect()
}

/// Why a verification is not confirmed, or what makes it so.
pub(super) fn conclusion(verification: &Verification) -> String {
    let quantities = verification.quantities();
    let first = quantities.first().copied().unwrap_or(Quantity::Radiance);
    let counts = verification.counts_of(first);
    let mut all = self::counts(counts, verification.of(first).count());
    if first != Quantity::Radiance {
        all = format!("{first} {}", all.replace("channels", "cases"));
    }
    all.extend(quantities.into_iter().skip(1).map(|quantity| {
        let others = verification.counts_of(quantity);
        let (confirmed, wrong) = (others.confirmed, others.contradicted + others.failed);
        let of = verification.of(quantity).count();
        format!("; {quantity} {confirmed} confirmed, {wrong} contradicted of {of} cases")
    }));
    match verification.conclusion() {
        Conclusion::Confirmed if counts.confirmed == 0 => format!(
            "confirmed: answers are right to one quantum, and no order shows through it: {all}"
        ),
        Conclusion::Confirmed => format!("confirmed: {all}"),
        Conclusion::CouldNotRun => {
            format!("could not run: no level of any case was answered; {all}")
        }
        Conclusion::NotConfirmed => {
            let nothing_expected = verification
                .lines
                .iter()
                .all(|line| line.expected.is_none());
            let why = if nothing_expected {
                " (nothing was promised: --expect ORDER, or let the kernel declare a method)"
            } else {
                ""
            };
            format!("not confirmed: {all}{why}{}", missing(verification))
        }
    }
}

/// What was refined, and how.
pub(super) fn axis(verification: &Verification) -> String {
    let settings = &verification.settings;
    let ladder = match (settings.ladder.first(), settings.ladder.last()) {
        (Some(first), Some(last)) => format!("{first}…{last}"),
        _ => NONE.into(),
    };
    match settings.axis {
        Axis::Step => match settings.steps {
            Steps::PartLast => format!("n = {ladder}, the last segment ³⁄₁₀ of the others"),
            Steps::Divide => format!("n = {ladder}, d = D/n"),
            Steps::Uneven => format!("n = {ladder}, d = ⅞ D/n divides no ray"),
            Steps::Spaced(spacing) => format!("n = {ladder}, ends of segments {spacing}"),
        },
        Axis::Grid => format!("cells of the grid = {ladder}"),
    }
}

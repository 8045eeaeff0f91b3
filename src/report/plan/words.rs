//! What a plan says of itself, in words.

use crate::study::plan::{Because, Model, Plan, Step, StoredPlan};

/// A place of the ray as a person would write it.
pub(super) fn place(exact: &str) -> String {
    let value = crate::symbolic::parse_number(exact);
    value.map_or_else(|_| exact.to_string(), |q| short(q.to_f64()))
}

/// Up to 6 significant digits.
pub(super) fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    let plain = rounded.to_string();
    if plain.len() <= 9 {
        plain
    } else {
        format!("{rounded:e}")
    }
}

/// A bound: 0, or two digits rounded up.
pub(super) fn bound(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    // Half a unit of the second digit more, so that what is printed is no less than what it stands for.
    let exponent = x.abs().log10().floor();
    let unit = 10_f64.powf(exponent - 1.0);
    let up = (x / unit).ceil() * unit;
    format!("{up:.1e}")
}

/// The name of a medium, with what the file calls it.
pub(super) fn medium(plan: &Plan, step: &Step) -> String {
    let media = plan.scene().media();
    let medium = step.medium.checked_sub(1).and_then(|i| media.get(i));
    medium.map_or_else(|| step.medium.to_string(), |medium| medium.name.clone())
}

/// Why the model is enough: the arithmetic, and below it where more is counted.
pub(super) fn because(step: &Step) -> String {
    let Because {
        front,
        radiance,
        transmittance,
        behind,
        ..
    } = step.because;
    let error = step.because.error();
    let sum = format!(
        "{} x ({} + {} x {}) = {}",
        short(front),
        bound(radiance),
        bound(transmittance),
        short(behind),
        bound(error)
    );
    if step.bound > error {
        format!(
            "{sum},\ncounted as {}: more points err by that",
            bound(step.bound)
        )
    } else {
        sum
    }
}

/// What is known of a vacuum needs no bound.
pub(super) fn left_out(step: &Step) -> &'static str {
    match step.model {
        Model::Nothing if step.bound == 0.0 => "nothing: it is empty, or no light is behind it",
        model => model.omission(),
    }
}

/// The parts of the error, and the tolerance.
pub(super) fn sum(stored: &StoredPlan) -> String {
    let parts = &stored.uncertainty;
    format!(
        "{} (models) + {} (reference) + {} (rounding in {}) = {} <= {}",
        bound(parts.models),
        bound(parts.reference),
        bound(parts.rounding),
        stored.format,
        bound(parts.total()),
        short(stored.tolerance)
    )
}

/// How many evaluations in how many steps.
pub(super) fn effort(stored: &StoredPlan) -> String {
    let steps = stored.steps.len();
    let plural = |count: u64, one: &str| {
        if count == 1 {
            format!("1 {one}")
        } else {
            format!("{count} {one}s")
        }
    };
    format!(
        "{} of C and tau in {}",
        plural(stored.evaluations, "evaluation"),
        plural(steps as u64, "step")
    )
}

/// A number of no more digits than another is told with, its exponent kept.
pub(super) fn shortened(number: &str, like: &str) -> String {
    let (digits, exponent) = match number.split_once('e') {
        Some((digits, exponent)) => (digits, format!("e{exponent}")),
        None => (number, String::new()),
    };
    let most = like.chars().count() + 2;
    if digits.chars().count() <= most {
        return number.to_string();
    }
    let kept: String = digits.chars().take(most).collect();
    format!("{kept}...{exponent}")
}

//! Many rays in one request, in words.

use super::empty::NONE;
use crate::document::{Finding, Tone};
use crate::identify::{Apart, Together};
use crate::kernel::{KernelError, Quantity, Rendering};
use crate::study::verify::{Acceptance, Verification};

/// Whether they have the answers that they have alone, and if not, why and where.
pub(super) fn said(verification: &Verification) -> Option<Finding> {
    let found = verification.together.as_ref()?;
    let name = found.deviation.as_ref().map(|deviation| deviation.name);
    let words = words(found);
    let tone = match verification.acceptance_of_batch() {
        None => Tone::Good,
        Some(Acceptance::Accepted) => Tone::Open,
        Some(_) => Tone::Bad,
    };
    let words = match tone {
        Tone::Open => format!("{words}; this is accepted"),
        _ => words,
    };
    let label = match (name, found.differ) {
        (Some(name), _) => name,
        (None, 0) => "alone or together",
        (None, _) => "other answers",
    };
    Some(Finding::new(label, words).toned(tone))
}

fn words(found: &Together) -> String {
    let (least, most) = found.segments;
    let rays = format!("{} rays of {least} to {most} segments", found.rays);
    let Some(first) = &found.first else {
        return format!("{rays} have the same answers, to the bit");
    };
    let why = found
        .deviation
        .as_ref()
        .map_or(String::new(), |deviation| format!("{}; ", deviation.does));
    let Apart {
        ray,
        segments,
        step,
        ..
    } = first;
    let (alone, among) = answers(first);
    format!(
        "{why}{} of {rays} differ, the first ray {ray} (n = {segments}, d = {step}): alone {alone}, among the others {among}",
        found.differ
    )
}

/// Both answers, by the first number in which they differ.
fn answers(apart: &Apart) -> (String, String) {
    let shown = |rendering: &Rendering, quantity: Quantity, channel: usize| {
        let value = rendering.of(quantity, channel);
        value.map_or(NONE.into(), |value| {
            format!("{quantity} {:?}", value.to_f64())
        })
    };
    let (one, other) = match (&apart.alone, &apart.together) {
        (Ok(one), Ok(other)) => (one, other),
        (one, other) => return (whole(one), whole(other)),
    };
    let channels = one.radiance.len().max(other.radiance.len()).max(1);
    for quantity in Quantity::ALL {
        for channel in 0..channels {
            let both = (
                shown(one, quantity, channel),
                shown(other, quantity, channel),
            );
            if both.0 != both.1 {
                return both;
            }
        }
    }
    let used = |rendering: &Rendering| {
        let step = rendering.step.map_or(NONE.into(), |step| step.to_string());
        let segments = rendering.segments.map_or(NONE.into(), |n| n.to_string());
        format!("a step of {step} and {segments} segments used, or another standard error")
    };
    (used(one), used(other))
}

fn whole(answer: &Result<Rendering, KernelError>) -> String {
    match answer {
        Ok(_) => "an answer".into(),
        Err(error) => format!("none ({error})"),
    }
}

//! What else a rule does, a line for each.

use super::{Line, curved, formula, number, words};
use crate::identify::rule::{
    Channels, End, Extra, LastStep, Output, Place, Rule, Scheme, Sequence, Stop, StopBy, Wall,
};

/// All of it.
pub(super) fn of(rule: &Rule) -> Vec<Line> {
    let place = match rule.scheme {
        Scheme::Sample { place, .. } => Some(place),
        Scheme::Segments { .. } => None,
    };
    let mut all = of_sequence(&rule.sequence, place);
    all.extend(rule.stop.into_iter().flat_map(of_stop));
    all.extend(rule.wall.map(|wall| {
        words(match wall {
            Wall::Opaque => "the last segment is opaque where it absorbs anything".into(),
            Wall::LastEmission => "the last emission shines behind the ray".into(),
            Wall::Length(length) => {
                format!("the last segment counts as {} long", number(length))
            }
        })
    }));
    all.extend(of_emission(rule));
    all.extend(of_output(&rule.output));
    match rule.channels {
        Channels::Straight => {}
        Channels::ReversedByThrees => all.push(words(
            "the first and the last of every three channels have changed places",
        )),
        Channels::Reversed => all.push(words("answers stand in the reversed order of channels")),
    }
    all
}

fn of_sequence(sequence: &Sequence, place: Option<Place>) -> Vec<Line> {
    let mut all = Vec::new();
    for (end, name) in [(sequence.first, "first"), (sequence.last, "last")] {
        match end {
            End::Once => {}
            End::Missing => all.push(words(format!("the {name} sample is missing"))),
            End::Twice => all.push(words(format!("the {name} sample counts twice"))),
        }
    }
    let at = match place {
        Some(Place::Front) => Some("the far end of the ray"),
        Some(Place::Back) => Some("the near end of the ray"),
        // There is no middle beyond the ends.
        Some(Place::Middle) | None => None,
    };
    if let (Some(extra), Some(at)) = (sequence.extra, at) {
        let length = match extra {
            Extra::Step => "the step",
            Extra::Last => "the last segment",
        };
        all.push(words(format!(
            "one sample more lies at {at}, for a segment as long as {length}"
        )));
    }
    if sequence.swapped {
        all.push(words("the back of the ray is taken for its front"));
    }
    if sequence.late {
        all.push(words(
            "the transmittance in front of a sample is that of the one before",
        ));
    }
    if sequence.unrolled > 1 {
        all.push(words(format!(
            "samples come in groups of {}, and what is left over is missing",
            sequence.unrolled
        )));
    }
    all.extend(
        sequence
            .most
            .map(|most| words(format!("no more than {most} samples are taken"))),
    );
    match sequence.last_step {
        LastStep::Own => {}
        LastStep::Whole => all.push(words("a shorter last segment counts as a whole one")),
        LastStep::Dropped => all.push(words("a shorter last segment is left out")),
        LastStep::Even => all.push(formula("dⱼ = D/n")),
    }
    all.extend(sequence.seam.map(|seam| words(seam.words())));
    all
}

fn of_stop(stop: Stop) -> Vec<Line> {
    let what = match stop.by {
        StopBy::Transmittance => "the transmittance behind a sample",
        StopBy::Weight => "the weight of a sample",
        StopBy::Sum => "what samples weigh by themselves",
    };
    let under = number(stop.under);
    let what = match stop.by {
        StopBy::Sum => format!("the ray ends where {what} sums to {under} or more"),
        StopBy::Transmittance | StopBy::Weight => {
            format!("the ray ends where {what} is under {under}")
        }
    };
    let mut all = vec![words(if stop.before {
        format!("{what}, without that sample")
    } else {
        what
    })];
    if stop.cut && !stop.before {
        let what = match stop.by {
            StopBy::Sum => "the sum",
            StopBy::Transmittance | StopBy::Weight => "the transmittance",
        };
        all.push(words(format!(
            "that sample takes {what} to {under} only, and weighs as much less"
        )));
    }
    if stop.renormalised {
        all.push(words(
            "the radiance of a ray that ended is divided by the opacity reached",
        ));
    }
    all
}

fn of_emission(rule: &Rule) -> Vec<Line> {
    let mut all = Vec::new();
    all.extend(rule.emission_max.map(|most| {
        let most = number(most);
        words(format!("an emission above {most} counts as {most}"))
    }));
    all.extend(rule.emission_min.map(|least| {
        let least = number(least);
        words(format!("an emission under {least} counts as {least}"))
    }));
    all.extend(curved(rule.emission, "C").map(|curve| formula(format!("Cⱼ = {curve}"))));
    all
}

fn of_output(output: &Output) -> Vec<Line> {
    let mut all = Vec::new();
    all.extend(curved(output.curve, "I").map(|curve| formula(format!("the answer = {curve}"))));
    match (output.low, output.high) {
        (Some(low), Some(high)) => all.push(words(format!(
            "answers are clipped to {} to {}",
            number(low),
            number(high)
        ))),
        (Some(low), None) => all.push(words(format!("answers are at least {}", number(low)))),
        (None, Some(high)) => all.push(words(format!("answers are at most {}", number(high)))),
        (None, None) => {}
    }
    all.extend(output.quantum.map(|quantum| {
        words(format!(
            "answers are rounded to multiples of {}",
            number(quantum)
        ))
    }));
    all
}

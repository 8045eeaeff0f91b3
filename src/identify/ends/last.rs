//! A last segment that is shorter than the others.

use crate::identify::NotIdentified;
use crate::identify::influence::layers_at;
use crate::identify::ray::Emission;
use crate::identify::rule::{Extra, LastStep, Rule, Scheme};
use crate::identify::session::Session;
use crate::identify::weights::{Answers, impulse, nodes_of};
use crate::real::Native;

/// The last segment by the others.
const PART: f64 = 0.3;
/// Segments, a multiple of what loops are unrolled by.
const SEGMENTS: usize = 9;
/// How many longer rays may be tried.
const LONGER: usize = 16;

/// The rule with what a shorter last segment counts as; `None` where no reading explains it.
pub(in crate::identify) fn last_step(
    session: &mut Session<'_>,
    answers: &Answers,
    rule: &Rule,
    extinction: f64,
) -> Result<Option<Rule>, NotIdentified> {
    let Scheme::Sample { place, .. } = rule.scheme else {
        return Ok(None);
    };
    if session.divides {
        return Ok(Some(rule.clone()));
    }
    let unrolled = usize::try_from(rule.sequence.unrolled).unwrap_or(1).max(1);
    let least = SEGMENTS
        .next_multiple_of(unrolled)
        .next_multiple_of(session.multiple);
    // A ray whose last segment is sampled.
    let lengths = (0..LONGER).map(|k| least + k * unrolled * session.multiple);
    let takes_the_last = |n: &usize| {
        let seam = rule.sequence.seam;
        seam.is_none_or(|seam| seam.times(n - 1, *n) > 0)
    };
    let n = lengths.into_iter().find(takes_the_last).unwrap_or(least);
    let taus = vec![extinction; n];
    let mut layers = layers_at(place, 0.25, &taus, &taus);
    layers.last = PART;
    let nodes = nodes_of(place, n, rule.sequence.extra.is_some());
    let size = answers.emission_max.min(1.0);
    let size = size.min(answers.output.high.map_or(1.0, |high| high / 8.0));
    let mut emission = vec![Emission::even(n, 0.0)];
    emission.extend(nodes.iter().map(|node| impulse(n, *node, size)));
    let ray = session.ray(&layers, &emission);
    let y = session.ask(&ray)?;
    let mut found = Vec::new();
    for extra in [Extra::Step, Extra::Last] {
        for last_step in [
            LastStep::Own,
            LastStep::Whole,
            LastStep::Dropped,
            LastStep::Even,
        ] {
            let mut trial = rule.clone();
            trial.sequence.last_step = last_step;
            if let Some(kind) = &mut trial.sequence.extra {
                *kind = extra;
            } else if extra == Extra::Last {
                continue;
            }
            // Channels were put in order when they were asked.
            let straight = Rule {
                channels: crate::identify::rule::Channels::Straight,
                ..trial.clone()
            };
            let want = straight.answers(&ray.segments, ray.step, Native::<f64>::new());
            let fits = y.iter().zip(&want).all(|(y, want)| {
                let (got, model) = (answers.radiance(*y), answers.radiance(*want));
                let part = answers.relative(n) * 16.0 + answers.grain * n as f64;
                let slack = part * model.value.abs();
                (got.value - model.value).abs() <= 4.0 * (got.error + model.error) + slack + 1e-15
            });
            if fits {
                found.push(trial);
            }
        }
    }
    Ok(found.into_iter().next())
}

//! Answers without emission.

use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::ray::{Emission, Layers};
use crate::identify::rule::Rule;
use crate::identify::session::Session;
use crate::identify::weights::Answers;

/// What is added.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::identify) struct Behind {
    /// Seen through the ray.
    pub(in crate::identify) background: f64,
    pub(in crate::identify) of_background: (f64, f64),
    /// Whatever the ray.
    pub(in crate::identify) offset: f64,
    pub(in crate::identify) of_offset: (f64, f64),
}

/// Segments.
const SEGMENTS: usize = 8;

/// What lets so much more through than another that what shines behind it shows.
const APART: f64 = 0.5;

/// Whether media that were asked before are dark, and let so different parts through that nothing shines behind a ray.
fn are_dark(answers: &Answers, rule: &Rule, known: &[&(Layers, f64)]) -> bool {
    let mut through = Vec::new();
    for (layers, y) in known {
        let none = Emission::even(layers.count(), 0.0);
        let ray = layers.ray(String::new(), &[none]);
        let composed = rule.composed(&ray.segments, ray.step, crate::real::Native::<f64>::new());
        let y = answers.radiance(*y);
        if y.value.abs() > 3.0 * y.error + 1e-14 {
            return false;
        }
        through.push(composed.passes);
    }
    let (low, high) = through
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
            (low.min(*p), high.max(*p))
        });
    high - low > APART
}

/// Answers behind next to nothing, something, much; fewer where those `known` tell that there is nothing.
pub(in crate::identify) fn behind(
    session: &mut Session<'_>,
    answers: &Answers,
    reference: f64,
    rule: &Rule,
    has_vacuum: bool,
    known: &[&(Layers, f64)],
) -> Result<Behind, NotIdentified> {
    if session.is_short() && are_dark(answers, rule, known) {
        return Ok(Behind::default());
    }
    let unrolled = usize::try_from(rule.sequence.unrolled).unwrap_or(1).max(1);
    let n = SEGMENTS
        .next_multiple_of(unrolled)
        .next_multiple_of(session.multiple);
    let length = 0.25;
    let mut rows: Vec<(f64, f64, f64)> = Vec::new();
    // Before a wall only what holds nothing lets anything through.
    let least = if has_vacuum { 0.0 } else { 1e-9 * reference };
    let all = [least, 400.0 * reference, 8.0 * reference];
    for tau in all {
        // Two tell that there is nothing.
        let is_dark = rows.iter().all(|(_, y, e)| y.abs() <= 3.0 * e + 1e-14);
        if session.is_short() && rows.len() == 2 && is_dark {
            break;
        }
        let taus = vec![tau; n];
        let layers = Layers::of(length, &taus);
        let ray = session.ray(&layers, &[Emission::even(n, 0.0)]);
        let y = session.ask_any(&ray)?;
        if !y[0].is_finite() {
            // 0/0, where the ray's opacity divides.
            continue;
        }
        let composed = rule.composed(&ray.segments, ray.step, crate::real::Native::<f64>::new());
        let y = answers.radiance(y[0]);
        rows.push((composed.passes, y.value, y.error));
    }
    let most = rows.iter().map(|(_, y, _)| y.abs()).fold(0.0, f64::max);
    let slack = rows.iter().map(|(.., e)| *e).fold(0.0, f64::max) * 3.0 + 1e-14;
    if most <= slack {
        return Ok(Behind::default());
    }
    let failed = || {
        let rows = rows.iter().map(|(p, y, e)| vec![*p, *y, *e]).collect();
        NotIdentified::new("answers without emission are no background and no constant")
            .with_rows(&["let through", "answer", "error"], rows)
    };
    // y = offset + background p, by those that let the most and the least through.
    let by_passes = |u: &&(f64, f64, f64), v: &&(f64, f64, f64)| u.0.total_cmp(&v.0);
    let ends = (rows.iter().max_by(by_passes), rows.iter().min_by(by_passes));
    let (Some(&first), Some(&last)) = ends else {
        return Err(failed());
    };
    if rows.len() < 3 {
        return Err(failed());
    }
    if (first.0 - last.0).abs() < 1e-9 {
        // Nothing absorbs: behind or in front, no probe can tell.
        let same = rows.iter().all(|(_, y, _)| (y - first.1).abs() <= slack);
        return if same {
            let bracket = (first.1 - slack, first.1 + slack);
            Ok(Behind {
                offset: simplest(bracket.0, bracket.1),
                of_offset: bracket,
                ..Behind::default()
            })
        } else {
            Err(failed())
        };
    }
    let background = (first.1 - last.1) / (first.0 - last.0);
    let offset = first.1 - background * first.0;
    let fits = |(p, y, _): &(f64, f64, f64)| {
        (offset + background * p - y).abs() <= 4.0 * slack + 64.0 * answers.unit * y.abs()
    };
    if !rows.iter().all(fits) {
        return Err(failed());
    }
    let slack = 2.0 * slack + 8.0 * answers.unit * most;
    let of = |value: f64| {
        let bracket = (value - slack, value + slack);
        if value.abs() <= slack {
            (0.0, bracket)
        } else {
            (simplest(bracket.0, bracket.1), bracket)
        }
    };
    let (background, of_background) = of(background);
    let (offset, of_offset) = of(offset);
    Ok(Behind {
        background,
        of_background,
        offset,
        of_offset,
    })
}

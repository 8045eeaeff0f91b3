//! Segments thinner and thicker than those that a rule was read off: functions of the depth that are others there.
//!
//! Emission that is the same everywhere in a segment of depth x adds 1 − e^(−x), to a unit of 1 even where its parts
//! lose 1/x of their digits. A series that takes over below some depth shows by the terms that it lacks.

use super::NotIdentified;
use super::ray::{Emission, Layers};
use super::rule::{End, Rule};
use super::session::Session;
use super::weights::Answers;
use crate::real::Native;

/// Depths of segments, by powers of ten.
const POWERS: (i32, i32) = (-8, 1);
/// Depths in a decade; and where there are few rays.
const PER_DECADE: i32 = 4;
const FEW: i32 = 1;
/// Rays by which the border between two depths is found.
const HALVINGS: usize = 12;
/// Units of 1 that rounding leaves of one segment.
const UNITS: f64 = 16.0;
/// Depths that are shown.
const SHOWN: usize = 4;

/// One ray of even segments.
#[derive(Clone, Copy)]
struct Seen {
    depth: f64,
    got: f64,
    want: f64,
    differs: bool,
}

/// Where the rule does not hold, if anywhere.
pub(super) fn other_depths(
    session: &mut Session<'_>,
    rule: &Rule,
    answers: &Answers,
) -> Result<Option<NotIdentified>, NotIdentified> {
    let per_decade = if session.is_short() { FEW } else { PER_DECADE };
    let (low, high) = POWERS;
    let mut all = Vec::new();
    for place in low * per_decade..=high * per_decade {
        let depth = 10_f64.powf(f64::from(place) / f64::from(per_decade));
        all.push(one(session, rule, answers, depth)?);
    }
    let Some(top) = all.iter().rposition(|seen| seen.differs) else {
        return Ok(None);
    };
    let rows = all.iter().filter(|seen| seen.differs).rev().take(SHOWN);
    let rows = rows.map(|seen| vec![seen.depth, seen.got, seen.want]);
    let rows = rows.collect();
    let what = match all.get(top + 1) {
        None => "segments of some depths add other than the rule says".to_string(),
        Some(agrees) => {
            let (mut differs, mut agrees) = (all[top].depth, agrees.depth);
            for _ in 0..HALVINGS {
                let middle = (differs * agrees).sqrt();
                if one(session, rule, answers, middle)?.differs {
                    differs = middle;
                } else {
                    agrees = middle;
                }
            }
            format!(
                "segments of a depth of {differs:.3e} and less add other than the rule says, and of {agrees:.3e} as it says"
            )
        }
    };
    let columns = ["depth", "a segment of C = 1 adds", "by the rule"];
    Ok(Some(NotIdentified::new(&what).with_rows(&columns, rows)))
}

fn one(
    session: &mut Session<'_>,
    rule: &Rule,
    answers: &Answers,
    depth: f64,
) -> Result<Seen, NotIdentified> {
    let n = 1 + usize::from(rule.sequence.last == End::Missing);
    let n = n.next_multiple_of(session.multiple);
    let size = answers.emission_max.min(1.0);
    let size = size.min(answers.output.high.map_or(1.0, |high| high / 8.0));
    let layers = Layers::of(1.0, &vec![depth; n]);
    let ray = session.ray(&layers, &[Emission::even(n, size)]);
    let y = session.ask(&ray)?;
    let got = answers.radiance(y.first().copied().unwrap_or(f64::NAN));
    let format = Native::<f64>::new();
    let (segments, step) = rule.cut(&ray);
    let composed = rule.composed(&segments, step, format);
    let want = rule.radiance(&composed, &segments, 0, format);
    let allowed = UNITS * n as f64 * (answers.unit + answers.noise) * size.max(want.abs());
    let allowed = allowed + 2.0 * got.error;
    Ok(Seen {
        depth,
        got: got.value / size,
        want: want / size,
        differs: (got.value - want).abs() > allowed,
    })
}

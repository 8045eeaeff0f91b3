//! What is worth a remark beside a verdict.

use super::levels::Levels;
use super::regression::Asymptote;
use super::{Pair, changeover, parity};
use crate::convergence::Note;

/// A level this many times larger than the two before it stands alone.
const STEP_UP: f64 = 100.0;

/// Remarks on what an order, or its absence, does not show; `own_floor` is the level where errors were found to
/// stop falling.
pub(super) fn remarks(
    levels: &Levels<'_>,
    asymptote: Asymptote,
    pairs: &[Pair],
    own_floor: Option<usize>,
) -> Vec<Note> {
    let step = |level: usize| levels.samples.get(level).map_or(0.0, |s| s.step);
    let regression = asymptote.regression();
    let mut notes = Vec::new();
    let before = regression.and_then(|r| {
        let mut before = pairs.iter().rev().filter(|p| p.coarse < r.window.first);
        before.find(|p| p.sign_change)
    });
    notes.extend(before.map(|pair| Note::SignChange {
        level: pair.coarse,
        step: step(pair.coarse),
    }));
    match asymptote {
        Asymptote::Order(r) if r.logarithm => notes.push(Note::Logarithm),
        Asymptote::Slow(next) => notes.push(Note::SlowDrift { next }),
        Asymptote::Growing => notes.push(Note::GrowingDrift),
        Asymptote::Order(_) | Asymptote::Open => {}
    }
    notes.extend(gives_way(levels));
    notes.extend(two_sequences(levels));
    match own_floor {
        Some(level) => notes.push(Note::StopsFalling {
            level,
            step: step(level),
            log2_error: levels.points.get(level).map_or(0.0, |p| p.1),
        }),
        None => notes.extend(step_up(levels)),
    }
    notes.extend(levels.risen().map(|level| Note::RisesBeyondCut {
        level,
        step: step(level),
    }));
    notes
}

fn gives_way(levels: &Levels<'_>) -> Option<Note> {
    let usable = levels.points.iter().zip(levels.samples).take(levels.usable);
    let signed: Vec<changeover::Level> = usable
        .map(|((x, y), s)| (*x, *y, s.error.is_sign_negative()))
        .collect();
    let found = changeover::changeover(&signed)?;
    Some(Note::GivesWay {
        from: found.from,
        to: found.to,
        step: found.step,
    })
}

fn two_sequences(levels: &Levels<'_>) -> Option<Note> {
    let usable = levels.points.iter().zip(levels.samples).take(levels.usable);
    let numbered: Option<Vec<(u64, f64, f64)>> =
        usable.map(|((x, y), s)| Some((s.n?, *x, *y))).collect();
    let factor = parity::odd_over_even(&numbered?)?;
    Some(Note::TwoSequences { factor })
}

/// The first level that stands far above all of its neighbours on the coarse side.
fn step_up(levels: &Levels<'_>) -> Option<Note> {
    let heights: Vec<f64> = levels.points.iter().map(|p| p.1).collect();
    let far = STEP_UP.log2();
    let found = heights
        .windows(3)
        .position(|w| w[2].is_finite() && w[2] >= w[0].max(w[1]) + far && w[0].is_finite())?;
    let level = found + 2;
    let step = levels.samples.get(level)?.step;
    Some(Note::StepsUp { level, step })
}

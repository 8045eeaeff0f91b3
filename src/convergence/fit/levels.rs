//! A ladder's levels as a fit sees them: running floors, what stands above them, logarithms.

use super::{FLOOR_MARGIN, Pair, Sample, Window};
use crate::convergence::Note;
use crate::convergence::sample::log2_abs;
use crate::convergence::verdict::{Beyond, Trend};
use rug::Float;
use std::cmp::Ordering;
use std::f64::consts::LN_2;

/// The levels, coarse to fine, and what follows from each alone.
pub(super) struct Levels<'a> {
    pub(super) samples: &'a [Sample],
    /// Running maximum of the floors.
    pub(super) floors: Vec<Float>,
    pub(super) at_floor: Vec<bool>,
    /// (log₂ step, log₂|error|).
    pub(super) points: Vec<(f64, f64)>,
    /// Levels before the first that is at the floor or not finite.
    pub(super) usable: usize,
}

impl<'a> Levels<'a> {
    pub(super) fn new(samples: &'a [Sample]) -> Self {
        let floors = running_floors(samples);
        let at_floor: Vec<bool> = samples
            .iter()
            .zip(&floors)
            .map(|(s, floor)| is_at_floor(&s.error, floor))
            .collect();
        let usable = samples
            .iter()
            .zip(&at_floor)
            .take_while(|(s, at_floor)| s.error.is_finite() && !**at_floor)
            .count();
        let points = samples
            .iter()
            .map(|s| (s.step.log2(), log2_abs(&s.error)))
            .collect();
        Levels {
            samples,
            floors,
            at_floor,
            points,
            usable,
        }
    }

    /// Pairwise orders of all neighbours with finite, nonzero errors; no window is known yet.
    pub(super) fn pairs(&self) -> Vec<Pair> {
        let negative = |i: usize| self.samples[i].error.is_sign_negative();
        (1..self.samples.len())
            .map(|i| (i, self.points[i - 1].1, self.points[i].1))
            .filter(|(_, coarse, fine)| coarse.is_finite() && fine.is_finite())
            .map(|(i, coarse, fine)| Pair {
                coarse: i - 1,
                order: (coarse - fine) / self.log2_ratio(i),
                above_floor: i < self.usable,
                in_window: false,
                sign_change: negative(i - 1) != negative(i),
            })
            .collect()
    }

    /// log₂ of the ratio of a level's step to the one before; never 0, however close they are.
    pub(super) fn log2_ratio(&self, fine: usize) -> f64 {
        let (coarse, fine) = (self.samples[fine - 1].step, self.samples[fine].step);
        ((coarse - fine) / fine).ln_1p() / LN_2
    }

    /// The window of the finest `pairs` usable pairs.
    pub(super) fn window(&self, pairs: usize, tolerance: f64) -> Window {
        let last = self.usable - 1;
        let first = last - pairs;
        Window {
            first,
            last,
            coarsest_step: self.samples[first].step,
            finest_step: self.samples[last].step,
            coarsest_n: self.samples[first].n,
            finest_n: self.samples[last].n,
            tolerance,
        }
    }

    /// The level where the floor ends the ladder.
    pub(super) fn cut(&self) -> Option<usize> {
        (self.at_floor.get(self.usable) == Some(&true)).then_some(self.usable)
    }

    /// The first level beyond the cut that stands above the floor again.
    fn risen(&self) -> Option<usize> {
        let cut = self.cut()?;
        (cut..self.samples.len()).find(|i| !self.at_floor[*i])
    }

    /// What happens beyond the usable levels.
    pub(super) fn beyond(&self) -> Beyond {
        if self.cut().is_none() {
            return Beyond::Nothing;
        }
        if self.risen().is_none() {
            return Beyond::Floor;
        }
        let ends_above = self.at_floor.last() == Some(&false);
        let gap = self.points.iter().rposition(|p| !p.1.is_finite());
        let finest = &self.points[gap.map_or(0, |g| g + 1)..];
        if ends_above && Trend::of(finest) == Trend::Growing {
            Beyond::Growth
        } else {
            Beyond::Rise
        }
    }

    /// Remarks on what a window does not show.
    pub(super) fn notes(&self, window: Option<Window>, pairs: &[Pair]) -> Vec<Note> {
        let sign_change = window.and_then(|w| {
            let mut before = pairs.iter().rev().filter(|p| p.coarse < w.first);
            before.find(|p| p.sign_change)
        });
        let sign_change = sign_change.map(|pair| Note::SignChange {
            level: pair.coarse,
            step: self.samples[pair.coarse].step,
        });
        let rise = self.risen().map(|level| Note::RisesBeyondCut {
            level,
            step: self.samples[level].step,
        });
        sign_change.into_iter().chain(rise).collect()
    }
}

/// The largest floor up to each level. A NaN stays NaN: it is a verdict of its own.
fn running_floors(samples: &[Sample]) -> Vec<Float> {
    let mut floors: Vec<Float> = Vec::with_capacity(samples.len());
    for sample in samples {
        let floor = match floors.last() {
            Some(before) if *before > sample.floor => before.clone(),
            _ => sample.floor.clone(),
        };
        floors.push(floor);
    }
    floors
}

/// |e| ≤ 30·floor, compared exactly.
fn is_at_floor(error: &Float, floor: &Float) -> bool {
    let margin = Float::with_val(floor.prec() + 8, floor * FLOOR_MARGIN);
    matches!(
        error.cmp_abs(&margin),
        Some(Ordering::Less | Ordering::Equal)
    )
}

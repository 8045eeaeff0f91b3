//! A ladder's levels as a fit sees them: running floors, what stands above them, logarithms.

use super::drift::Local;
use super::{FLOOR_MARGIN, Pair, Sample, Window, tail};
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
    /// floor/|error|: what roundoff may make of an error, relative to it.
    pub(super) noise: Vec<f64>,
    /// Levels before the first that is at the floor or not finite.
    pub(super) usable: usize,
}

impl<'a> Levels<'a> {
    pub(super) fn new(samples: &'a [Sample]) -> Self {
        let floors = running_maximum(samples.iter().map(|s| s.floor.clone()));
        Levels::above(samples, floors)
    }

    /// With these floors, which do not fall.
    fn above(samples: &'a [Sample], floors: Vec<Float>) -> Self {
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
        let points: Vec<(f64, f64)> = samples
            .iter()
            .map(|s| (s.step.log2(), log2_abs(&s.error)))
            .collect();
        let noise = floors.iter().zip(&points);
        let noise = noise.map(|(floor, p)| (log2_abs(floor) - p.1).exp2());
        let noise = noise.collect();
        Levels {
            samples,
            floors,
            at_floor,
            points,
            noise,
            usable,
        }
    }

    /// The same above the floor that the errors themselves show, and its level: where they stop falling, and no floor was given.
    pub(super) fn above_own_floor(&self) -> Option<(Self, usize)> {
        if self.floors.last().is_none_or(|floor| !floor.is_zero()) {
            return None;
        }
        let heights: Vec<f64> = self.points.iter().map(|p| p.1).collect();
        let level = tail::stops_at(&heights)?;
        let size = |s: &Sample| Float::with_val(s.error.prec(), s.error.abs_ref());
        let floor = size(self.samples.get(level)?);
        // Whatever comes later is roundoff as well, and may grow.
        let floors = self.samples.iter().enumerate().map(|(i, s)| match i {
            i if i > level => size(s),
            _ => floor.clone(),
        });
        let floors = running_maximum(floors);
        Some((Levels::above(self.samples, floors), level))
    }

    /// Pairwise orders of the usable levels, with what noise may make of them.
    pub(super) fn locals(&self) -> Vec<Local> {
        (1..self.usable)
            .map(|fine| {
                let (coarse, at) = (self.points[fine - 1], self.points[fine]);
                let log2_ratio = self.log2_ratio(fine);
                let rounding = 8.0 * f64::EPSILON * at.1.abs().max(1.0) / log2_ratio;
                let floors = self.noise[fine - 1] + self.noise[fine];
                Local {
                    order: (coarse.1 - at.1) / log2_ratio,
                    noise: floors / (log2_ratio * LN_2) + rounding,
                    coarse: at.0 + log2_ratio,
                    fine: at.0,
                }
            })
            .collect()
    }

    /// Whether errors lie below 0, in a window.
    pub(super) fn signs(&self, window: Window) -> Vec<bool> {
        let inside = self.samples.iter().skip(window.first);
        let inside = inside.take(window.last + 1 - window.first);
        inside.map(|s| s.error.is_sign_negative()).collect()
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
        self.window_of(last - pairs, last, tolerance)
    }

    /// The window from one level to another.
    pub(super) fn window_of(&self, first: usize, last: usize, tolerance: f64) -> Window {
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
    pub(super) fn risen(&self) -> Option<usize> {
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
}

/// The largest floor up to each level. A NaN stays NaN: it is a verdict of its own.
pub(super) fn running_maximum(floors: impl Iterator<Item = Float>) -> Vec<Float> {
    let mut largest: Vec<Float> = Vec::new();
    for floor in floors {
        let floor = match largest.last() {
            Some(before) if *before > floor => before.clone(),
            _ => floor,
        };
        largest.push(floor);
    }
    largest
}

/// |e| ≤ 30·floor, compared exactly.
fn is_at_floor(error: &Float, floor: &Float) -> bool {
    let margin = Float::with_val(floor.prec() + 8, floor * FLOOR_MARGIN);
    matches!(
        error.cmp_abs(&margin),
        Some(Ordering::Less | Ordering::Equal)
    )
}

//! What a kernel said, and how well it can be expected to agree with a model.

use super::march::terms;
use super::{Lookup, Places, Ray, Recipe};
use crate::case::SymbolicCase;

/// One channel of a case, rendered by a kernel at some levels.
#[derive(Clone, Debug)]
pub struct Watched {
    /// The channel, by name.
    pub name: String,
    /// Its case, for methods that look elsewhere than at ends and middles of segments.
    pub case: SymbolicCase,
    /// |I|.
    pub scale: f64,
    /// From coarse to fine.
    pub levels: Vec<WatchedLevel>,
    /// The radiance of the coarsest level, once more with another seed.
    pub again: Option<f64>,
    /// The samples of every level by tables looked up in other ways; none but for volumes.
    pub lookups: Vec<(Lookup, Vec<Ray<f64>>)>,
}

impl Watched {
    /// As it would be with the samples of the lookup of that index.
    pub(super) fn looked_up(&self, index: usize) -> Watched {
        let mut other = self.clone();
        other.lookups.clear();
        if let Some((_, rays)) = self.lookups.get(index) {
            for (level, ray) in other.levels.iter_mut().zip(rays) {
                level.ray = ray.clone();
            }
        }
        other
    }
}

/// One level of it.
#[derive(Clone, Debug)]
pub struct WatchedLevel {
    /// The samples that the kernel was given.
    pub ray: Ray<f64>,
    /// The number of segments, where they are all of the same length.
    pub uniform: Option<u64>,
    /// The radiance that it gave.
    pub value: f64,
}

/// How far a value may lie from that of the model that a kernel follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// 2^(−p) of a format with p significant bits, at most those of binary64, which all is compared in.
    pub unit: f64,
    /// What values are multiples of, in the units of the radiance; 0 where there is no such thing.
    pub quantum: f64,
}

impl Accuracy {
    /// Of a kernel in a format with that unit.
    #[must_use]
    pub fn new(unit: f64, quantum: f64) -> Self {
        Accuracy {
            unit: unit.max(f64::EPSILON / 2.0),
            quantum,
        }
    }

    /// The largest difference from a model's value that still is agreement.
    ///
    /// Each of n segments rounds a few times; the bound N·2⁻²² of `docs/stress.md` is 4 n u. An opacity
    /// 1 − e^(−x) is wrong by up to u, whatever its size: n u max C in all.
    #[must_use]
    pub fn tolerance(self, level: &WatchedLevel, scale: f64, model: f64) -> f64 {
        self.tolerances(level, scale)(model)
    }

    /// The same for many models, all but their values being looked at once.
    pub(super) fn tolerances(self, level: &WatchedLevel, scale: f64) -> impl Fn(f64) -> f64 {
        let n = level.ray.count() as f64;
        let of_opacities = 2.0 * n * level.ray.largest_emission();
        move |model| {
            let size = scale.max(model.abs());
            self.unit * ((32.0 + 4.0 * n) * size + of_opacities) + 0.5001 * self.quantum
        }
    }
}

impl WatchedLevel {
    /// Whether a model's value is the kernel's.
    #[must_use]
    pub fn agrees(&self, model: f64, scale: f64, accuracy: Accuracy) -> bool {
        (self.value - model).abs() <= accuracy.tolerance(self, scale, model)
    }
}

impl Ray<f64> {
    /// ∫ |C| τ e^(−t), roughly, where C has both signs, so that terms cancel; `None` where it has one.
    #[must_use]
    pub fn cancelling(&self) -> Option<f64> {
        let is = |holds: &dyn Fn(f64) -> bool| self.middles.iter().any(|t| holds(t.emission));
        if !is(&|c| c < 0.0) || !is(&|c| c > 0.0) {
            return None;
        }
        let middles = Recipe {
            places: Places::Middle,
            ..Recipe::default()
        };
        Some(terms(&middles, self))
    }

    /// The largest |C| that was given.
    #[must_use]
    pub fn largest_emission(&self) -> f64 {
        let all = self.edges.iter().chain(&self.middles);
        all.map(|transfer| transfer.emission.abs())
            .fold(0.0, f64::max)
    }
}

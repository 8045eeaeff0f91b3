//! What a kernel shows on one channel of a case.

use super::nominal::Nominal;
use super::{Remark, Standing};
use crate::case::Unproved;
use crate::convergence::{
    ErrorPart, FLOOR_MARGIN, Fit, Replicas, ReportedError, Sample, StochasticFit, Verdict,
};
use crate::kernel::{KernelError, Quantity, Segments};
use crate::method::Expected;
use rug::Float;

/// One channel of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The case, with its channel, or with the quantity where that is another one: `sine-squared:opacity`.
    pub name: String,
    /// What is measured.
    pub quantity: Quantity,
    /// An opacity that was answered outside 0 to 1, beyond rounding.
    pub outside: Option<f64>,
    /// The order that theory, or the kernel, promises; `None` where nothing is promised.
    pub expected: Option<Expected>,
    /// What it should give.
    pub exact: Float,
    /// What that rests on and is not proved.
    pub unproved: Vec<Unproved>,
    /// What was measured.
    pub measured: Measured,
    /// Levels without an answer.
    pub failures: Vec<Failure>,
    /// Whether the declared method, or every method of the declared order, shows its order on these levels.
    pub is_required: bool,
    /// Whether its error at the finest level is no larger than that of the worst of these methods.
    pub is_as_good: bool,
    /// Where answers are multiples of a quantum, and methods are less than half of it off at the finest level: whether the
    /// answer there is right to one.
    pub right_to_quantum: Option<bool>,
    /// Whether the answers of all levels are those of the declared method; `None` where nothing is declared, or nothing can
    /// be told.
    pub as_declared: Option<bool>,
    /// What is visibly wrong.
    pub remarks: Vec<Remark>,
    /// Whether the coarsest level gave the same radiance twice: of a kernel that draws random numbers, to the same seed.
    pub steady: bool,
    /// Standard errors that the kernel reported of its answers, beside their scatter; `None` where it reported none.
    pub reported: Option<ReportedError>,
    /// What that says of the kernel.
    pub standing: Standing,
}

/// Orders, if there were answers to fit them to.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// Of a deterministic kernel.
    Fitted {
        /// The fit.
        fit: Box<Fit>,
        /// What it was fitted to.
        samples: Vec<Sample>,
    },
    /// Of one that draws random numbers.
    Scattered(Box<StochasticFit>),
    /// Too few levels were answered.
    Nothing,
}

impl Measured {
    /// The verdict on the order.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Measured::Fitted { fit, .. } => fit.verdict,
            Measured::Scattered(fit) => fit.verdict,
            Measured::Nothing => Verdict::TooFewLevels,
        }
    }

    /// The order and the half-width of its interval, where there is a window for one; of a kernel that draws random numbers
    /// that of the larger part of its error, where that has one.
    #[must_use]
    pub fn order(&self) -> Option<(f64, f64)> {
        match self {
            Measured::Fitted { fit, .. } => {
                fit.window?;
                fit.order.zip(fit.half_width)
            }
            Measured::Scattered(fit) => {
                let parts = [fit.larger, ErrorPart::Scatter, ErrorPart::Bias];
                let mut orders = parts.into_iter().filter_map(|part| fit.order_of(part));
                let interval = orders.find(|order| order.half_width().is_finite())?;
                Some((interval.order, interval.half_width()))
            }
            Measured::Nothing => None,
        }
    }
}

/// A level without an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The number of segments asked for.
    pub segments: u64,
    /// Why.
    pub error: KernelError,
}

impl Failure {
    pub(super) fn new(segments: u64, error: &KernelError) -> Self {
        Failure {
            segments,
            error: error.clone(),
        }
    }
}

impl Line {
    /// The largest error of all levels, as a part of the radiance; of random answers, that of their mean.
    #[must_use]
    pub fn largest_error(&self) -> Option<f64> {
        let bits = self.exact.prec();
        let errors: Vec<f64> = match &self.measured {
            Measured::Fitted { samples, .. } => {
                let errors = samples.iter().map(|sample| &sample.error);
                errors.map(|error| part_of(&self.exact, error)).collect()
            }
            Measured::Scattered(fit) => {
                let means = fit
                    .levels
                    .iter()
                    .map(|level| Float::with_val(bits, level.mean));
                means.map(|mean| part_of(&self.exact, &mean)).collect()
            }
            Measured::Nothing => Vec::new(),
        };
        // NaN is the largest of all.
        errors.into_iter().max_by(f64::total_cmp)
    }

    /// Whether it shows the order, no error at all, or no larger one than methods have.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.standing == Standing::Confirmed || self.is_as_good || self.is_right_to_rounding()
    }

    /// Whether no level has an error that is more than rounding.
    fn is_right_to_rounding(&self) -> bool {
        let Measured::Fitted { samples, .. } = &self.measured else {
            return false;
        };
        let is_rounding = |sample: &Sample| {
            let margin = Float::with_val(sample.floor.prec(), FLOOR_MARGIN * &sample.floor);
            // NaN is no rounding.
            Float::with_val(margin.prec(), sample.error.abs_ref()) <= margin
        };
        !samples.is_empty() && samples.iter().all(is_rounding)
    }

    /// Whether every level was answered.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.failures.is_empty()
    }

    /// Whether not a single level was answered.
    #[must_use]
    pub fn is_without_answer(&self) -> bool {
        !self.failures.is_empty()
            && match &self.measured {
                Measured::Fitted { samples, .. } => samples.is_empty(),
                Measured::Scattered(_) => false,
                Measured::Nothing => true,
            }
    }
}

/// The radiances of one channel at all levels that were answered.
pub(super) struct Radiances {
    pub(super) exact: Float,
    levels: Vec<LevelRadiances>,
}

/// Those of one level.
pub(super) struct LevelRadiances {
    /// Segments of the ray.
    pub(super) segments: u64,
    /// The segments, lit as what is wanted, where methods do not cut the ray so by themselves.
    pub(super) uneven: Option<Segments>,
    pub(super) n: Option<u64>,
    pub(super) step: f64,
    /// By seed.
    pub(super) values: Vec<Float>,
    pub(super) floor: Float,
    /// What rounding at the end takes at most.
    pub(super) stored: f64,
    /// Of the declared method.
    pub(super) nominal: Option<Nominal>,
    /// Standard errors that the kernel reports, by seed.
    pub(super) reported: Vec<f64>,
}

impl Radiances {
    pub(super) fn new(exact: Float) -> Self {
        Radiances {
            exact,
            levels: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, level: LevelRadiances) {
        // A kernel that says it used the same step again has not refined: that level adds nothing.
        let refines = |last: &LevelRadiances| level.step < last.step;
        if self.levels.last().is_none_or(refines) {
            self.levels.push(level);
        }
    }

    /// The first that is no opacity, but for rounding.
    pub(super) fn outside_of_opacities(&self) -> Option<f64> {
        let is_outside = |value: &Float, floor: &Float| {
            let margin = floor.to_f64() * f64::from(FLOOR_MARGIN);
            let value = value.to_f64();
            value < -margin || value > 1.0 + margin
        };
        let levels = self.levels.iter();
        let values =
            levels.flat_map(|level| level.values.iter().map(|value| (value, &level.floor)));
        let mut outside = values.filter(|(value, floor)| is_outside(value, floor));
        outside.next().map(|(value, _)| value.to_f64())
    }

    /// The segments of every level that methods do not cut so by themselves.
    pub(super) fn uneven(&self) -> Vec<&Segments> {
        let uneven = self.levels.iter().map(|level| level.uneven.as_ref());
        uneven.flatten().collect()
    }

    /// Whether every answer is a number.
    pub(super) fn are_finite(&self) -> bool {
        let mut values = self.levels.iter().flat_map(|level| &level.values);
        values.all(Float::is_finite)
    }

    fn error(&self, value: &Float) -> Float {
        Float::with_val(self.exact.prec(), value - &self.exact)
    }

    pub(super) fn samples(&self) -> Vec<Sample> {
        let sample = |level: &LevelRadiances| {
            Some(Sample {
                n: level.n,
                step: level.step,
                error: self.error(level.values.first()?),
                floor: level.floor.clone(),
            })
        };
        self.levels.iter().filter_map(sample).collect()
    }

    /// What answers at the finest level are multiples of, where that is declared.
    pub(super) fn quantum(&self) -> Option<f64> {
        let finest = self.levels.last();
        let quantum = finest.map(|finest| 2.0 * finest.stored);
        quantum.filter(|quantum| *quantum > 0.0)
    }

    /// With the number of segments of each.
    pub(super) fn counted_samples(&self) -> Vec<(u64, Sample)> {
        let counts = self.levels.iter().map(|level| level.segments);
        counts.zip(self.samples()).collect()
    }

    /// Those of the declared method itself, exactly or in the declared format, where it has one at every level.
    pub(super) fn nominal_samples(&self, of: impl Fn(&Nominal) -> &Float) -> Option<Vec<Sample>> {
        let sample = |level: &LevelRadiances| {
            Some(Sample {
                n: level.n,
                step: level.step,
                error: self.error(of(level.nominal.as_ref()?)),
                floor: level.floor.clone(),
            })
        };
        self.levels.iter().map(sample).collect()
    }

    /// Standard errors that the kernel reports, by level and seed.
    pub(super) fn reported(&self) -> Vec<Vec<f64>> {
        let reported = self.levels.iter().map(|level| level.reported.clone());
        reported.collect()
    }

    pub(super) fn replicas(&self) -> Vec<Replicas> {
        let replicas = |level: &LevelRadiances| Replicas {
            n: level.n,
            step: level.step,
            errors: level
                .values
                .iter()
                .map(|value| self.error(value).to_f64())
                .collect(),
            floor: level.floor.to_f64(),
        };
        self.levels.iter().map(replicas).collect()
    }
}

/// |x| as a part of the radiance: either may lie beyond binary64.
pub(super) fn part_of(exact: &Float, x: &Float) -> f64 {
    Float::with_val(f64::MANTISSA_DIGITS, x / exact)
        .to_f64()
        .abs()
}

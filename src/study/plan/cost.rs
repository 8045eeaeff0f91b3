//! What models cost.

use super::Model;
use super::light::opaque;
use crate::real::counted::{Counted, Kind, count};
use crate::real::{Counts, Format, FormatName, Native};
use crate::scene::{BoundPiece, Columns, Scene};
use crate::study::tradeoff::Calibration;
use rug::Rational;

/// What is to be little.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Cost {
    /// Evaluations of C and τ; of models with as many the simpler one.
    #[default]
    Evaluations,
    /// Nanoseconds.
    Time(TimeCost),
}

/// What operations cost, in nanoseconds of binary64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeCost {
    /// An evaluation of the media, for all channels.
    pub evaluation: f64,
    /// An exponential.
    pub exponential: f64,
    /// A product added to a sum.
    pub multiplication: f64,
}

impl TimeCost {
    /// On this machine, for a scene: its media are evaluated under the counting scalar, and the counts priced.
    #[must_use]
    pub fn of(scene: &Scene) -> TimeCost {
        let calibration = Calibration::of_format(FormatName::F64);
        let format = Counted(Native::<f64>::new());
        let mut evaluations = Counts::default();
        let mut pieces = 0;
        for piece in scene.media().iter().flat_map(|medium| &medium.pieces) {
            let bound = BoundPiece::new(piece, format);
            let middle = format.ratio(&(Rational::from(&piece.from + &piece.to) / 2));
            let mut columns = Columns::new(scene.channels().len());
            let ((), counts) = count(|| bound.evaluate(&[middle], &mut columns));
            evaluations += counts;
            pieces += 1;
        }
        TimeCost {
            evaluation: calibration.nanoseconds(&evaluations) / f64::from(pieces.max(1)),
            exponential: calibration.cost(Kind::Exponential),
            multiplication: calibration.cost(Kind::Multiplication)
                + calibration.cost(Kind::Addition),
        }
    }
}

/// How much simpler has to be cheaper by: less than any evaluation.
const SIMPLER: f64 = 1e-3;

impl Cost {
    /// What a model costs, for so many channels and a stretch of that optical depth.
    pub(super) fn of(self, model: Model, channels: usize, depth: f64) -> f64 {
        let evaluations = f64::from(model.evaluations());
        let channels = channels as f64;
        let work = Work::of(model, depth);
        match self {
            Cost::Evaluations => evaluations + SIMPLER * (1.0 - 1.0 / (1.0 + work.exponentials)),
            Cost::Time(time) => {
                let sums = work.exponentials * time.exponential
                    + work.multiplications * time.multiplication;
                evaluations * time.evaluation + channels * sums
            }
        }
    }
}

/// What a model does for each channel beside evaluating.
struct Work {
    exponentials: f64,
    multiplications: f64,
}

impl Work {
    fn of(model: Model, depth: f64) -> Work {
        let points = f64::from(model.points().unwrap_or(0));
        let (exponentials, multiplications) = match model {
            Model::Nothing => (0.0, 0.0),
            Model::EmissionOnly { .. } => (0.0, 2.0 * points),
            Model::AbsorptionOnly { .. } => (1.0, points),
            Model::Constant => (2.0, 2.0),
            Model::ConstantEmission { .. } => (2.0, points + 1.0),
            // Its series has some twenty terms of three products, on every stretch of depth 1 that is seen.
            Model::Linear => {
                let seen = opaque(f64::MANTISSA_DIGITS) as f64;
                let stretches = depth.ceil().clamp(1.0, seen);
                (stretches, 60.0 * stretches)
            }
            Model::Quadrature { .. } => (points + 1.0, points * (points + 4.0)),
        };
        Work {
            exponentials,
            multiplications,
        }
    }
}

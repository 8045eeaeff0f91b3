//! A model of what a kernel may compute: compositing, with everything that goes wrong in it.

mod words;

use super::Places;
use crate::method::{
    Accumulation, CompositingOrder, Exponential, Inner, Method, Nested, OpacityFormula, Position,
    Scope,
};
use crate::quadrature::Rule;

/// Compositing as a kernel may do it, correctly or not. The default is samples in front, opacities
/// 1 − e^(−τ d), front to back, in binary64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Recipe {
    /// Where in its segment a sample lies.
    pub places: Places,
    /// What becomes of the first and the last sample.
    pub ends: Ends,
    /// α of a segment, and what it lets through.
    pub opacity: OpacityModel,
    /// What a segment adds.
    pub emission: EmissionModel,
    /// The back of the ray is taken for its front.
    pub swapped: bool,
    /// The last segment is taken to be opaque.
    pub wall: bool,
    /// The transmittance at which the ray ends.
    pub stop: Option<f64>,
    /// What radiance and transmittance are kept in.
    pub accumulator: Accumulator,
    /// How tables of the transfer functions are looked up, where that is not as they are meant.
    pub lookup: Option<Lookup>,
}

/// A table looked up otherwise than linearly between all of its entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Lookup {
    /// The entries that are left, where the table was made coarser.
    pub entries: Option<usize>,
    /// The nearest entry is taken.
    pub nearest: bool,
}

/// What becomes of the samples at the ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Ends {
    /// Of the first one.
    pub first: End,
    /// Of the last one.
    pub last: End,
    /// There is one sample more than there are segments: at D for samples in front, at 0 for samples at the back.
    pub one_extra: bool,
}

/// What becomes of one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum End {
    /// It counts once.
    #[default]
    Kept,
    /// It is missing.
    Dropped,
    /// It counts twice.
    Doubled,
}

/// How a segment's opacity comes of its extinction τ and its length d.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum OpacityModel {
    /// 1 − e^(−τ d).
    #[default]
    Exact,
    /// τ d, and 1 − τ d let through.
    Linear,
    /// τ d, and e^(−τ d) let through: the attenuation inside the segment is neglected.
    Unattenuated,
    /// 1 − e^(−τ ℓ), whatever the step: not corrected for it.
    Uncorrected {
        /// ℓ.
        length: f64,
    },
    /// 1 − e^(−κ τ d): corrected by an exponent with a wrong reference length.
    Rescaled {
        /// κ, the true reference length by the one used.
        factor: f64,
    },
    /// 1 − e^(−τ d), but 1 − e^(−τ ℓ) where that is not above a threshold: the correction is skipped.
    SkippedUnder {
        /// The threshold.
        threshold: f64,
        /// ℓ.
        length: f64,
    },
}

/// What a segment adds to the radiance, before the transmittance in front of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EmissionModel {
    /// C α.
    #[default]
    TimesOpacity,
    /// C: not multiplied by the opacity.
    Unweighted,
    /// C α²: multiplied twice.
    TimesOpacityTwice,
}

/// What radiance and transmittance are kept in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Accumulator {
    /// binary64, or whatever the samples come in.
    #[default]
    Float,
    /// binary32 throughout.
    Binary32,
    /// Multiples of a quantum.
    Fixed {
        /// Bits b of the fraction.
        bits: u32,
        /// The quantum: 2^(−b), or 1/(2^b − 1) as in images.
        scale: FixedScale,
        /// What is between two multiples.
        rounding: FixedRounding,
    },
}

/// The quantum of a fixed-point accumulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FixedScale {
    /// 2^(−b).
    PowerOfTwo,
    /// 1/(2^b − 1).
    Largest,
}

/// What a fixed-point accumulator does with what is between two multiples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FixedRounding {
    /// The nearest multiple.
    Nearest,
    /// The next one towards 0.
    Down,
}

impl FixedScale {
    /// How many quanta make 1.
    #[must_use]
    pub fn quanta(self, bits: u32) -> f64 {
        let all = f64::from(bits).exp2();
        match self {
            FixedScale::PowerOfTwo => all,
            FixedScale::Largest => all - 1.0,
        }
    }
}

impl Recipe {
    /// The recipe that a method of this crate is in exact arithmetic, where it is compositing.
    #[must_use]
    pub fn of_method(method: &Method) -> Option<Recipe> {
        let compositing = match method {
            Method::Composited(compositing) => compositing,
            Method::Nested(nested) => return of_nested(nested),
            Method::Preintegrated(_) => return None,
        };
        let depths = matches!(
            compositing.order,
            CompositingOrder::FrontToBack {
                depth: Accumulation::Depths,
                ..
            }
        );
        Some(Recipe {
            places: match compositing.position {
                Position::Front => Places::Front,
                Position::Middle => Places::Middle,
                Position::Back => Places::Back,
            },
            opacity: match compositing.opacity {
                OpacityFormula::Linear if depths => OpacityModel::Unattenuated,
                OpacityFormula::Linear => OpacityModel::Linear,
                _ => OpacityModel::Exact,
            },
            stop: compositing.threshold().map(|stop| stop.value().to_f64()),
            ..Recipe::default()
        })
    }

    /// How many of its parts are not as they should be; the position of samples and a linear opacity are
    /// choices, not defects.
    #[must_use]
    pub fn defects(&self) -> usize {
        let parts = [
            self.ends.first != End::Kept,
            self.ends.last != End::Kept,
            self.ends.one_extra,
            !matches!(self.opacity, OpacityModel::Exact | OpacityModel::Linear),
            self.emission != EmissionModel::TimesOpacity,
            self.swapped,
            self.wall,
            self.stop.is_some(),
            self.accumulator != Accumulator::Float,
            self.lookup.is_some(),
        ];
        parts.into_iter().filter(|part| *part).count()
    }
}

/// Rules that look at the ends of segments alone, and are compositing in other words.
fn of_nested(nested: &Nested) -> Option<Recipe> {
    let Inner::PerSegment(inner) = nested.inner else {
        return None;
    };
    let recipe = Recipe::default();
    match (inner, nested.outer.0, nested.exponential, nested.scope) {
        (Rule::Trapezoid, Rule::Trapezoid, Exponential::Exact, _) => Some(Recipe {
            places: Places::Ends,
            ..recipe
        }),
        (Rule::RiemannLeft, Rule::RiemannLeft, Exponential::Exact, _) => Some(Recipe {
            opacity: OpacityModel::Unattenuated,
            ..recipe
        }),
        (Rule::RiemannLeft, Rule::RiemannLeft, Exponential::Linear, Scope::PerSegment) => {
            Some(Recipe {
                opacity: OpacityModel::Linear,
                ..recipe
            })
        }
        _ => None,
    }
}

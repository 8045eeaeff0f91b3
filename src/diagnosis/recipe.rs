//! A model of what a kernel may compute: compositing, with everything that goes wrong in it.

use super::Places;
use crate::method::{
    Accumulation, CompositingOrder, Exponential, Inner, Method, Nested, OpacityFormula, Position,
    Scope,
};
use crate::quadrature::Rule;
use std::fmt;

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
pub enum Ends {
    /// All of them, once each.
    #[default]
    Kept,
    /// The first one is missing.
    FirstDropped,
    /// The last one is missing.
    LastDropped,
    /// The first one counts twice.
    FirstDoubled,
    /// The last one counts twice.
    LastDoubled,
    /// One sample more than there are segments: at D for samples in front, at 0 for samples at the back.
    OneExtra,
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
            self.ends != Ends::Kept,
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

/// In words: `front samples, 1 − exp(−τd), last sample missing`.
impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.places)?;
        if self.places.is_one_sample() {
            write!(f, ", {}", self.opacity)?;
        }
        let ends = match self.ends {
            Ends::Kept => "",
            Ends::FirstDropped => ", first sample missing",
            Ends::LastDropped => ", last sample missing",
            Ends::FirstDoubled => ", first sample counted twice",
            Ends::LastDoubled => ", last sample counted twice",
            Ends::OneExtra => ", one extra sample",
        };
        f.write_str(ends)?;
        f.write_str(match self.emission {
            EmissionModel::TimesOpacity => "",
            EmissionModel::Unweighted => ", emission not multiplied by opacity",
            EmissionModel::TimesOpacityTwice => ", emission multiplied by opacity twice",
        })?;
        if self.swapped {
            f.write_str(", back and front swapped")?;
        }
        if self.wall {
            f.write_str(", last segment opaque (far wall)")?;
        }
        if let Some(stop) = self.stop {
            write!(f, ", ray ended at a transmittance of {}", Part(stop))?;
        }
        if let Some(lookup) = self.lookup {
            write!(f, ", {lookup}")?;
        }
        match self.accumulator {
            Accumulator::Float => Ok(()),
            Accumulator::Binary32 => f.write_str(", in binary32"),
            Accumulator::Fixed {
                bits,
                scale,
                rounding,
            } => {
                let how = match rounding {
                    FixedRounding::Nearest => "rounded",
                    FixedRounding::Down => "cut off",
                };
                let unit = match scale {
                    FixedScale::PowerOfTwo => format!("2^-{bits}"),
                    FixedScale::Largest => format!("1/{}", scale.quanta(bits)),
                };
                write!(f, ", accumulator of {bits} bits ({how} to {unit})")
            }
        }
    }
}

impl fmt::Display for Lookup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.entries, self.nearest) {
            (Some(entries), false) => {
                write!(
                    f,
                    "transfer functions sampled too coarsely ({entries} entries)"
                )
            }
            (Some(entries), true) => write!(
                f,
                "transfer functions sampled too coarsely ({entries} entries, the nearest one taken)"
            ),
            (None, true) => f.write_str("the nearest entry of tables taken"),
            (None, false) => f.write_str("tables as they are"),
        }
    }
}

impl fmt::Display for OpacityModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OpacityModel::Exact => f.write_str("1 - exp(-τd)"),
            OpacityModel::Linear => f.write_str("opacity τd"),
            OpacityModel::Unattenuated => {
                f.write_str("exp(-τd) let through, attenuation inside segments neglected")
            }
            OpacityModel::Uncorrected { length } => {
                write!(
                    f,
                    "1 - exp(-τ·{}), not corrected for the step",
                    Part(*length)
                )
            }
            OpacityModel::Rescaled { factor } => write!(
                f,
                "1 - exp(-{}·τd), corrected with a wrong reference length",
                Part(*factor)
            ),
            OpacityModel::SkippedUnder { threshold, length } => write!(
                f,
                "1 - exp(-τd), correction for the step skipped where 1 - exp(-τ·{}) is not above {}",
                Part(*length),
                Part(*threshold)
            ),
        }
    }
}

/// A parameter with as many digits as say something: as a power of ten, a short decimal, or 1 by an integer.
struct Part(f64);

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = |count: usize| format!("{:.count$e}", self.0).parse::<f64>();
        let is_near = |short: f64| (short / self.0 - 1.0).abs() < 1e-6;
        if let Ok(short) = digits(2)
            && is_near(short)
        {
            return if short < 1e-3 {
                write!(f, "{short:e}")
            } else {
                write!(f, "{short}")
            };
        }
        let inverse = (1.0 / self.0).round();
        if (2.0..65_536.5).contains(&inverse) && is_near(1.0 / inverse) {
            return write!(f, "1/{inverse}");
        }
        match digits(4) {
            Ok(short) => write!(f, "{short}"),
            Err(_) => write!(f, "{}", self.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recipes_are_said_in_words() {
        let recipe = Recipe {
            ends: Ends::LastDropped,
            ..Recipe::default()
        };
        assert_eq!(
            recipe.to_string(),
            "front samples, 1 - exp(-τd), last sample missing"
        );
        assert_eq!(recipe.defects(), 1);
        let recipe = Recipe {
            places: Places::Middle,
            opacity: OpacityModel::Linear,
            stop: Some(1.0 / 255.0),
            accumulator: Accumulator::Binary32,
            ..Recipe::default()
        };
        assert_eq!(
            recipe.to_string(),
            "middle samples, opacity τd, ray ended at a transmittance of 1/255, in binary32"
        );
        let parts = [0.05, 1e-4, 1.0, 1.25, 0.003_921_568_6, 0.012_345_67];
        let shown = parts.map(|part| Part(part).to_string());
        assert_eq!(shown, ["0.05", "1e-4", "1", "1.25", "1/255", "0.012346"]);
    }

    #[test]
    fn methods_that_composite_are_recipes() {
        let of = |name: &str| Recipe::of_method(&name.parse().unwrap());
        assert_eq!(of("front-to-back/front/expm1"), Some(Recipe::default()));
        assert_eq!(of("tree/front/subtraction"), Some(Recipe::default()));
        let unattenuated = of("front-to-back/back/linear/depths").unwrap();
        assert_eq!(unattenuated.opacity, OpacityModel::Unattenuated);
        assert_eq!(unattenuated.places, Places::Back);
        assert_eq!(of("trapezoid/trapezoid").unwrap().places, Places::Ends);
        assert_eq!(of("simpson/trapezoid"), None);
        assert_eq!(of("trapezoid/trapezoid/linear"), None);
        let left = of("riemann-left/riemann-left/linear").unwrap();
        assert_eq!(left.opacity, OpacityModel::Linear);
        let stopped = of("front-to-back/middle/linear/stop=1:255").unwrap();
        assert_eq!(stopped.stop, Some(1.0 / 255.0));
    }
}

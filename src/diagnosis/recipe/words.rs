//! Recipes in words.

use super::{
    Accumulator, EmissionModel, End, FixedRounding, FixedScale, Lookup, OpacityModel, Recipe,
};
use std::fmt;

/// In words: `front samples, 1 − exp(−τd), last sample missing`.
impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.places)?;
        if self.places.is_one_sample() {
            write!(f, ", {}", self.opacity)?;
        }
        for (end, which) in [(self.ends.first, "first"), (self.ends.last, "last")] {
            match end {
                End::Kept => {}
                End::Dropped => write!(f, ", {which} sample missing")?,
                End::Doubled => write!(f, ", {which} sample counted twice")?,
            }
        }
        if self.ends.one_extra {
            f.write_str(", one extra sample")?;
        }
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

//! What a run is said to be where it has no digits to promise.

use serde::Serialize;
use std::fmt;

/// Why the digits of a cell are no measure of its method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// 0/0 in the medium, or NaN on the way.
    NotANumber,
    /// The medium gives ∞.
    Infinite,
    /// A result beyond the largest number.
    Overflow,
    /// A fixed-point number at its end.
    Saturated,
    /// 1 − τ d < −1 somewhere: transmittances change sign from segment to segment, and grow.
    Oscillating,
    /// 1 − τ d < 0 somewhere.
    NegativeTransmittance,
    /// A radiance below 0.
    NegativeRadiance,
    /// The medium gives C or τ below 0.
    NegativeMedium,
    /// e^(−t(D)) is below MPFR's range: the oracle has no transmittance to compare with.
    OracleUnderflow,
    /// A sample may lie on another side of a jump than without rounding.
    BranchDiverged,
    /// Opacities became 0 because e^(−τ d) was rounded to 1.
    Absorbed,
    /// Numbers too small for the format, and not small beside the radiance.
    Underflow,
    /// Terms that changed nothing any more add up to more than the result may be off by.
    Stalled,
    /// The method cannot run there.
    Refused,
    /// Not run: it takes too long.
    LeftOut,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Verdict; 15] = [
        Verdict::NotANumber,
        Verdict::Infinite,
        Verdict::Overflow,
        Verdict::Saturated,
        Verdict::Oscillating,
        Verdict::NegativeTransmittance,
        Verdict::NegativeRadiance,
        Verdict::NegativeMedium,
        Verdict::OracleUnderflow,
        Verdict::BranchDiverged,
        Verdict::Absorbed,
        Verdict::Underflow,
        Verdict::Stalled,
        Verdict::Refused,
        Verdict::LeftOut,
    ];

    /// In at most five letters.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Verdict::NotANumber => "nan",
            Verdict::Infinite => "inf",
            Verdict::Overflow => "over",
            Verdict::Saturated => "satur",
            Verdict::Oscillating => "oscil",
            Verdict::NegativeTransmittance => "neg-T",
            Verdict::NegativeRadiance => "neg-I",
            Verdict::NegativeMedium => "neg-C",
            Verdict::OracleUnderflow => "oracl",
            Verdict::BranchDiverged => "brnch",
            Verdict::Absorbed => "absrb",
            Verdict::Underflow => "under",
            Verdict::Stalled => "stall",
            Verdict::Refused => "refus",
            Verdict::LeftOut => "-",
        }
    }

    /// In one line.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Verdict::NotANumber => "0/0 in the medium, or NaN on the way",
            Verdict::Infinite => "the medium gives an infinity",
            Verdict::Overflow => "a number beyond the format's largest",
            Verdict::Saturated => "a fixed-point number at its end",
            Verdict::Oscillating => {
                "1 - tau d < -1: transmittances change sign from segment to segment and grow"
            }
            Verdict::NegativeTransmittance => "1 - tau d < 0 in a segment",
            Verdict::NegativeRadiance => "a radiance below 0",
            Verdict::NegativeMedium => "the medium gives C or tau below 0",
            Verdict::OracleUnderflow => {
                "exp(-t) is below the range of MPFR, the oracle: no transmittance to compare with"
            }
            Verdict::BranchDiverged => "a sample may lie on the wrong side of a jump",
            Verdict::Absorbed => "opacities are 0: exp(-tau d) was rounded to 1",
            Verdict::Underflow => "numbers too small for the format, not small beside the radiance",
            Verdict::Stalled => "terms that changed nothing any more add up to too much",
            Verdict::Refused => "the method cannot run there",
            Verdict::LeftOut => "left out: takes too long, or too much memory",
        }
    }
}

/// Its name, as in Rust.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

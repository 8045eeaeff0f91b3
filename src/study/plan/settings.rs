//! What a plan is to reach, and with what.

use super::Cost;
use crate::real::FormatName;

/// The number of bits of which a plan may be the last resort.
pub(super) const MAX_BITS: u32 = 4096;

/// What a plan is to reach, and with what.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// How far the radiance of every channel may be from the exact one.
    pub tolerance: f64,
    /// Formats that may be used; none stands for binary32, binary64 and as many bits of MPFR as it takes.
    pub formats: Vec<FormatName>,
    /// What is to be little.
    pub cost: Cost,
}

impl Settings {
    /// Any format, and as few evaluations of the media as may be.
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Settings {
            tolerance,
            formats: Vec::new(),
            cost: Cost::Evaluations,
        }
    }
}

//! What numbers of rays and of samples have to offer.

// Samples are rounded to the numbers of rays where those are shorter.
#![allow(clippy::cast_possible_truncation)]

use crate::real::lanes::LaneFloat;

/// A sample of a volume.
pub(super) trait Sample: Copy + Send + Sync + 'static {
    /// Rounded once to nearest.
    fn binary32(self) -> f32;
    /// As it is.
    fn binary64(self) -> f64;
}

impl Sample for f32 {
    #[inline(always)]
    fn binary32(self) -> f32 {
        self
    }
    #[inline(always)]
    fn binary64(self) -> f64 {
        f64::from(self)
    }
}

impl Sample for f64 {
    #[inline(always)]
    fn binary32(self) -> f32 {
        self as f32
    }
    #[inline(always)]
    fn binary64(self) -> f64 {
        self
    }
}

/// A number of rays.
pub(super) trait Number: LaneFloat {
    /// Rounded once to nearest.
    fn rounded<S: Sample>(sample: S) -> Self;
    /// As it is.
    fn wide(self) -> f64;
    /// i where this is [`INTEGER`](crate::real::lanes::LaneFloat) + i, 0 ≤ i below 2²² and 2⁵¹.
    fn index(self) -> usize;
}

impl Number for f32 {
    #[inline(always)]
    fn rounded<S: Sample>(sample: S) -> f32 {
        sample.binary32()
    }
    #[inline(always)]
    fn wide(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn index(self) -> usize {
        (self.to_bits() & ((1 << (f32::MANTISSA_DIGITS - 2)) - 1)) as usize
    }
}

impl Number for f64 {
    #[inline(always)]
    fn rounded<S: Sample>(sample: S) -> f64 {
        sample.binary64()
    }
    #[inline(always)]
    fn wide(self) -> f64 {
        self
    }
    #[inline(always)]
    fn index(self) -> usize {
        (self.to_bits() & ((1 << (f64::MANTISSA_DIGITS - 2)) - 1)) as usize
    }
}

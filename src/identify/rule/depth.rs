//! The optical depth of a segment, as kernels have it.

use crate::real::{Format, Real};
use serde::{Deserialize, Serialize};

/// An exponent that is a multiple of one half.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Power {
    /// Twice the exponent.
    pub halves: i8,
}

impl Power {
    /// 0.
    pub const ZERO: Power = Power { halves: 0 };
    /// ½.
    pub const HALF: Power = Power { halves: 1 };
    /// 1.
    pub const ONE: Power = Power { halves: 2 };

    /// The exponent.
    #[must_use]
    pub fn exponent(self) -> f64 {
        f64::from(self.halves) / 2.0
    }

    /// x to this power.
    pub fn of<R: Real>(self, x: &R) -> R {
        let one = x.format().int(1);
        if self.halves == 0 {
            return one;
        }
        let count = self.halves.unsigned_abs();
        let mut power = if count % 2 == 1 {
            x.clone().sqrt()
        } else {
            one.clone()
        };
        for _ in 0..count / 2 {
            power *= x;
        }
        if self.halves < 0 { one / &power } else { power }
    }
}

/// x = κ τ^a d^b D^c.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Depth {
    /// κ.
    pub factor: f64,
    /// a, of the extinction.
    pub extinction: Power,
    /// b, of the segment's length.
    pub length: Power,
    /// c, of the ray's length.
    pub ray: Power,
}

impl Default for Depth {
    /// τ d.
    fn default() -> Self {
        Depth {
            factor: 1.0,
            extinction: Power::ONE,
            length: Power::ONE,
            ray: Power::ZERO,
        }
    }
}

impl Depth {
    /// x.
    pub fn of<R: Real>(&self, extinction: &R, length: &R, ray: &R) -> R {
        let format = length.format();
        let mut x = if self.extinction == Power::ONE {
            extinction.clone()
        } else {
            self.extinction.of(extinction)
        };
        if self.length == Power::ONE {
            x *= length;
        } else if self.length != Power::ZERO {
            x *= &self.length.of(length);
        }
        if self.ray != Power::ZERO {
            x *= &self.ray.of(ray);
        }
        if (self.factor - 1.0).abs() > 0.0 {
            x *= &format.binary64(self.factor);
        }
        x
    }

    /// Whether it is τ d.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        *self == Depth::default()
    }
}

//! Fixed-point formats: multiples of a quantum, saturating at both ends.

mod number;

pub use number::FixedReal;

use super::{Format, FormatError};
use rug::float::{Constant, Round};
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};

/// Most bits of a fixed-point format before the point, and those of `fixed:F`.
pub const MAX_INTEGER: u32 = 16;
/// Most bits of a fixed-point format after the point.
pub const MAX_FRACTION: u32 = 30;

/// A fixed-point format: the multiples of the quantum q = 2^−fraction with |x| ≤ 2^integer − q, as the
/// accumulators of renderers are.
///
/// Arithmetic, roots, elementary functions and constants are correctly rounded to the quantum, ties to even,
/// with an error of at most q/2. What lies beyond an end becomes that end, ±x/0 with x ≠ 0 and ln 0 included; invalid operations
/// (0/0, √−1, ln −1) give the format's only NaN. There are no infinities, and 0 has no sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fixed {
    integer: u32,
    fraction: u32,
}

impl Fixed {
    /// The format of `integer` bits before and `fraction` bits after the point, and a sign.
    ///
    /// # Errors
    /// [`FormatError::FixedRange`] unless integer ≤ [`MAX_INTEGER`] and 1 ≤ fraction ≤ [`MAX_FRACTION`].
    pub fn new(integer: u32, fraction: u32) -> Result<Fixed, FormatError> {
        if integer <= MAX_INTEGER && (1..=MAX_FRACTION).contains(&fraction) {
            Ok(Fixed { integer, fraction })
        } else {
            Err(FormatError::FixedRange { integer, fraction })
        }
    }

    /// Bits before the point.
    #[must_use]
    pub const fn integer_bits(self) -> u32 {
        self.integer
    }

    /// Bits after the point.
    #[must_use]
    pub const fn fraction_bits(self) -> u32 {
        self.fraction
    }

    /// The largest number, in quanta.
    pub(crate) const fn largest(self) -> i64 {
        (1 << (self.integer + self.fraction)) - 1
    }

    /// So many quanta, or the nearer end.
    fn saturate(self, quanta: i128) -> FixedReal {
        let largest = self.largest();
        // Beyond 64 bits is beyond the largest in any case.
        let end = if quanta < 0 { -largest } else { largest };
        let quanta = i64::try_from(quanta).map_or(end, |quanta| quanta.clamp(-largest, largest));
        FixedReal::new(self, Some(quanta))
    }

    /// The bits that MPFR computes in: then this format is the subnormal range of a floating-point
    /// format, and its one rounding is MPFR's own.
    const fn working_bits(self) -> u32 {
        self.integer + self.fraction + 1
    }

    /// A number of this format from one that MPFR rounded to nearest at [`Fixed::working_bits`] bits.
    fn fit(self, (mut value, ternary): (Float, Ordering)) -> FixedReal {
        value.subnormalize_round(self.integer.cast_signed() + 1, ternary, Round::Nearest);
        if value.is_nan() {
            return FixedReal::new(self, None);
        }
        let largest = self.largest();
        let end = if value.is_sign_negative() {
            -largest
        } else {
            largest
        };
        // An exponent far beyond the end must not become an integer of as many bits.
        let beyond = value.is_infinite()
            || value
                .get_exp()
                .is_some_and(|exp| exp > self.integer.cast_signed());
        let quanta = if beyond {
            None
        } else {
            (value << self.fraction).to_integer()
        };
        let quanta = quanta.and_then(|quanta| quanta.to_i64()).unwrap_or(end);
        FixedReal::new(self, Some(quanta))
    }
}

/// x/2^bits to the nearest integer, ties to even.
fn nearest_shifted(x: i128, bits: u32) -> i128 {
    let below = x >> bits;
    // Twice what is cut off, in units of the last bit that is kept.
    let rest = (x - (below << bits)) << 1;
    let up = rest > 1 << bits || (rest == 1 << bits && below & 1 == 1);
    below + i128::from(up)
}

/// numerator/denominator to the nearest integer, ties to even; denominator > 0.
fn nearest(numerator: i128, denominator: i128) -> i128 {
    let (below, rest) = (
        numerator.div_euclid(denominator),
        numerator.rem_euclid(denominator),
    );
    let up = match rest.cmp(&(denominator - rest)) {
        Ordering::Less => false,
        Ordering::Equal => below & 1 == 1,
        Ordering::Greater => true,
    };
    below + i128::from(up)
}

impl Display for Fixed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fixed { integer, fraction } = self;
        match *integer {
            MAX_INTEGER => f.pad(&format!("fixed:{fraction}")),
            _ => f.pad(&format!("fixed:{integer}.{fraction}")),
        }
    }
}

impl Format for Fixed {
    type Real = FixedReal;

    /// The bits after the point: an error of half a quantum is u = 2^−bits/2 of numbers near 1, as in a
    /// floating-point format of that many bits. Numbers below 1 have fewer significant bits, those above
    /// 1 have more, never more than `integer` of them.
    fn bits(self) -> u32 {
        self.fraction
    }

    fn int(self, n: i64) -> FixedReal {
        self.saturate(i128::from(n) << self.fraction)
    }

    fn ratio(self, q: &Rational) -> FixedReal {
        let value = Float::with_val_round(self.working_bits(), q, Round::Nearest);
        self.fit(value)
    }

    fn fraction(self, numerator: u64, denominator: u64) -> FixedReal {
        let quanta = i128::from(numerator) << self.fraction;
        match denominator {
            0 => FixedReal::new(self, None),
            _ => self.saturate(nearest(quanta, denominator.into())),
        }
    }

    fn pi(self) -> FixedReal {
        let pi = Float::with_val_round(self.working_bits(), Constant::Pi, Round::Nearest);
        self.fit(pi)
    }
}

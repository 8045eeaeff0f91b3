//! Constant powers: of integer exponents for any base, of fractional ones for bases ≥ 0.

use super::{Interval, Undefined, rounded};
use rug::float::Round;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};

/// More bits for what stands between a power and its root.
const GUARD_BITS: u32 = 32;

impl Interval {
    /// xᵉ; even powers know that x·x ≥ 0.
    ///
    /// # Errors
    /// [`Undefined`] where the base contains 0 and the exponent is ≤ 0, or where the base reaches below 0
    /// and the exponent is a fraction; certainly so where that is all there is in the base.
    pub fn pow(&self, exponent: &Rational) -> Result<Interval, Undefined> {
        if *exponent.denom() != 1 {
            return self.fractional(exponent);
        }
        let exponent = exponent.numer();
        if *exponent <= 0 {
            // 0⁰ has no value either.
            if self.is_zero() {
                return Err(Undefined::Certainly);
            }
            if self.contains_zero() {
                return Err(Undefined::Possibly);
            }
        }
        if *exponent == 0 {
            return Ok(Interval::integer(self.bits(), 1));
        }
        if exponent.is_even() {
            return Ok(self.abs().monotone_power(exponent, self.bits()));
        }
        // Odd negative powers fall from either side of 0 away from it; the others rise.
        Ok(self.monotone_power(exponent, self.bits()))
    }

    /// xᵉ for a base on which that is monotone, rising for e > 0 and falling for e < 0.
    fn monotone_power(&self, exponent: &Integer, bits: u32) -> Interval {
        let (low, high) = if *exponent > 0 {
            (&self.lower, &self.upper)
        } else {
            (&self.upper, &self.lower)
        };
        Interval::new(
            rounded(bits, low.pow(exponent), Round::Down),
            rounded(bits, high.pow(exponent), Round::Up),
        )
    }

    fn fractional(&self, exponent: &Rational) -> Result<Interval, Undefined> {
        self.check_nonnegative()?;
        if *exponent < 0 && !self.is_positive() {
            return Err(if self.is_zero() {
                Undefined::Certainly
            } else {
                Undefined::Possibly
            });
        }
        let bits = self.bits();
        let (numerator, denominator) = (exponent.numer(), exponent.denom());
        let Some(root) = denominator.to_u32() else {
            return self.by_logarithm(exponent);
        };
        if *numerator == 1 {
            let mut result = self.clone();
            result.lower.root_round(root, Round::Down);
            result.upper.root_round(root, Round::Up);
            return Ok(result);
        }
        let more = bits.saturating_add(GUARD_BITS);
        let mut power = self.monotone_power(numerator, more);
        power.lower.root_round(root, Round::Down);
        power.upper.root_round(root, Round::Up);
        Ok(power.to_bits(bits))
    }

    /// e^(exponent·ln x), for exponents that no root can be taken with.
    fn by_logarithm(&self, exponent: &Rational) -> Result<Interval, Undefined> {
        if self.is_zero() {
            return Ok(self.clone());
        }
        let bits = self.bits();
        let exponent = Interval::point(bits.saturating_add(GUARD_BITS), exponent);
        if self.is_positive() {
            return Ok((&self.ln()? * &exponent).exp().to_bits(bits));
        }
        // From 0 on, where the exponent is positive.
        let upper = Interval::exactly(&self.upper);
        let upper = (&upper.ln()? * &exponent).exp().to_bits(bits).upper;
        Ok(Interval::new(Float::new(bits), upper))
    }

    /// The same at another number of bits.
    #[must_use]
    pub fn to_bits(&self, bits: u32) -> Interval {
        Interval::new(
            rounded(bits, &self.lower, Round::Down),
            rounded(bits, &self.upper, Round::Up),
        )
    }
}

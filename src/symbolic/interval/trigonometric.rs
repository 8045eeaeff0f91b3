//! Sine, cosine and tangent: their extrema and poles stand at multiples of π/2.

use super::elementary::Rounded;
use super::{Interval, Undefined, greatest, least, rounded};
use rug::float::Round;
use rug::ops::RemRounding;
use rug::{Float, Integer};

/// Arguments of more bits before the point are not reduced: their sine is anything from −1 to 1.
const MAX_EXPONENT: i32 = 4096;

/// The multiples n·π/2 that may be in an interval, from the first n to the last.
struct Quarters {
    first: Integer,
    last: Integer,
}

impl Quarters {
    /// Of x, or nothing where x is too large to tell.
    fn of(x: &Interval) -> Option<Quarters> {
        let mut before_point = 0;
        for bound in [&x.lower, &x.upper] {
            if !bound.is_finite() {
                return None;
            }
            before_point = before_point.max(bound.get_exp().unwrap_or(0));
        }
        if before_point > MAX_EXPONENT {
            return None;
        }
        let bits = x.bits().saturating_add(before_point.unsigned_abs()) + 16;
        let quarter = Interval::pi(bits)
            .divide(&Interval::integer(bits, 2))
            .ok()?;
        let turns = x.divide(&quarter).ok()?;
        let (first, _) = turns.lower.to_integer_round(Round::Up)?;
        let (last, _) = turns.upper.to_integer_round(Round::Down)?;
        Some(Quarters { first, last })
    }

    /// n where all of the interval is between (n − 1)·π/2 and n·π/2.
    fn between(&self) -> Option<u32> {
        let n = Integer::from(&self.first).rem_euc(4_u32);
        (self.first > self.last).then(|| n.to_u32()).flatten()
    }

    /// Whether one of them is `remainder` more than a multiple of `modulus`.
    fn contains(&self, remainder: u32, modulus: u32) -> bool {
        let distance = Integer::from(remainder - &self.first).rem_euc(modulus);
        &self.first + distance <= self.last
    }
}

impl Interval {
    /// The sine.
    #[must_use]
    pub fn sin(&self) -> Interval {
        self.wave(Float::sin_round, 1, 3)
    }

    /// The cosine.
    #[must_use]
    pub fn cos(&self) -> Interval {
        self.wave(Float::cos_round, 0, 2)
    }

    /// A function that is 1 at `top`·π/2, −1 at `bottom`·π/2 and monotone between.
    fn wave(&self, function: Rounded, top: u32, bottom: u32) -> Interval {
        let bits = self.bits();
        let one = || Float::with_val(bits, 1);
        let Some(quarters) = Quarters::of(self) else {
            return Interval::new(-one(), one());
        };
        let at = |bound: &Float, round| {
            let mut value = rounded(bits, bound, round);
            function(&mut value, round);
            value
        };
        if let Some(quarter) = quarters.between() {
            // It rises between its bottom and its top.
            let rises = (quarter + 3 - bottom) % 4 < 2;
            let (low, high) = if rises {
                (&self.lower, &self.upper)
            } else {
                (&self.upper, &self.lower)
            };
            return Interval::new(at(low, Round::Down), at(high, Round::Up));
        }
        let lower = if quarters.contains(bottom, 4) {
            -one()
        } else {
            least(&at(&self.lower, Round::Down), &at(&self.upper, Round::Down))
        };
        let upper = if quarters.contains(top, 4) {
            one()
        } else {
            greatest(&at(&self.lower, Round::Up), &at(&self.upper, Round::Up))
        };
        Interval::new(lower, upper)
    }

    /// The tangent, where no pole is in the interval.
    ///
    /// # Errors
    /// [`Undefined`] where a pole may be in the interval.
    pub fn tan(&self) -> Result<Interval, Undefined> {
        match Quarters::of(self) {
            Some(quarters) if !quarters.contains(1, 2) => Ok(self.increasing(Float::tan_round)),
            _ => Err(Undefined::Possibly),
        }
    }
}

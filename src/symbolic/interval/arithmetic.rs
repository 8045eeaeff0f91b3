//! Sums, products, quotients, and the lesser and the greater of two.

use super::{Interval, Undefined, greatest, least, rounded};
use rug::Float;
use rug::float::Round;
use std::ops;

impl ops::Neg for &Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval::new(-self.upper.clone(), -self.lower.clone())
    }
}

impl ops::Add for &Interval {
    type Output = Interval;

    fn add(self, other: &Interval) -> Interval {
        let bits = self.bits().max(other.bits());
        Interval::new(
            rounded(bits, &self.lower + &other.lower, Round::Down),
            rounded(bits, &self.upper + &other.upper, Round::Up),
        )
    }
}

impl ops::Sub for &Interval {
    type Output = Interval;

    fn sub(self, other: &Interval) -> Interval {
        let bits = self.bits().max(other.bits());
        Interval::new(
            rounded(bits, &self.lower - &other.upper, Round::Down),
            rounded(bits, &self.upper - &other.lower, Round::Up),
        )
    }
}

impl ops::Mul for &Interval {
    type Output = Interval;

    fn mul(self, other: &Interval) -> Interval {
        let bits = self.bits().max(other.bits());
        let times = |x: &Float, y: &Float, round| {
            // A bound that is ∞ stands for finite numbers, however large: 0 times them is 0.
            if x.is_zero() || y.is_zero() {
                Float::new(bits)
            } else {
                rounded(bits, x * y, round)
            }
        };
        // Which bounds give the least and which the greatest product follows from the signs.
        let (a, b) = ((&self.lower, &self.upper), (&other.lower, &other.upper));
        let ((p, q), (r, s)) = match (sign(self), sign(other)) {
            (Sign::Plus, Sign::Plus) => ((a.0, b.0), (a.1, b.1)),
            (Sign::Plus, Sign::Both) => ((a.1, b.0), (a.1, b.1)),
            (Sign::Plus, Sign::Minus) => ((a.1, b.0), (a.0, b.1)),
            (Sign::Both, Sign::Plus) => ((a.0, b.1), (a.1, b.1)),
            (Sign::Both, Sign::Minus) => ((a.1, b.0), (a.0, b.0)),
            (Sign::Minus, Sign::Plus) => ((a.0, b.1), (a.1, b.0)),
            (Sign::Minus, Sign::Both) => ((a.0, b.1), (a.0, b.0)),
            (Sign::Minus, Sign::Minus) => ((a.1, b.1), (a.0, b.0)),
            (Sign::Both, Sign::Both) => {
                let lower = [(a.0, b.1), (a.1, b.0)].map(|(x, y)| times(x, y, Round::Down));
                let upper = [(a.0, b.0), (a.1, b.1)].map(|(x, y)| times(x, y, Round::Up));
                return Interval::new(least(&lower[0], &lower[1]), greatest(&upper[0], &upper[1]));
            }
        };
        Interval::new(times(p, q, Round::Down), times(r, s, Round::Up))
    }
}

enum Sign {
    Minus,
    Both,
    Plus,
}

fn sign(x: &Interval) -> Sign {
    if x.is_nonnegative() {
        Sign::Plus
    } else if x.is_nonpositive() {
        Sign::Minus
    } else {
        Sign::Both
    }
}

impl Interval {
    /// The quotient, where the divisor does not contain 0.
    ///
    /// # Errors
    /// [`Undefined`] where the divisor contains 0, certainly so where it is 0.
    pub fn divide(&self, divisor: &Interval) -> Result<Interval, Undefined> {
        if divisor.is_zero() {
            return Err(Undefined::Certainly);
        }
        if divisor.contains_zero() {
            return Err(Undefined::Possibly);
        }
        if divisor.is_negative() {
            return (-self).divide(&-divisor);
        }
        let bits = self.bits().max(divisor.bits());
        let (near, far) = (&divisor.lower, &divisor.upper);
        let below = if self.lower >= 0 { far } else { near };
        let above = if self.upper >= 0 { near } else { far };
        Ok(Interval::new(
            rounded(bits, &self.lower / below, Round::Down),
            rounded(bits, &self.upper / above, Round::Up),
        ))
    }

    /// |x|.
    #[must_use]
    pub fn abs(&self) -> Interval {
        match sign(self) {
            Sign::Plus => self.clone(),
            Sign::Minus => -self,
            Sign::Both => Interval::new(
                Float::new(self.bits()),
                greatest(&-self.lower.clone(), &self.upper),
            ),
        }
    }

    /// The lesser of the two.
    #[must_use]
    pub fn min(&self, other: &Interval) -> Interval {
        Interval::new(
            least(&self.lower, &other.lower),
            least(&self.upper, &other.upper),
        )
    }

    /// The greater of the two.
    #[must_use]
    pub fn max(&self, other: &Interval) -> Interval {
        Interval::new(
            greatest(&self.lower, &other.lower),
            greatest(&self.upper, &other.upper),
        )
    }
}

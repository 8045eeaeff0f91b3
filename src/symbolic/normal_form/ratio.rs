//! Exact rational numbers, fast where they are small.

use rug::{Integer, Rational};
use std::borrow::Cow;
use std::cmp::Ordering;

/// An exact rational number in lowest terms.
///
/// `Large` only where the numerator or the denominator doesn't fit: so equal numbers are equal values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Ratio {
    /// Numerator and denominator, which is positive.
    Small(i64, i64),
    /// Anything else.
    Large(Box<Rational>),
}

impl Ratio {
    pub(super) const ZERO: Ratio = Ratio::Small(0, 1);
    pub(super) const ONE: Ratio = Ratio::Small(1, 1);

    /// The quotient of two numbers below 2¹²⁷ in magnitude, the second of them positive.
    fn reduced(n: i128, d: i128) -> Ratio {
        let (n, d) = match i128::try_from(gcd(n.unsigned_abs(), d.unsigned_abs())) {
            Ok(g) if g > 1 => (n / g, d / g),
            _ => (n, d),
        };
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) => Ratio::Small(n, d),
            _ => Ratio::Large(Box::new(Rational::from((
                Integer::from(n),
                Integer::from(d),
            )))),
        }
    }

    /// The same number.
    #[must_use]
    pub fn to_rational(&self) -> Rational {
        self.as_rational().into_owned()
    }

    fn as_rational(&self) -> Cow<'_, Rational> {
        match self {
            Ratio::Small(n, d) => Cow::Owned(Rational::from((*n, *d))),
            Ratio::Large(q) => Cow::Borrowed(q),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        *self == Ratio::ZERO
    }

    pub(super) fn is_one(&self) -> bool {
        *self == Ratio::ONE
    }

    pub(super) fn is_integer(&self) -> bool {
        match self {
            Ratio::Small(_, d) => *d == 1,
            Ratio::Large(q) => q.is_integer(),
        }
    }

    /// Whether it is an even integer.
    pub(super) fn is_even(&self) -> bool {
        match self {
            Ratio::Small(n, d) => *d == 1 && n % 2 == 0,
            Ratio::Large(q) => q.is_integer() && q.numer().is_even(),
        }
    }

    /// How it compares with 0.
    pub(super) fn sign(&self) -> Ordering {
        match self {
            Ratio::Small(n, _) => n.cmp(&0),
            Ratio::Large(q) => q.cmp0(),
        }
    }

    pub(super) fn is_negative(&self) -> bool {
        self.sign() == Ordering::Less
    }

    pub(super) fn is_positive(&self) -> bool {
        self.sign() == Ordering::Greater
    }

    /// The integer that it is, if it is a small one.
    pub(super) fn to_integer(&self) -> Option<i64> {
        match self {
            Ratio::Small(n, 1) => Some(*n),
            _ => None,
        }
    }

    /// Words of storage beyond the small ones, for a budget of time.
    pub(super) fn words(&self) -> u64 {
        match self {
            Ratio::Small(..) => 0,
            Ratio::Large(q) => {
                let bits = q
                    .numer()
                    .significant_bits()
                    .max(q.denom().significant_bits());
                u64::from(bits) / 64 + 1
            }
        }
    }

    pub(super) fn add(&self, other: &Ratio) -> Ratio {
        match (self, other) {
            (Ratio::Small(a, b), Ratio::Small(c, d)) => {
                if *b == 1
                    && *d == 1
                    && let Some(sum) = a.checked_add(*c)
                {
                    return Ratio::Small(sum, 1);
                }
                // Each product is below 2¹²⁶ in magnitude.
                let (a, b, c, d) = (
                    i128::from(*a),
                    i128::from(*b),
                    i128::from(*c),
                    i128::from(*d),
                );
                Ratio::reduced(a * d + c * b, b * d)
            }
            _ => Rational::from(&*self.as_rational() + &*other.as_rational()).into(),
        }
    }

    pub(super) fn mul(&self, other: &Ratio) -> Ratio {
        match (self, other) {
            (Ratio::Small(a, b), Ratio::Small(c, d)) => {
                if *b == 1
                    && *d == 1
                    && let Some(product) = a.checked_mul(*c)
                {
                    return Ratio::Small(product, 1);
                }
                Ratio::reduced(
                    i128::from(*a) * i128::from(*c),
                    i128::from(*b) * i128::from(*d),
                )
            }
            _ => Rational::from(&*self.as_rational() * &*other.as_rational()).into(),
        }
    }

    pub(super) fn neg(&self) -> Ratio {
        match self {
            Ratio::Small(n, d) if *n != i64::MIN => Ratio::Small(-n, *d),
            _ => (-self.to_rational()).into(),
        }
    }

    pub(super) fn sub(&self, other: &Ratio) -> Ratio {
        self.add(&other.neg())
    }

    pub(super) fn abs(&self) -> Ratio {
        if self.is_negative() {
            self.neg()
        } else {
            self.clone()
        }
    }

    /// 1 / `self`, unless it is 0.
    pub(super) fn recip(&self) -> Option<Ratio> {
        match self {
            Ratio::Small(0, _) => None,
            Ratio::Small(n, d) if *n > 0 => Some(Ratio::Small(*d, *n)),
            _ => Some(self.to_rational().recip().into()),
        }
    }

    /// The greatest integer not above it.
    pub(super) fn floor(&self) -> Ratio {
        match self {
            Ratio::Small(n, d) => Ratio::Small(n.div_euclid(*d), 1),
            Ratio::Large(q) => (**q).clone().floor().into(),
        }
    }
}

impl From<i64> for Ratio {
    fn from(n: i64) -> Ratio {
        Ratio::Small(n, 1)
    }
}

impl From<Rational> for Ratio {
    fn from(q: Rational) -> Ratio {
        match (q.numer().to_i64(), q.denom().to_i64()) {
            (Some(n), Some(d)) => Ratio::Small(n, d),
            _ => Ratio::Large(Box::new(q)),
        }
    }
}

impl Ord for Ratio {
    fn cmp(&self, other: &Ratio) -> Ordering {
        match (self, other) {
            (Ratio::Small(a, b), Ratio::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            _ => self.as_rational().cmp(&other.as_rational()),
        }
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Ratio) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The greatest common divisor, in words as long as both fit.
fn gcd(mut a: u128, mut b: u128) -> u128 {
    loop {
        if let (Ok(mut a), Ok(mut b)) = (u64::try_from(a), u64::try_from(b)) {
            while b != 0 {
                (a, b) = (b, a % b);
            }
            return u128::from(a);
        }
        if b == 0 {
            return a;
        }
        (a, b) = (b, a % b);
    }
}

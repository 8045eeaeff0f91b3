//! Coefficients: complex numbers of rational parts, ℚ(i).

use super::ratio::Ratio;
use std::cmp::Ordering;

/// re + i·im.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Coefficient {
    /// The real part.
    pub re: Ratio,
    /// The imaginary part.
    pub im: Ratio,
}

impl Coefficient {
    pub(super) const ONE: Coefficient = Coefficient {
        re: Ratio::ONE,
        im: Ratio::ZERO,
    };
    pub(super) const I: Coefficient = Coefficient {
        re: Ratio::ZERO,
        im: Ratio::ONE,
    };

    pub(super) fn real(re: Ratio) -> Coefficient {
        Coefficient {
            re,
            im: Ratio::ZERO,
        }
    }

    pub(super) fn imaginary(im: Ratio) -> Coefficient {
        Coefficient {
            re: Ratio::ZERO,
            im,
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    pub(super) fn is_real(&self) -> bool {
        self.im.is_zero()
    }

    /// Real and greater than 0.
    pub(super) fn is_positive(&self) -> bool {
        self.is_real() && self.re.is_positive()
    }

    /// The order by real part, then by imaginary part, against 0: it is kept by sums.
    pub(super) fn sign(&self) -> Ordering {
        self.re.sign().then(self.im.sign())
    }

    /// Words of storage beyond small numbers.
    pub(super) fn words(&self) -> u64 {
        self.re.words() + self.im.words()
    }

    pub(super) fn add(&self, other: &Coefficient) -> Coefficient {
        Coefficient {
            re: self.re.add(&other.re),
            im: self.im.add(&other.im),
        }
    }

    pub(super) fn mul(&self, other: &Coefficient) -> Coefficient {
        match (self.is_real(), other.is_real()) {
            (true, true) => Coefficient::real(self.re.mul(&other.re)),
            (true, false) => other.scale(&self.re),
            (false, true) => self.scale(&other.re),
            (false, false) => Coefficient {
                re: self.re.mul(&other.re).sub(&self.im.mul(&other.im)),
                im: self.re.mul(&other.im).add(&self.im.mul(&other.re)),
            },
        }
    }

    pub(super) fn scale(&self, factor: &Ratio) -> Coefficient {
        Coefficient {
            re: self.re.mul(factor),
            im: self.im.mul(factor),
        }
    }

    pub(super) fn neg(&self) -> Coefficient {
        Coefficient {
            re: self.re.neg(),
            im: self.im.neg(),
        }
    }

    pub(super) fn conjugate(&self) -> Coefficient {
        Coefficient {
            re: self.re.clone(),
            im: self.im.neg(),
        }
    }

    /// 1 / `self` = conjugate / |self|², unless it is 0.
    pub(super) fn recip(&self) -> Option<Coefficient> {
        let norm = self.re.mul(&self.re).add(&self.im.mul(&self.im));
        Some(self.conjugate().scale(&norm.recip()?))
    }
}

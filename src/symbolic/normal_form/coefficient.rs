//! Numbers p + qi with rational p and q.

use rug::Rational;

/// A number of ℚ(i).
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Coefficient {
    pub(super) re: Rational,
    pub(super) im: Rational,
}

impl Coefficient {
    pub(super) fn real(q: impl Into<Rational>) -> Self {
        Coefficient {
            re: q.into(),
            im: Rational::new(),
        }
    }

    pub(super) fn imaginary(q: impl Into<Rational>) -> Self {
        Coefficient {
            re: Rational::new(),
            im: q.into(),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.re == 0 && self.im == 0
    }

    pub(super) fn is_one(&self) -> bool {
        self.re == 1 && self.im == 0
    }

    /// The number, where it is real.
    pub(super) fn as_real(&self) -> Option<&Rational> {
        (self.im == 0).then_some(&self.re)
    }

    /// One of x and −x for each x other than 0.
    pub(super) fn is_negative(&self) -> bool {
        self.re < 0 || self.re == 0 && self.im < 0
    }

    pub(super) fn add(&mut self, other: &Coefficient) {
        self.re += &other.re;
        self.im += &other.im;
    }

    pub(super) fn negative(&self) -> Coefficient {
        Coefficient {
            re: Rational::from(-&self.re),
            im: Rational::from(-&self.im),
        }
    }

    pub(super) fn times(&self, other: &Coefficient) -> Coefficient {
        // Most coefficients are real.
        if self.im == 0 && other.im == 0 {
            return Coefficient::real(Rational::from(&self.re * &other.re));
        }
        let re = Rational::from(&self.re * &other.re) - Rational::from(&self.im * &other.im);
        let im = Rational::from(&self.re * &other.im) + Rational::from(&self.im * &other.re);
        Coefficient { re, im }
    }

    /// 1/x; x must not be 0.
    pub(super) fn inverse(&self) -> Coefficient {
        let norm = Rational::from(self.re.square_ref()) + Rational::from(self.im.square_ref());
        Coefficient {
            re: Rational::from(&self.re / &norm),
            im: -Rational::from(&self.im / &norm),
        }
    }
}

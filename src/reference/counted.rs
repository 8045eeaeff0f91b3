//! MPFR numbers that count the transcendental functions taken of them.

use crate::real::{Format, Mpfr, MpfrReal, Real};
use rug::{Float, Rational};
use std::cell::Cell;
use std::fmt::{self, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

thread_local! {
    // A number has no room for a reference to a counter that outlives it.
    static CALLS: Cell<u64> = const { Cell::new(0) };
}

/// What `work` gives, and how many transcendental functions of [`Counted`] numbers it took on this thread.
/// A sine and cosine of the same number count as one, a square root as none.
pub(super) fn counting<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = CALLS.get();
    let result = work();
    (result, CALLS.get().wrapping_sub(before))
}

/// MPFR with so many bits, counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CountedFormat(pub(super) Mpfr);

/// A number of a [`CountedFormat`].
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(super) struct Counted(MpfrReal);

impl From<Float> for Counted {
    fn from(x: Float) -> Self {
        Counted(x.into())
    }
}

impl From<Counted> for Float {
    fn from(x: Counted) -> Self {
        x.0.into()
    }
}

impl Display for CountedFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.0, f)
    }
}

impl Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.0, f)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Counted(-self.0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident) => {
        impl<'a> $trait<&'a Counted> for Counted {
            type Output = Counted;
            fn $method(self, other: &'a Counted) -> Counted {
                Counted($trait::$method(self.0, &other.0))
            }
        }
        impl<'a> $assign_trait<&'a Counted> for Counted {
            fn $assign_method(&mut self, other: &'a Counted) {
                $assign_trait::$assign_method(&mut self.0, &other.0);
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div, DivAssign, div_assign);

impl Format for CountedFormat {
    type Real = Counted;

    fn bits(self) -> u32 {
        self.0.bits
    }
    fn int(self, n: i64) -> Counted {
        Counted(self.0.int(n))
    }
    fn ratio(self, q: &Rational) -> Counted {
        Counted(self.0.ratio(q))
    }
    fn pi(self) -> Counted {
        Counted(self.0.pi())
    }
}

macro_rules! counted {
    ($($function:ident)*) => {
        $(fn $function(self) -> Self {
            CALLS.set(CALLS.get().wrapping_add(1));
            Counted(Real::$function(self.0))
        })*
    };
}

impl Real for Counted {
    type Format = CountedFormat;

    counted!(exp exp_m1 ln ln_1p tan sinh cosh tanh atan erf);

    fn sin_cos(self) -> (Self, Self) {
        CALLS.set(CALLS.get().wrapping_add(1));
        let (sin, cos) = self.0.sin_cos();
        (Counted(sin), Counted(cos))
    }
    fn format(&self) -> CountedFormat {
        CountedFormat(self.0.format())
    }
    fn set(&mut self, from: &Self) {
        self.0.set(&from.0);
    }
    fn abs(self) -> Self {
        Counted(self.0.abs())
    }
    fn sqrt(self) -> Self {
        Counted(self.0.sqrt())
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    fn to_rational(&self) -> Option<Rational> {
        self.0.to_rational()
    }
    fn log2_abs(&self) -> f64 {
        self.0.log2_abs()
    }
}

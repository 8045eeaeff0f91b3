//! + − × ÷ of watched numbers.

use super::super::range::Range;
use super::Events;
use super::number::{Observed, after, quotient};
use crate::real::Real;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

impl<F: Range> Neg for Observed<F> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Observed {
            value: -self.value,
            ..self
        }
    }
}

impl<'a, F: Range> AddAssign<&'a Observed<F>> for Observed<F> {
    #[inline]
    fn add_assign(&mut self, other: &'a Self) {
        let old = self.value.clone();
        self.value += &other.value;
        self.events |= other.events;
        // Of most sums there is nothing to say but what their terms had lost.
        let is_term = self.value == old || self.value == other.value;
        if is_term || !F::is_ordinary(&self.value) {
            self.see_sum(&old, other);
        } else if self.lost > 0.0 || other.lost > 0.0 {
            self.lost = self.lost_by_both(&old, other);
        }
    }
}

impl<F: Range> Observed<F> {
    /// What became of a sum, which is this number by now, that is one of its terms or no ordinary number.
    fn see_sum(&mut self, old: &F::Real, other: &Self) {
        let finite = old.is_finite() && other.value.is_finite();
        // Sums of small numbers are exact.
        self.events |= after::<F>(&self.value, finite, true);
        if !finite || F::is_zero(&other.value) {
            return;
        }
        if F::is_zero(old) {
            self.lost = other.lost;
            return;
        }
        if self.lost > 0.0 || other.lost > 0.0 {
            self.lost = self.lost_by_both(old, other);
        }
        if self.value == *old {
            self.lost += quotient::<F>(&other.value, &self.value);
        } else if self.value == other.value {
            self.lost += quotient::<F>(old, &self.value);
        }
    }

    /// What two summands had lost, relative to their sum, which is this number by now.
    fn lost_by_both(&mut self, old: &F::Real, other: &Self) -> f32 {
        if F::is_negative(old) == F::is_negative(&other.value) {
            return self.lost.max(other.lost);
        }
        if F::is_zero(&self.value) {
            self.events |= Events::VANISHED;
            return 0.0;
        }
        let own = self.lost * quotient::<F>(old, &self.value);
        own + other.lost * quotient::<F>(&other.value, &self.value)
    }
}

impl<'a, F: Range> SubAssign<&'a Observed<F>> for Observed<F> {
    #[inline]
    fn sub_assign(&mut self, other: &'a Self) {
        // The same number, bit for bit, in every format.
        *self += &(-other.clone());
    }
}

impl<'a, F: Range> MulAssign<&'a Observed<F>> for Observed<F> {
    #[inline]
    fn mul_assign(&mut self, other: &'a Self) {
        let finite = self.value.is_finite() && other.value.is_finite();
        let zero = F::is_zero(&self.value) || F::is_zero(&other.value);
        self.value *= &other.value;
        self.lost += other.lost;
        self.events |= other.events;
        self.events |= after::<F>(&self.value, finite, zero);
    }
}

impl<'a, F: Range> DivAssign<&'a Observed<F>> for Observed<F> {
    #[inline]
    fn div_assign(&mut self, other: &'a Self) {
        let finite = self.value.is_finite() && other.value.is_finite();
        let zero = F::is_zero(&self.value);
        let by_zero = F::is_zero(&other.value);
        self.value /= &other.value;
        self.lost += other.lost;
        self.events |= other.events;
        self.events |= match (zero, by_zero) {
            (true, true) => Events::INVALID,
            (false, true) => Events::INFINITE,
            (_, false) => after::<F>(&self.value, finite, zero),
        };
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign:ident) => {
        impl<'a, F: Range> $trait<&'a Observed<F>> for Observed<F> {
            type Output = Observed<F>;
            #[inline]
            fn $method(mut self, other: &'a Observed<F>) -> Observed<F> {
                self.$assign(other);
                self
            }
        }
    };
}
operator!(Add, add, add_assign);
operator!(Sub, sub, sub_assign);
operator!(Mul, mul, mul_assign);
operator!(Div, div, div_assign);

//! The lanes' format, one number at a time and in rows.

use super::{LaneFloat, Lanes, MOST, Width, WithLanes};
use crate::real::{Format, Native, Real};
use rug::{Float, Rational};
use std::fmt::{self, Debug, Display};
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// The format of lanes of `T`; a value of no size.
pub struct LaneFormat<T>(PhantomData<fn() -> T>);

impl<T> LaneFormat<T> {
    /// The format.
    #[must_use]
    pub const fn new() -> Self {
        LaneFormat(PhantomData)
    }
}

impl<T> Default for LaneFormat<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Clone for LaneFormat<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for LaneFormat<T> {}

impl<T> PartialEq for LaneFormat<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> Debug for LaneFormat<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(self, f)
    }
}

impl<T> Display for LaneFormat<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-lanes", Native::<T>::new())
    }
}

/// A number of the lanes' format: of `T`, with functions that have the same bits in every width.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct LaneReal<T>(pub T);

impl<T: LaneFloat> Format for LaneFormat<T> {
    type Real = LaneReal<T>;

    const IN_LANES: bool = true;

    #[inline]
    fn bits(self) -> u32 {
        Native::<T>::new().bits()
    }
    #[inline]
    fn int(self, n: i64) -> LaneReal<T> {
        LaneReal(Native::new().int(n))
    }
    fn ratio(self, q: &Rational) -> LaneReal<T> {
        LaneReal(Native::new().ratio(q))
    }
    #[inline]
    fn fraction(self, numerator: u64, denominator: u64) -> LaneReal<T> {
        LaneReal(Native::new().fraction(numerator, denominator))
    }
    #[inline]
    fn binary64(self, x: f64) -> LaneReal<T> {
        LaneReal(Native::new().binary64(x))
    }
    #[inline]
    fn nearest(self, high: f64, low: f64) -> Option<LaneReal<T>> {
        Native::new().nearest(high, low).map(LaneReal)
    }
    fn pi(self) -> LaneReal<T> {
        LaneReal(Native::new().pi())
    }
}

impl<T: Display> Display for LaneReal<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.0, f)
    }
}

impl<T: LaneFloat> Neg for LaneReal<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        LaneReal(-self.0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident) => {
        impl<'a, T: LaneFloat> $trait<&'a LaneReal<T>> for LaneReal<T> {
            type Output = LaneReal<T>;
            #[inline]
            fn $method(mut self, other: &'a LaneReal<T>) -> LaneReal<T> {
                $assign_trait::$assign_method(&mut self.0, &other.0);
                self
            }
        }
        impl<'a, T: LaneFloat> $assign_trait<&'a LaneReal<T>> for LaneReal<T> {
            #[inline]
            fn $assign_method(&mut self, other: &'a LaneReal<T>) {
                $assign_trait::$assign_method(&mut self.0, &other.0);
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div, DivAssign, div_assign);

/// Functions that are the native format's.
macro_rules! native {
    ($($function:ident),*) => {$(
        #[inline]
        fn $function(self) -> Self {
            LaneReal(Real::$function(self.0))
        }
    )*};
}

impl<T: LaneFloat> Real for LaneReal<T> {
    type Format = LaneFormat<T>;

    #[inline]
    fn format(&self) -> LaneFormat<T> {
        LaneFormat::new()
    }
    #[inline]
    fn set(&mut self, from: &Self) {
        *self = *from;
    }
    native! { abs, sqrt, ln, ln_1p, tan, sinh, cosh, tanh, atan, erf }
    #[inline]
    fn exp(self) -> Self {
        LaneReal(Lanes::exp(self.0))
    }
    #[inline]
    fn exp_m1(self) -> Self {
        LaneReal(Lanes::exp_m1(self.0))
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Lanes::sin_cos(self.0);
        (LaneReal(sin), LaneReal(cos))
    }
    fn exp_row(row: &[Self], exponentials: &mut [Self]) {
        of_row(row, exponentials, &mut [], Function::Exp);
    }
    fn exp_m1_row(row: &[Self], exponentials: &mut [Self]) {
        of_row(row, exponentials, &mut [], Function::ExpM1);
    }
    fn sin_cos_row(row: &[Self], sines: &mut [Self], cosines: &mut [Self]) {
        of_row(row, sines, cosines, Function::SinCos);
    }
    #[inline]
    fn is_finite(&self) -> bool {
        Real::is_finite(&self.0)
    }
    fn to_rational(&self) -> Option<Rational> {
        self.0.to_rational()
    }
    fn to_float(&self) -> Float {
        Real::to_float(&self.0)
    }
    fn to_float_of(&self, bits: u32) -> Float {
        self.0.to_float_of(bits)
    }
    fn log2_abs(&self) -> f64 {
        self.0.log2_abs()
    }
}

/// What is done with a row.
#[derive(Clone, Copy)]
enum Function {
    Exp,
    ExpM1,
    SinCos,
}

/// Numbers that are copied together, so that they are there to be loaded as vectors.
const BLOCK: usize = 4 * MOST;

/// A function of each of a row, by the width in use; the second result is written where there is one.
fn of_row<T: LaneFloat>(
    row: &[LaneReal<T>],
    first: &mut [LaneReal<T>],
    second: &mut [LaneReal<T>],
    function: Function,
) {
    let width = Width::current();
    let mut rest = second;
    for (row, first) in row.chunks(BLOCK).zip(first.chunks_mut(BLOCK)) {
        let mut block = Block {
            x: [T::ZERO; BLOCK],
            y: [T::ZERO; BLOCK],
            z: [T::ZERO; BLOCK],
        };
        for (x, number) in block.x.iter_mut().zip(row) {
            *x = number.0;
        }
        width.with(OfBlock {
            block: &mut block,
            count: row.len(),
            function,
        });
        for (number, y) in first.iter_mut().zip(block.y) {
            *number = LaneReal(y);
        }
        let (second, behind) = rest.split_at_mut(rest.len().min(first.len()));
        for (number, z) in second.iter_mut().zip(block.z) {
            *number = LaneReal(z);
        }
        rest = behind;
    }
}

struct Block<T> {
    x: [T; BLOCK],
    y: [T; BLOCK],
    z: [T; BLOCK],
}

struct OfBlock<'b, T> {
    block: &'b mut Block<T>,
    count: usize,
    function: Function,
}

impl<T: LaneFloat> WithLanes<T> for OfBlock<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        let Block { x, y, z } = self.block;
        let mut from = 0;
        // The last of them may have zeros behind the row's end.
        while from < self.count {
            let to = from + L::WIDTH;
            let x = zero.load(&x[from..to]);
            match self.function {
                Function::Exp => x.exp().store(&mut y[from..to]),
                Function::ExpM1 => x.exp_m1().store(&mut y[from..to]),
                Function::SinCos => {
                    let (sin, cos) = x.sin_cos();
                    sin.store(&mut y[from..to]);
                    cos.store(&mut z[from..to]);
                }
            }
            from = to;
        }
    }
}

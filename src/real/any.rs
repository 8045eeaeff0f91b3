//! Numbers of a format that is known only at run time: what is given these is compiled once, whatever the format.

use super::lanes::{LaneFormat, LaneReal};
use super::{FixedReal, Format, FormatName, IeeeReal, Mpfr, MpfrReal, Native, Real};
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

#[cfg(feature = "half")]
type Binary16 = half::f16;
#[cfg(feature = "half")]
const BINARY16: Native<half::f16> = Native::new();
#[cfg(feature = "half")]
type Bfloat16 = half::bf16;
#[cfg(feature = "half")]
const BFLOAT16: Native<half::bf16> = Native::new();

#[cfg(not(feature = "half"))]
type Binary16 = IeeeReal;
#[cfg(not(feature = "half"))]
const BINARY16: super::Ieee = super::Ieee::BINARY16;
#[cfg(not(feature = "half"))]
type Bfloat16 = IeeeReal;
#[cfg(not(feature = "half"))]
const BFLOAT16: super::Ieee = super::Ieee::BFLOAT16;

/// A number of the format that a [`FormatName`] names, with the bits of that format's own numbers.
///
/// Numbers of two kinds of format do not meet in a run; where they do, the right one is first rounded to the format
/// of the left one, and what is not finite is NaN there. Of two emulated formats it is as with numbers of MPFR.
#[derive(Clone, Debug)]
pub struct AnyReal(Kind);

/// The kind of format, and the number.
#[derive(Clone, Debug)]
enum Kind {
    F16(Binary16),
    Bf16(Bfloat16),
    F32(f32),
    F64(f64),
    F32Lanes(LaneReal<f32>),
    F64Lanes(LaneReal<f64>),
    Ieee(IeeeReal),
    Fixed(FixedReal),
    Mpfr(MpfrReal),
}

/// What `$result` makes of the number, of whatever kind it is.
macro_rules! of_number {
    ($number:expr, $x:pat => $result:expr) => {
        match $number {
            Kind::F16($x) => $result,
            Kind::Bf16($x) => $result,
            Kind::F32($x) => $result,
            Kind::F64($x) => $result,
            Kind::F32Lanes($x) => $result,
            Kind::F64Lanes($x) => $result,
            Kind::Ieee($x) => $result,
            Kind::Fixed($x) => $result,
            Kind::Mpfr($x) => $result,
        }
    };
}

/// The number of the format that `$result` makes.
macro_rules! make {
    ($name:expr, $format:ident => $result:expr) => {
        AnyReal(match $name {
            FormatName::F16 => {
                let $format = BINARY16;
                Kind::F16($result)
            }
            FormatName::Bf16 => {
                let $format = BFLOAT16;
                Kind::Bf16($result)
            }
            FormatName::F32 => {
                let $format = Native::<f32>::new();
                Kind::F32($result)
            }
            FormatName::F64 => {
                let $format = Native::<f64>::new();
                Kind::F64($result)
            }
            FormatName::F32Lanes => {
                let $format = LaneFormat::<f32>::new();
                Kind::F32Lanes($result)
            }
            FormatName::F64Lanes => {
                let $format = LaneFormat::<f64>::new();
                Kind::F64Lanes($result)
            }
            FormatName::Ieee($format) => Kind::Ieee($result),
            FormatName::Fixed($format) => Kind::Fixed($result),
            FormatName::Mpfr(bits) => {
                let $format = Mpfr { bits };
                Kind::Mpfr($result)
            }
        })
    };
}

/// The number of the same format that `$result` makes of a number.
macro_rules! map {
    ($number:expr, $x:ident => $result:expr) => {
        AnyReal(match $number {
            Kind::F16($x) => Kind::F16($result),
            Kind::Bf16($x) => Kind::Bf16($result),
            Kind::F32($x) => Kind::F32($result),
            Kind::F64($x) => Kind::F64($result),
            Kind::F32Lanes($x) => Kind::F32Lanes($result),
            Kind::F64Lanes($x) => Kind::F64Lanes($result),
            Kind::Ieee($x) => Kind::Ieee($result),
            Kind::Fixed($x) => Kind::Fixed($result),
            Kind::Mpfr($x) => Kind::Mpfr($result),
        })
    };
}

/// What `$result` makes of two numbers of one kind, and `$otherwise` of numbers of two kinds.
macro_rules! of_both {
    ($a:expr, $b:expr, ($x:ident, $y:ident) => $result:expr, $otherwise:expr) => {
        match ($a, $b) {
            (Kind::F16($x), Kind::F16($y)) => $result,
            (Kind::Bf16($x), Kind::Bf16($y)) => $result,
            (Kind::F32($x), Kind::F32($y)) => $result,
            (Kind::F64($x), Kind::F64($y)) => $result,
            (Kind::F32Lanes($x), Kind::F32Lanes($y)) => $result,
            (Kind::F64Lanes($x), Kind::F64Lanes($y)) => $result,
            (Kind::Ieee($x), Kind::Ieee($y)) => $result,
            (Kind::Fixed($x), Kind::Fixed($y)) => $result,
            (Kind::Mpfr($x), Kind::Mpfr($y)) => $result,
            _ => $otherwise,
        }
    };
}

impl Format for FormatName {
    type Real = AnyReal;

    fn bits(self) -> u32 {
        match self {
            FormatName::F16 => BINARY16.bits(),
            FormatName::Bf16 => BFLOAT16.bits(),
            FormatName::F32 | FormatName::F32Lanes => f32::MANTISSA_DIGITS,
            FormatName::F64 | FormatName::F64Lanes => f64::MANTISSA_DIGITS,
            FormatName::Ieee(format) => format.bits(),
            FormatName::Fixed(format) => format.bits(),
            FormatName::Mpfr(bits) => bits,
        }
    }
    fn int(self, n: i64) -> AnyReal {
        make!(self, format => format.int(n))
    }
    fn ratio(self, q: &Rational) -> AnyReal {
        make!(self, format => format.ratio(q))
    }
    fn fraction(self, numerator: u64, denominator: u64) -> AnyReal {
        make!(self, format => format.fraction(numerator, denominator))
    }
    fn binary64(self, x: f64) -> AnyReal {
        make!(self, format => format.binary64(x))
    }
    fn pi(self) -> AnyReal {
        make!(self, format => format.pi())
    }
}

impl AnyReal {
    /// This number in that format.
    #[cold]
    fn rounded_to(&self, format: FormatName) -> AnyReal {
        match self.to_rational() {
            Some(value) => format.ratio(&value),
            None => format.binary64(f64::NAN),
        }
    }
}

impl PartialEq for AnyReal {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for AnyReal {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        of_both!(&self.0, &other.0, (a, b) => a.partial_cmp(b), {
            self.to_float().partial_cmp(&other.to_float())
        })
    }
}

impl Display for AnyReal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        of_number!(&self.0, x => Display::fmt(x, f))
    }
}

impl Neg for AnyReal {
    type Output = Self;
    fn neg(self) -> Self {
        map!(self.0, x => -x)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident) => {
        impl<'a> $trait<&'a AnyReal> for AnyReal {
            type Output = AnyReal;
            fn $method(mut self, other: &'a AnyReal) -> AnyReal {
                $assign_trait::$assign_method(&mut self, other);
                self
            }
        }
        impl<'a> $assign_trait<&'a AnyReal> for AnyReal {
            fn $assign_method(&mut self, other: &'a AnyReal) {
                of_both!(&mut self.0, &other.0, (a, b) => $assign_trait::$assign_method(a, b), {
                    let other = other.rounded_to(self.format());
                    // Of one kind by now.
                    $assign_trait::$assign_method(self, &other);
                });
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div, DivAssign, div_assign);

macro_rules! by_kind {
    ($($function:ident),*) => {$(
        fn $function(self) -> Self {
            map!(self.0, x => Real::$function(x))
        }
    )*};
}

/// The numbers of a row where all are of that kind of lanes; nothing is allocated where the first is not.
macro_rules! lanes {
    ($row:expr, $kind:ident) => {
        $row.iter()
            .map(|x| match &x.0 {
                Kind::$kind(x) => Some(*x),
                _ => None,
            })
            .collect::<Option<Vec<_>>>()
    };
}

/// Puts numbers of lanes where others were.
macro_rules! put {
    ($numbers:expr, $kind:ident, $row:expr) => {
        for (any, number) in $row.iter_mut().zip($numbers) {
            *any = AnyReal(Kind::$kind(number));
        }
    };
}

/// A function of one result of each of a row.
macro_rules! row_by_kind {
    ($($function:ident of $one:ident),*) => {$(
        fn $function(row: &[Self], results: &mut [Self]) {
            if let Some(numbers) = lanes!(row, F32Lanes) {
                let mut values = numbers.clone();
                Real::$function(&numbers, &mut values);
                put!(values, F32Lanes, results);
            } else if let Some(numbers) = lanes!(row, F64Lanes) {
                let mut values = numbers.clone();
                Real::$function(&numbers, &mut values);
                put!(values, F64Lanes, results);
            } else {
                for (x, result) in row.iter().zip(results) {
                    *result = x.clone().$one();
                }
            }
        }
    )*};
}

impl Real for AnyReal {
    type Format = FormatName;

    fn format(&self) -> FormatName {
        match &self.0 {
            Kind::F16(_) => FormatName::F16,
            Kind::Bf16(_) => FormatName::Bf16,
            Kind::F32(_) => FormatName::F32,
            Kind::F64(_) => FormatName::F64,
            Kind::F32Lanes(_) => FormatName::F32Lanes,
            Kind::F64Lanes(_) => FormatName::F64Lanes,
            Kind::Ieee(x) => FormatName::Ieee(x.format()),
            Kind::Fixed(x) => FormatName::Fixed(x.format()),
            Kind::Mpfr(x) => FormatName::Mpfr(x.format().bits),
        }
    }
    fn set(&mut self, from: &Self) {
        of_both!(&mut self.0, &from.0, (a, b) => a.set(b), {
            *self = from.rounded_to(self.format());
        });
    }
    by_kind! { abs, sqrt, exp, exp_m1, ln, ln_1p, tan, sinh, cosh, tanh, atan, erf }
    fn sin_cos(self) -> (Self, Self) {
        macro_rules! both {
            ($($kind:ident),*) => {
                match self.0 {
                    $(Kind::$kind(x) => {
                        let (sin, cos) = Real::sin_cos(x);
                        (AnyReal(Kind::$kind(sin)), AnyReal(Kind::$kind(cos)))
                    })*
                }
            };
        }
        both!(F16, Bf16, F32, F64, F32Lanes, F64Lanes, Ieee, Fixed, Mpfr)
    }
    row_by_kind! { exp_row of exp, exp_m1_row of exp_m1 }
    fn sin_cos_row(row: &[Self], sines: &mut [Self], cosines: &mut [Self]) {
        if let Some(numbers) = lanes!(row, F32Lanes) {
            let (mut sin, mut cos) = (numbers.clone(), numbers.clone());
            Real::sin_cos_row(&numbers, &mut sin, &mut cos);
            put!(sin, F32Lanes, sines);
            put!(cos, F32Lanes, cosines);
        } else if let Some(numbers) = lanes!(row, F64Lanes) {
            let (mut sin, mut cos) = (numbers.clone(), numbers.clone());
            Real::sin_cos_row(&numbers, &mut sin, &mut cos);
            put!(sin, F64Lanes, sines);
            put!(cos, F64Lanes, cosines);
        } else {
            for ((x, sin), cos) in row.iter().zip(sines).zip(cosines) {
                (*sin, *cos) = x.clone().sin_cos();
            }
        }
    }
    fn is_finite(&self) -> bool {
        of_number!(&self.0, x => Real::is_finite(x))
    }
    fn to_rational(&self) -> Option<Rational> {
        of_number!(&self.0, x => x.to_rational())
    }
    fn to_float(&self) -> Float {
        of_number!(&self.0, x => Real::to_float(x))
    }
    fn log2_abs(&self) -> f64 {
        of_number!(&self.0, x => x.log2_abs())
    }
}

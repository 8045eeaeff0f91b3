//! + − × ÷ √ against hardware, bit for bit, on numbers of all kinds.

use super::rounding::rounded;
use super::{is, number};
use half::{bf16, f16};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::Float;
use volver::real::{Format, Ieee, NativeFloat, Real};

/// A format that hardware, or arithmetic in a wider one, has.
trait Hardware: Copy {
    const FORMAT: Ieee;
    /// Bits of the exponent.
    const EXPONENT: u32;
    /// From sign, exponent and trailing significand as they lie in memory.
    fn from_bits(pattern: u64) -> Self;
    /// Exact.
    fn wide(self) -> f64;
    /// a + b, a − b, a × b, a ÷ b or √a.
    fn operate(operation: Operation, a: Self, b: Self) -> Self;
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    Root,
}

use Operation::{Add, Divide, Multiply, Root, Subtract};

impl Operation {
    const ALL: [Operation; 5] = [Add, Subtract, Multiply, Divide, Root];

    fn of<R: Real>(self, a: R, b: &R) -> R {
        match self {
            Add => a + b,
            Subtract => a - b,
            Multiply => a * b,
            Divide => a / b,
            Root => a.sqrt(),
        }
    }
}

macro_rules! native {
    ($float:ty, $bits:ty, $format:expr, $exponent:expr) => {
        impl Hardware for $float {
            const FORMAT: Ieee = $format;
            const EXPONENT: u32 = $exponent;
            fn from_bits(pattern: u64) -> Self {
                <$float>::from_bits(<$bits>::try_from(pattern).unwrap())
            }
            fn wide(self) -> f64 {
                self.into()
            }
            fn operate(operation: Operation, a: Self, b: Self) -> Self {
                fn of<T: NativeFloat>(operation: Operation, a: T, b: T) -> T {
                    operation.of(a, &b)
                }
                of(operation, a, b)
            }
        }
    };
}
native!(f32, u32, Ieee::BINARY32, 8);
native!(f64, u64, Ieee::BINARY64, 11);
native!(f16, u16, Ieee::BINARY16, 5);
native!(bf16, u16, Ieee::BFLOAT16, 8);

/// TF32 as binary32's upper 19 bits, computed in binary64 and rounded on its bits.
#[derive(Clone, Copy)]
struct Tf32(f64);

impl Hardware for Tf32 {
    const FORMAT: Ieee = Ieee::TF32;
    const EXPONENT: u32 = 8;
    fn from_bits(pattern: u64) -> Self {
        Tf32(f32::from_bits(u32::try_from(pattern << 13).unwrap()).into())
    }
    fn wide(self) -> f64 {
        self.0
    }
    fn operate(operation: Operation, a: Self, b: Self) -> Self {
        Tf32(rounded(operation.of(a.0, &b.0), 11, -126, 127))
    }
}

/// Draws operands.
struct Draw(Pcg64);

impl Draw {
    fn below(&mut self, bound: i64) -> i64 {
        i64::try_from(self.0.next_u64() % u64::try_from(bound).unwrap()).unwrap()
    }

    /// Random sign and significand at a biased exponent; many of them with few bits, so that results are
    /// exact or ties.
    fn at<T: Hardware>(&mut self, exponent: i64) -> T {
        let trailing = T::FORMAT.bits() - 1;
        let all_ones = (1_i64 << T::EXPONENT) - 1;
        let exponent = u64::try_from(exponent.clamp(0, all_ones - 1)).unwrap();
        let mut significand = self.0.next_u64() >> (64 - trailing);
        significand &= match self.below(4) {
            0 => !0,
            1 => !0 << self.below(i64::from(trailing) + 1),
            _ => !0 << (i64::from(trailing) - self.below(4.min(i64::from(trailing)))),
        };
        let sign = self.0.next_u64() >> 63;
        T::from_bits((sign << T::EXPONENT | exponent) << trailing | significand)
    }

    /// Any bits at all.
    fn any<T: Hardware>(&mut self) -> T {
        T::from_bits(self.0.next_u64() >> (64 - T::FORMAT.bits() - T::EXPONENT))
    }

    /// Operands whose result lies among the subnormal numbers or just above them, if `small`, or near the
    /// largest number.
    fn near_an_end<T: Hardware>(&mut self, operation: Operation, small: bool) -> (T, T) {
        let trailing = i64::from(T::FORMAT.bits()) - 1;
        let infinite = (1_i64 << T::EXPONENT) - 1;
        let bias = infinite / 2;
        let target = if small {
            2 - self.below(trailing + 5)
        } else {
            infinite - 2 + self.below(4)
        };
        let first = match operation {
            Multiply | Divide if small => self.below(bias),
            Multiply | Divide => bias + self.below(bias),
            _ if small => self.below(trailing + 4),
            _ => infinite - 1,
        };
        let second = match operation {
            Multiply => target - first + bias,
            Divide => first - target + bias,
            _ => first + 1 - self.below(3),
        };
        (self.at(first), self.at(second))
    }
}

#[derive(Debug, Default)]
struct Seen {
    all: u32,
    subnormal: u32,
    overflowed: u32,
    nan: u32,
    zero: u32,
    /// Among five of every sixteen, where it is looked for.
    tie: u32,
    subnormal_tie: u32,
}

/// Whether a ± b or a × b lies in the middle between two numbers of the format. `result` is finite.
fn is_tie(format: Ieee, operation: Operation, (a, b): (f64, f64), result: f64) -> Option<bool> {
    let exact = Float::with_val(2200, a);
    let exact = match operation {
        Add => exact + b,
        Subtract => exact - b,
        Multiply => exact * b,
        Divide | Root => return None,
    };
    let exponent = exact.get_exp()? - 1;
    let quantum = exponent.max(format.emin()) - format.bits().cast_signed() + 1;
    let distance: Float = (exact - result).abs();
    Some(distance == Float::with_val(53, 1) << (quantum - 1))
}

fn equals_hardware<T: Hardware>(seed: u64) -> Seen {
    const OPERATIONS: u32 = 1_000_000;
    let format = T::FORMAT;
    let smallest = 2.0_f64.powi(format.emin());
    let mut draw = Draw(Pcg64::seed_from_u64(seed));
    let mut seen = Seen::default();
    for i in 0..OPERATIONS {
        let operation = Operation::ALL[(i % 5) as usize];
        let (a, b): (T, T) = match i / 5 % 4 {
            0 => (draw.any(), draw.any()),
            1 => {
                // Exponents so near that sums cancel and low bits meet.
                let exponent = draw.below(1 << T::EXPONENT);
                let nearby = exponent + draw.below(2 * i64::from(format.bits())) - 3;
                (draw.at(exponent), draw.at(nearby))
            }
            2 => draw.near_an_end(operation, true),
            _ => draw.near_an_end(operation, false),
        };
        let theirs = T::operate(operation, a, b).wide();
        let (a, b) = (a.wide(), b.wide());
        let ours = operation.of(number(format, a), &number(format, b));
        assert!(
            is(&ours, theirs),
            "{format}: {a:e} {operation:?} {b:e} gave {ours}, not {theirs:e}"
        );
        seen.all += 1;
        let finite = a.is_finite() && b.is_finite() && (operation != Divide || b != 0.0);
        let subnormal = theirs != 0.0 && theirs.abs() < smallest;
        seen.subnormal += u32::from(subnormal);
        seen.overflowed += u32::from(finite && theirs.is_infinite());
        seen.nan += u32::from(theirs.is_nan());
        seen.zero += u32::from(theirs == 0.0);
        if i % 16 < 5 && finite && theirs.is_finite() {
            let tie = is_tie(format, operation, (a, b), theirs) == Some(true);
            seen.tie += u32::from(tie);
            seen.subnormal_tie += u32::from(tie && subnormal);
        }
    }
    println!("{format}: {seen:?}");
    // Nothing of what is meant to be tested may be rare.
    assert!(seen.subnormal > seen.all / 15, "{seen:?}");
    assert!(seen.overflowed > seen.all / 30, "{seen:?}");
    assert!(
        seen.nan > seen.all / 50 && seen.zero > seen.all / 100,
        "{seen:?}"
    );
    assert!(seen.tie > 1000 && seen.subnormal_tie > 100, "{seen:?}");
    seen
}

#[test]
fn binary32_equals_hardware() {
    equals_hardware::<f32>(32);
}

#[test]
fn binary64_equals_hardware() {
    equals_hardware::<f64>(64);
}

#[test]
fn binary16_equals_half() {
    equals_hardware::<f16>(16);
}

#[test]
fn bfloat16_equals_half() {
    equals_hardware::<bf16>(8);
}

#[test]
fn tf32_equals_binary64_rounded_on_its_bits() {
    equals_hardware::<Tf32>(19);
}

/// IEEE 754-2019, sections 6.2 and 6.3: signs of 0, infinities and NaN.
#[test]
fn special_operands_give_what_hardware_gives() {
    let values = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::MAX,
        f64::MIN_POSITIVE,
        f64::from_bits(1),
    ];
    let format = Ieee::BINARY64;
    for a in values {
        for b in values {
            for operation in Operation::ALL {
                let ours = operation.of(number(format, a), &number(format, b));
                assert!(is(&ours, operation.of(a, &b)), "{a} {operation:?} {b}");
            }
            let (x, y) = (number(format, a), number(format, b));
            assert_eq!(x.partial_cmp(&y), a.partial_cmp(&b), "{a} {b}");
            assert_eq!(x == y, a == b, "{a} {b}");
        }
        assert!(is(&-number(format, a), -a));
        assert!(is(&Real::abs(number(format, a)), a.abs()));
        assert_eq!(number(format, a).is_finite(), a.is_finite());
    }
}

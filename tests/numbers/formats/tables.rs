//! The 8-bit formats against tables of all their codes: every sum, difference, product, quotient and
//! root, rounded by looking for the nearest code in exact arithmetic.
//!
//! Source of the codes: OCP 8-bit Floating Point Specification (OFP8), revision 1.0, section 5.

use super::{is, number};
use volver::real::{Format, Ieee, Real};

/// Values are integers in units of 2⁻¹⁶, E5M2's smallest number.
const UNIT: i128 = 1 << 16;

struct Codes {
    format: Ieee,
    trailing: u32,
    bias: i32,
    /// The code where overflow begins: ∞ in E5M2, NaN in E4M3, where 480 would stand next.
    overflow: u8,
}

const E4M3: Codes = Codes {
    format: Ieee::E4M3,
    trailing: 3,
    bias: 7,
    overflow: 0x7f,
};
const E5M2: Codes = Codes {
    format: Ieee::E5M2,
    trailing: 2,
    bias: 15,
    overflow: 0x7c,
};

impl Codes {
    /// The value of a code without its sign, as if no code stood for ∞ or NaN.
    fn size(&self, code: u8) -> i128 {
        let exponent = i32::from((code & 0x7f) >> self.trailing);
        let fraction = i128::from(code) & ((1 << self.trailing) - 1);
        let (significand, exponent) = match exponent {
            0 => (fraction, 1),
            _ => (fraction + (1 << self.trailing), exponent),
        };
        significand << (exponent - self.bias - self.trailing.cast_signed() + 16)
    }

    fn value(&self, code: u8) -> f64 {
        let size = match code & 0x7f {
            0x7c if self.overflow == 0x7c => f64::INFINITY,
            c if c >= self.overflow => f64::NAN,
            c => self.size(c) as f64 / UNIT as f64,
        };
        if code < 0x80 { size } else { -size }
    }

    /// The nearest code to ±numerator/denominator units, of two equally near ones the even one.
    fn nearest(&self, negative: bool, numerator: i128, denominator: i128) -> f64 {
        let distance = |code: &u8| (self.size(*code) * denominator - numerator.abs()).abs();
        let code = (0..=self.overflow)
            .min_by_key(|code| (distance(code), code % 2))
            .unwrap();
        self.value(code | u8::from(negative) << 7)
    }

    /// What binary64 says where an operand is ∞ or NaN or a divisor 0: all of it is in E5M2, and E4M3
    /// has NaN for infinities.
    fn special(&self, x: f64) -> f64 {
        if x.is_infinite() && self.overflow == 0x7f {
            f64::NAN
        } else {
            x
        }
    }

    fn sum(&self, a: f64, b: f64) -> f64 {
        if !a.is_finite() || !b.is_finite() || a + b == 0.0 {
            // The sign of an exact zero is binary64's.
            return self.special(a + b);
        }
        let exact = units(a) + units(b);
        self.nearest(exact < 0, exact, 1)
    }

    fn product(&self, a: f64, b: f64) -> f64 {
        if !a.is_finite() || !b.is_finite() {
            return self.special(a * b);
        }
        let negative = a.is_sign_negative() != b.is_sign_negative();
        self.nearest(negative, units(a) * units(b), UNIT)
    }

    fn quotient(&self, a: f64, b: f64) -> f64 {
        if !a.is_finite() || !b.is_finite() || b == 0.0 {
            return self.special(a / b);
        }
        let negative = a.is_sign_negative() != b.is_sign_negative();
        self.nearest(negative, units(a) * UNIT, units(b).abs())
    }

    /// The code whose midpoints with its neighbours have squares around x; no root is a midpoint.
    fn root(&self, x: f64) -> f64 {
        if !x.is_finite() || x <= 0.0 {
            return self.special(x.sqrt());
        }
        // Twice a midpoint is an integer, and so is four times x.
        let below = |code: &u8| {
            let twice = self.size(*code) + self.size(code + 1);
            twice * twice < 4 * units(x) * UNIT
        };
        let code = (0..self.overflow).filter(below).count();
        self.value(u8::try_from(code).unwrap())
    }

    fn check(&self) {
        let (mut subnormal, mut beyond) = (0, 0);
        let values: Vec<f64> = (0..=255).map(|code| self.value(code)).collect();
        let smallest = 2.0_f64.powi(1 - self.bias);
        let mut check = |ours, expected: f64, what: &dyn Fn() -> String| {
            subnormal += u32::from(expected != 0.0 && expected.abs() < smallest);
            beyond += u32::from(!expected.is_finite());
            assert!(is(&ours, expected), "{}: {ours} for {expected}", what());
        };
        for &a in &values {
            let x = number(self.format, a);
            assert!(is(&x, a), "{} lacks {a}", self.format);
            check(x.clone().sqrt(), self.root(a), &|| format!("√{a}"));
            for &b in &values {
                let y = number(self.format, b);
                check(x.clone() + &y, self.sum(a, b), &|| format!("{a} + {b}"));
                check(x.clone() - &y, self.sum(a, -b), &|| format!("{a} − {b}"));
                check(x.clone() * &y, self.product(a, b), &|| format!("{a} × {b}"));
                check(x.clone() / &y, self.quotient(a, b), &|| {
                    format!("{a} ÷ {b}")
                });
            }
        }
        println!("{}: {subnormal} subnormal, {beyond} beyond", self.format);
        assert!(subnormal > 5000 && beyond > 20_000);
    }
}

fn units(x: f64) -> i128 {
    #[allow(clippy::cast_possible_truncation)]
    let units = (x * UNIT as f64) as i128;
    assert_eq!(units as f64 / UNIT as f64, x);
    units
}

#[test]
fn e4m3_equals_its_table() {
    assert_eq!(E4M3.value(0x7e), 448.0);
    assert_eq!(E4M3.value(0x01), 2.0_f64.powi(-9));
    E4M3.check();
}

#[test]
fn e5m2_equals_its_table() {
    assert_eq!(E5M2.value(0x7b), 57344.0);
    assert_eq!(E5M2.value(0x01), 2.0_f64.powi(-16));
    E5M2.check();
}

/// 464 is the tie between 448 and the next number there would be; 61440 that between 57344 and 65536.
#[test]
fn overflow_begins_beyond_the_tie() {
    let e4m3 = |n, d| Ieee::E4M3.fraction(n, d).as_float().to_f64();
    assert_eq!(e4m3(464, 1), 448.0);
    assert!(e4m3(464_001, 1000).is_nan());
    assert!(Ieee::E4M3.int(-465).as_float().is_nan());
    assert!(Ieee::E4M3.int(0).ln().as_float().is_nan());
    let e5m2 = |n| Ieee::E5M2.int(n).as_float().to_f64();
    assert_eq!(e5m2(61439), 57344.0);
    assert_eq!(e5m2(61440), f64::INFINITY);
    assert_eq!(e5m2(-61440), f64::NEG_INFINITY);
}

//! Emulated formats after IEEE 754: any number of significant bits, any range of exponents.

mod number;

pub use number::IeeeReal;

use super::{Format, FormatError};
use rug::float::{Constant, MiniFloat, Round, Special};
use rug::{Assign, Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};

/// Most significant bits an emulated format may have.
pub const MAX_IEEE_BITS: u32 = 64;
/// The largest exponent an emulated format may have, and the size of the least: binary256's. Products,
/// quotients and sums stay far inside MPFR's own range, ±2³⁰.
pub const MAX_EXPONENT: i32 = 262_143;

/// What becomes of a result beyond the largest finite number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Overflow {
    /// An infinity. The largest finite number is (2 − 2^(1 − bits))·2^emax.
    Infinity,
    /// NaN: the format has no infinities, and some significands of the last binade may stand for other
    /// things than numbers.
    Nan {
        /// The integer m of the largest finite number m·2^(emax − bits + 1).
        largest: u64,
    },
}

/// A binary floating-point format with gradual underflow, computed in MPFR and rounded to nearest, ties to
/// even, as IEEE 754-2019 defines it.
///
/// Numbers are ±m·2^(e − bits + 1) with integers 0 ≤ m < 2^bits and emin ≤ e ≤ emax: the smallest normal
/// number is 2^emin, the smallest subnormal one 2^(emin − bits + 1). + − × ÷ √ equal the hardware's bit for
/// bit where it has the format; elementary functions are correctly rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ieee {
    bits: u32,
    emin: i32,
    emax: i32,
    overflow: Overflow,
}

impl Ieee {
    /// NVIDIA's `TensorFloat`-32: the significand of binary16, the range of binary32.
    pub const TF32: Ieee = Ieee::with_infinity(11, -126, 127);
    /// bfloat16: binary32 without the last 16 bits.
    pub const BFLOAT16: Ieee = Ieee::with_infinity(8, -126, 127);
    /// IEEE binary16.
    pub const BINARY16: Ieee = Ieee::with_infinity(11, -14, 15);
    /// IEEE binary32.
    pub const BINARY32: Ieee = Ieee::with_infinity(24, -126, 127);
    /// IEEE binary64.
    pub const BINARY64: Ieee = Ieee::with_infinity(53, -1022, 1023);
    /// E5M2 of the Open Compute Project's 8-bit floating point specification, revision 1.0.
    pub const E5M2: Ieee = Ieee::with_infinity(3, -14, 15);
    /// E4M3 of the Open Compute Project's 8-bit floating point specification, revision 1.0: no
    /// infinities, the largest number is 448, and overflow gives NaN.
    pub const E4M3: Ieee = Ieee {
        bits: 4,
        emin: -6,
        emax: 8,
        overflow: Overflow::Nan { largest: 0b1110 },
    };

    const fn with_infinity(bits: u32, emin: i32, emax: i32) -> Ieee {
        Ieee {
            bits,
            emin,
            emax,
            overflow: Overflow::Infinity,
        }
    }

    /// The format with infinities of `bits` significant bits, smallest normal number 2^`emin` and largest
    /// finite number (2 − 2^(1 − bits))·2^`emax`.
    ///
    /// # Errors
    /// [`FormatError::IeeeRange`] unless 2 ≤ bits ≤ [`MAX_IEEE_BITS`], −[`MAX_EXPONENT`] ≤ emin ≤ 0 and
    /// 1 ≤ emax ≤ [`MAX_EXPONENT`]: 1 and 2 are normal numbers.
    pub fn new(bits: u32, emin: i32, emax: i32) -> Result<Ieee, FormatError> {
        let allowed = (2..=MAX_IEEE_BITS).contains(&bits)
            && (-MAX_EXPONENT..=0).contains(&emin)
            && (1..=MAX_EXPONENT).contains(&emax);
        if allowed {
            Ok(Ieee::with_infinity(bits, emin, emax))
        } else {
            Err(FormatError::IeeeRange { bits, emin, emax })
        }
    }

    /// The exponent of the smallest normal number.
    #[must_use]
    pub const fn emin(self) -> i32 {
        self.emin
    }

    /// The exponent of the largest finite number.
    #[must_use]
    pub const fn emax(self) -> i32 {
        self.emax
    }

    /// What becomes of a result beyond the largest finite number.
    #[must_use]
    pub const fn overflow(self) -> Overflow {
        self.overflow
    }

    /// `value`, rounded once to nearest; its sign is kept if it is 0, and NaN and infinities are what
    /// this format makes of them.
    #[must_use]
    pub fn round(self, value: &Float) -> IeeeReal {
        self.fit(Float::with_val_round(self.bits, value, Round::Nearest))
    }

    /// A number of this format from one that is rounded to its bits, but not yet to its range.
    fn fit(self, (mut value, ternary): (Float, Ordering)) -> IeeeReal {
        self.fit_mut(&mut value, ternary);
        IeeeReal::new(self, value)
    }

    /// Brings a number into range that was rounded to nearest at this format's bits; `ternary` says how it
    /// lies to the exact one. Without it what looks like a tie of the subnormal numbers may be none, and
    /// would be rounded twice.
    fn fit_mut(self, value: &mut Float, ternary: Ordering) {
        value.subnormalize_round(self.emin + 1, ternary, Round::Nearest);
        match self.overflow {
            Overflow::Infinity => {
                // MPFR's exponents are those of numbers in [½, 1).
                if value.get_exp().is_some_and(|exp| exp > self.emax + 1) {
                    value.assign(if value.is_sign_negative() {
                        Special::NegInfinity
                    } else {
                        Special::Infinity
                    });
                }
            }
            Overflow::Nan { largest } => {
                let near = value.get_exp().is_some_and(|exp| exp > self.emax);
                if value.is_infinite() || (near && self.is_beyond(value, largest)) {
                    value.assign(Special::Nan);
                }
            }
        }
    }

    /// Whether |value| > largest·2^(emax − bits + 1).
    fn is_beyond(self, value: &Float, largest: u64) -> bool {
        let unit = self.emax - self.bits.cast_signed() + 1;
        let largest = Float::with_val(MAX_IEEE_BITS, largest) << unit;
        value.cmp_abs(&largest) == Some(Ordering::Greater)
    }
}

impl Display for Ieee {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Ieee::TF32 => f.pad("tf32"),
            Ieee::E4M3 => f.pad("fp8-e4m3"),
            Ieee::E5M2 => f.pad("fp8-e5m2"),
            Ieee {
                bits, emin, emax, ..
            } => f.pad(&format!("ieee:{bits},{emin},{emax}")),
        }
    }
}

impl Format for Ieee {
    type Real = IeeeReal;

    fn bits(self) -> u32 {
        self.bits
    }

    fn int(self, n: i64) -> IeeeReal {
        self.fit(Float::with_val_round(self.bits, n, Round::Nearest))
    }

    fn ratio(self, q: &Rational) -> IeeeReal {
        self.fit(Float::with_val_round(self.bits, q, Round::Nearest))
    }

    fn fraction(self, numerator: u64, denominator: u64) -> IeeeReal {
        // Both are exact in 64 bits, and the division rounds once.
        let (a, b) = (MiniFloat::from(numerator), MiniFloat::from(denominator));
        let (a, b) = (a.borrow(), b.borrow());
        let quotient = &*a / &*b;
        self.fit(Float::with_val_round(self.bits, quotient, Round::Nearest))
    }

    fn pi(self) -> IeeeReal {
        let pi = Float::with_val_round(self.bits, Constant::Pi, Round::Nearest);
        self.fit(pi)
    }
}

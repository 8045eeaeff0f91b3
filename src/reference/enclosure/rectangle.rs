//! Rectangles of the complex plane, their sides in MPFR and rounded outwards.
//!
//! Every operation gives a rectangle with each value that it takes on the arguments, and has none where it may
//! not be analytic on all of them: what bounds a function by a rectangle is analytic within.

use crate::symbolic::Interval;
use rug::float::Round;
use rug::{Float, Rational};

/// All x + iy with x and y in two intervals.
#[derive(Clone, Debug)]
pub struct Rectangle {
    /// x.
    pub re: Interval,
    /// y.
    pub im: Interval,
}

fn square(x: &Interval) -> Interval {
    let magnitude = x.abs();
    &magnitude * &magnitude
}

fn integer(bits: u32, n: i32) -> Interval {
    Interval::exactly(&Float::with_val(bits, n))
}

/// [−x, x].
fn around_zero(x: &Interval) -> Interval {
    x.union(&-x)
}

impl Rectangle {
    /// A part of the real line.
    pub(super) fn real(re: Interval) -> Rectangle {
        let im = integer(re.bits(), 0);
        Rectangle { re, im }
    }

    pub(super) fn bits(&self) -> u32 {
        self.re.bits()
    }

    /// The greatest |z|.
    pub(super) fn magnitude(&self) -> Float {
        let sum = &square(&self.re) + &square(&self.im);
        let mut magnitude = sum.upper().clone();
        magnitude.sqrt_round(Round::Up);
        magnitude
    }

    pub(super) fn plus(&self, other: &Rectangle) -> Rectangle {
        Rectangle {
            re: &self.re + &other.re,
            im: &self.im + &other.im,
        }
    }

    pub(super) fn minus(&self, other: &Rectangle) -> Rectangle {
        Rectangle {
            re: &self.re - &other.re,
            im: &self.im - &other.im,
        }
    }

    pub(super) fn negated(&self) -> Rectangle {
        Rectangle {
            re: -&self.re,
            im: -&self.im,
        }
    }

    pub(super) fn times(&self, other: &Rectangle) -> Rectangle {
        Rectangle {
            re: &(&self.re * &other.re) - &(&self.im * &other.im),
            im: &(&self.re * &other.im) + &(&self.im * &other.re),
        }
    }

    /// z², which knows that both factors are the same.
    pub(super) fn squared(&self) -> Rectangle {
        let product = &self.re * &self.im;
        Rectangle {
            re: &square(&self.re) - &square(&self.im),
            im: &product + &product,
        }
    }

    pub(super) fn over(&self, divisor: &Rectangle) -> Option<Rectangle> {
        let norm = &square(&divisor.re) + &square(&divisor.im);
        let re = &(&self.re * &divisor.re) + &(&self.im * &divisor.im);
        let im = &(&self.im * &divisor.re) - &(&self.re * &divisor.im);
        Some(Rectangle {
            re: re.divide(&norm).ok()?,
            im: im.divide(&norm).ok()?,
        })
    }

    /// The principal root, right of the imaginary axis.
    pub(super) fn sqrt(&self) -> Option<Rectangle> {
        if !self.re.is_positive() {
            return None;
        }
        let modulus = (&square(&self.re) + &square(&self.im)).sqrt().ok()?;
        let two = integer(self.bits(), 2);
        let re = (&modulus + &self.re).divide(&two).ok()?.sqrt().ok()?;
        let im = self.im.divide(&(&two * &re)).ok()?;
        Some(Rectangle { re, im })
    }

    pub(super) fn exp(&self) -> Rectangle {
        let growth = self.re.exp();
        Rectangle {
            re: &growth * &self.im.cos(),
            im: &growth * &self.im.sin(),
        }
    }

    /// e^x cos y − 1 = (e^x − 1) cos y − 2 sin² y/2.
    pub(super) fn exp_m1(&self) -> Option<Rectangle> {
        let two = integer(self.bits(), 2);
        let half = square(&self.im.divide(&two).ok()?.sin());
        Some(Rectangle {
            re: &(&self.re.exp_m1() * &self.im.cos()) - &(&two * &half),
            im: &self.re.exp() * &self.im.sin(),
        })
    }

    /// The principal logarithm, right of the imaginary axis.
    pub(super) fn ln(&self) -> Option<Rectangle> {
        if !self.re.is_positive() {
            return None;
        }
        let norm = &square(&self.re) + &square(&self.im);
        Some(Rectangle {
            re: norm.ln().ok()?.divide(&integer(self.bits(), 2)).ok()?,
            im: self.im.divide(&self.re).ok()?.atan(),
        })
    }

    /// ln(1 + z) with |1 + z|² − 1 = x (2 + x) + y².
    pub(super) fn ln_1p(&self) -> Option<Rectangle> {
        let bits = self.bits();
        let two = integer(bits, 2);
        let moved = &self.re + &integer(bits, 1);
        if !moved.is_positive() {
            return None;
        }
        let norm = &(&self.re * &(&two + &self.re)) + &square(&self.im);
        Some(Rectangle {
            re: norm.ln_1p().ok()?.divide(&two).ok()?,
            im: self.im.divide(&moved).ok()?.atan(),
        })
    }

    pub(super) fn sin_cos(&self) -> (Rectangle, Rectangle) {
        let (sin, cos) = (self.re.sin(), self.re.cos());
        let (sinh, cosh) = (self.im.sinh(), self.im.cosh());
        (
            Rectangle {
                re: &sin * &cosh,
                im: &cos * &sinh,
            },
            Rectangle {
                re: &cos * &cosh,
                im: -&(&sin * &sinh),
            },
        )
    }

    pub(super) fn tan(&self) -> Option<Rectangle> {
        let (sin, cos) = self.sin_cos();
        sin.over(&cos)
    }

    pub(super) fn sinh(&self) -> Rectangle {
        Rectangle {
            re: &self.re.sinh() * &self.im.cos(),
            im: &self.re.cosh() * &self.im.sin(),
        }
    }

    pub(super) fn cosh(&self) -> Rectangle {
        Rectangle {
            re: &self.re.cosh() * &self.im.cos(),
            im: &self.re.sinh() * &self.im.sin(),
        }
    }

    /// tanh z = ±(1 − 2/(e^(±2z) + 1)), |e^(±2z) + 1| ≥ e^(2|x|) − 1, away from the imaginary axis.
    pub(super) fn tanh(&self) -> Option<Rectangle> {
        let bits = self.bits();
        let (one, two) = (integer(bits, 1), integer(bits, 2));
        let least = if self.re.is_positive() {
            self.re.lower().clone()
        } else if self.re.is_negative() {
            Float::with_val(bits, -self.re.upper())
        } else {
            return self.sinh().over(&self.cosh());
        };
        let away = (&two * &Interval::exactly(&least)).exp_m1();
        let off = around_zero(&two.divide(&away).ok()?);
        let side = if self.re.is_positive() { one } else { -&one };
        let far = Rectangle {
            re: &side + &off,
            im: off,
        };
        Some(match self.sinh().over(&self.cosh()) {
            Some(near) => near.intersection(&far),
            None => far,
        })
    }

    /// atan z, as far from atan x as y times the greatest |1/(1 + ζ²)| on the way.
    pub(super) fn atan(&self) -> Option<Rectangle> {
        // On the way to the real line, not only here.
        let way = Rectangle {
            re: self.re.clone(),
            im: self.im.union(&integer(self.bits(), 0)),
        };
        let mut derivative = way.squared();
        derivative.re = &derivative.re + &integer(self.bits(), 1);
        let one = Rectangle::real(integer(self.bits(), 1));
        let slope = Interval::exactly(&one.over(&derivative)?.magnitude());
        Some(self.near_the_line(&self.re.atan(), &slope))
    }

    /// erf z, as far from erf x as y times 2/√π e^(y² − x²).
    pub(super) fn erf(&self) -> Option<Rectangle> {
        let bits = self.bits();
        let growth = (&square(&self.im) - &square(&self.re)).exp();
        let scale = integer(bits, 4)
            .divide(&Interval::pi(bits))
            .ok()?
            .sqrt()
            .ok()?;
        let slope = &scale * &growth;
        Some(self.near_the_line(&self.re.erf(), &slope))
    }

    /// Around values on the real line, with a derivative of at most `slope` on the way there.
    fn near_the_line(&self, re: &Interval, slope: &Interval) -> Rectangle {
        let off = around_zero(&(&self.im.abs() * &slope.abs()));
        Rectangle {
            re: re + &off,
            im: off,
        }
    }

    /// What is in both, of two that enclose the same values.
    fn intersection(self, other: &Rectangle) -> Rectangle {
        let both = |a: Interval, b: &Interval| a.intersection(b).unwrap_or(a);
        Rectangle {
            re: both(self.re, &other.re),
            im: both(self.im, &other.im),
        }
    }

    /// A number.
    pub(super) fn constant(bits: u32, q: &Rational) -> Rectangle {
        Rectangle::real(Interval::point(bits, q))
    }
}

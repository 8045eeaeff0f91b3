//! Where the two sides of a comparison change places: by Newton's method in intervals, on parts of the ray where their
//! difference is strictly monotone.

use super::branches::{holds, sides};
use super::germ::Germ;
use super::number::Number;
use super::run::{Branches, Run};
use super::substitution::{End, germs};
use crate::symbolic::{Constant, Interval, Operand, Program, simplest_between};
use rug::{Float, Rational};

/// Bits that slopes are enclosed in.
pub(super) const ROUGH_BITS: u32 = 64;
/// Steps of Newton's method, which doubles digits, and of halving where it does not.
const MAX_STEPS: u32 = 256;
/// A rational number with a denominator of fewer bits than the precision by this part is tried for the place itself.
const SHORT: u32 = 4;

/// What a difference of two sides does on a part of the ray.
pub(super) enum Crossing {
    /// It has one sign, but for single places; the way that is taken.
    Never(bool),
    /// It has one zero: it is above the first of the numbers and below the second.
    Once {
        below: Float,
        above: Float,
        end: Box<End>,
    },
    /// It is not known.
    Unknown,
}

/// A comparison of a program on the way that leads there.
pub(super) struct Comparison<'p> {
    pub(super) program: &'p Program,
    pub(super) constants: &'p [Interval],
    /// The same with fewer bits, which is enough for slopes: each step has as many digits as they have.
    pub(super) rough: &'p [Interval],
    pub(super) taken: &'p Branches,
    /// The instruction that compares.
    pub(super) place: usize,
}

impl Comparison<'_> {
    /// The sides with the program run up to there.
    fn sides<N: Number>(&self, constants: &[N], input: &N) -> Option<[N; 2]> {
        let mut run = Run::new(self.program, constants, input);
        let instructions = self.program.instructions();
        for (instruction, &way) in instructions.iter().zip(&self.taken.0).take(self.place) {
            run.step(instruction, way);
        }
        let (left, right, _) = sides(instructions.get(self.place)?.operation)?;
        let left = run.value(left)?;
        let right = match right {
            Some(right) => run.value(right)?,
            None => N::constant(input.bits(), &Rational::new()),
        };
        Some([left, right])
    }

    /// The left side less the right one at a number.
    fn difference(&self, at: &Float) -> Option<Interval> {
        let [left, right] = self.sides(self.constants, &Interval::exactly(at))?;
        Some(&left - &right)
    }

    /// All slopes of that between any two numbers of a part.
    fn slope(&self, part: &Interval) -> Option<Interval> {
        let bits = ROUGH_BITS;
        let part = part.to_bits(bits);
        let one = Interval::point(bits, &Rational::from(1));
        let away = Germ::power(bits, 1, one, part.minus(&part));
        // Based on the whole part, so that any number of it may be the base.
        let input = Germ::number(part, None).plus(&away);
        let [left, right] = self.sides(&germs(self.program, self.rough), &input)?;
        left.minus(&right).slope().cloned()
    }

    /// What the difference does between two numbers; the zero to within half of `shortest`.
    pub(super) fn crossing(&self, from: &Float, to: &Float, shortest: &Float) -> Crossing {
        self.found(from, to, shortest).unwrap_or(Crossing::Unknown)
    }

    fn found(&self, from: &Float, to: &Float, shortest: &Float) -> Option<Crossing> {
        let part = Interval::exactly(from).union(&Interval::exactly(to));
        let slope = self.slope(&part)?;
        if slope.contains_zero() {
            return None;
        }
        let ends = [self.difference(from)?, self.difference(to)?];
        let operation = self.program.instructions().get(self.place)?.operation;
        let (_, _, relation) = sides(operation)?;
        if ends.iter().all(Interval::is_nonnegative) {
            return Some(Crossing::Never(holds(relation, false)));
        }
        if ends.iter().all(Interval::is_nonpositive) {
            return Some(Crossing::Never(holds(relation, true)));
        }
        if ends.iter().any(Interval::contains_zero) {
            return None;
        }
        let zero = self.zero(part, slope, shortest)?;
        let precision = from.prec();
        let middle = Float::with_val(precision, zero.midpoint());
        let [below, above] = if zero.lower() == zero.upper() {
            [middle.clone(), middle]
        } else {
            let off = Float::with_val(precision, shortest >> 2_u32);
            let below = Float::with_val(precision, &middle - &off);
            let above = Float::with_val(precision, &middle + &off);
            if below <= *from || above >= *to {
                return None;
            }
            // Sure to be on either side, whatever Newton's method did.
            let signs = [self.difference(&below)?, self.difference(&above)?];
            if signs.iter().any(Interval::contains_zero)
                || signs[0].is_positive() == signs[1].is_positive()
            {
                return None;
            }
            [below, above]
        };
        let end = Box::new(self.end(&below, &above));
        Some(Crossing::Once { below, above, end })
    }

    /// The zero of a difference with that slope on a part, at whose ends it has two signs.
    fn zero(&self, mut part: Interval, mut slope: Interval, shortest: &Float) -> Option<Interval> {
        let enough = Float::with_val(64, shortest >> 3_u32);
        for _ in 0..MAX_STEPS {
            let width = part.width();
            if width <= enough {
                return Some(part);
            }
            let middle = part.midpoint();
            let value = self.difference(&middle)?;
            if value.is_zero() {
                return Some(Interval::exactly(&middle));
            }
            let step = value.divide(&slope).ok()?;
            let next = (&Interval::exactly(&middle) - &step).intersection(&part)?;
            if next.width() >= width {
                return Some(part);
            }
            part = next;
            slope = self
                .slope(&part)
                .filter(|slope| !slope.contains_zero())
                .unwrap_or(slope);
        }
        Some(part)
    }

    /// What is known of the zero between two numbers.
    fn end(&self, below: &Float, above: &Float) -> End {
        let place = Interval::exactly(below).union(&Interval::exactly(above));
        End {
            exact: self.rational(below, above),
            equal: self.equal(),
            place,
        }
    }

    /// The zero, where it is a rational number that is seen.
    fn rational(&self, below: &Float, above: &Float) -> Option<Rational> {
        let candidate = simplest_between(&below.to_rational()?, &above.to_rational()?);
        if candidate.denom().significant_bits() > below.prec() / SHORT {
            return None;
        }
        let bits = below.prec();
        let input = Germ::number(Interval::point(bits, &candidate), Some(candidate.clone()));
        let [left, right] = self.sides(&germs(self.program, self.constants), &input)?;
        (left.as_exact()? == right.as_exact()?).then_some(candidate)
    }

    /// A side, and the number that it is there.
    fn equal(&self) -> Option<(Operand, Rational)> {
        let operation = self.program.instructions().get(self.place)?.operation;
        let (left, right, _) = sides(operation)?;
        let number = |operand| match operand {
            Operand::Constant(i) => match self.program.constants().get(i)? {
                Constant::Rational(q) => Some(q.clone()),
                Constant::Pi => None,
            },
            _ => None,
        };
        match right {
            None => Some((left, Rational::new())),
            Some(right) => number(right)
                .map(|q| (left, q))
                .or_else(|| number(left).map(|q| (right, q))),
        }
    }
}

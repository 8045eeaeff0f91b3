//! What programs ask of numbers, around a base.

use super::{Germ, Rest, is_zero, one_like, sum};
use crate::reference::enclosure::number::{Number, Plane};
use crate::symbolic::Function;
use rug::Rational;

impl<N: Plane> Number for Germ<N> {
    fn constant(bits: u32, q: &Rational) -> Self {
        Germ::number(N::constant(bits, q), Some(q.clone()))
    }
    fn pi(bits: u32) -> Self {
        Germ::number(N::pi(bits), None)
    }
    fn bits(&self) -> u32 {
        match self {
            Germ::Known { base, .. } => base.bits(),
            Germ::Logarithm { factor, .. } => factor.bits(),
            Germ::Undefined => 0,
        }
    }
    fn plus(&self, other: &Self) -> Self {
        let (Some((a, exact_a, rest_a)), Some((b, exact_b, rest_b))) =
            (self.parts(), other.parts())
        else {
            return Germ::Undefined;
        };
        let exact = exact_a.zip(exact_b);
        let exact = exact.map(|(a, b)| Rational::from(a + b));
        Germ::known(
            a.plus(b),
            exact,
            sum(rest_a.into_iter().chain(rest_b).cloned()),
        )
    }
    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }
    fn times(&self, other: &Self) -> Self {
        if let (Germ::Logarithm { order, factor, v }, constant)
        | (constant, Germ::Logarithm { order, factor, v }) = (self, other)
        {
            return match (constant, constant.as_exact()) {
                (Germ::Known { base, .. }, Some(q)) => Germ::Logarithm {
                    order: Rational::from(order * q),
                    factor: factor.times(base),
                    v: v.clone(),
                },
                _ => Germ::Undefined,
            };
        }
        let (Some((a, exact_a, rest_a)), Some((b, exact_b, rest_b))) =
            (self.parts(), other.parts())
        else {
            return Germ::Undefined;
        };
        let scaled = |rest: Option<&Rest<N>>, by: &N, exact: Option<&Rational>| {
            let rest = rest.filter(|_| !is_zero(exact))?;
            Some(rest.with(rest.factor.times(by)))
        };
        let both = rest_a.zip(rest_b).map(|(a, b)| Rest {
            order: a.order + b.order,
            ..a.with(a.factor.times(&b.factor))
        });
        let parts = [scaled(rest_a, b, exact_b), scaled(rest_b, a, exact_a), both];
        let rest = sum(parts.into_iter().flatten());
        if is_zero(exact_a) || is_zero(exact_b) {
            let zero = Rational::new();
            return Germ::known(N::constant(a.bits(), &zero), Some(zero), rest);
        }
        let exact = exact_a.zip(exact_b);
        let exact = exact.map(|(a, b)| Rational::from(a * b));
        Germ::known(a.times(b), exact, rest)
    }
    fn squared(&self) -> Self {
        self.times(self)
    }
    fn over(&self, divisor: &Self) -> Option<Self> {
        self.quotient(divisor)
    }
    fn negated(&self) -> Self {
        match self {
            Germ::Known { base, exact, rest } => Germ::known(
                base.negated(),
                exact.as_ref().map(|q| Rational::from(-q)),
                rest.as_ref().map(|rest| rest.with(rest.factor.negated())),
            ),
            Germ::Logarithm { order, factor, v } => Germ::Logarithm {
                order: Rational::from(-order),
                factor: factor.negated(),
                v: v.clone(),
            },
            Germ::Undefined => Germ::Undefined,
        }
    }
    fn sqrt(&self) -> Option<Self> {
        self.root()
    }
    fn exp_m1(&self) -> Option<Self> {
        Some(self.analytic(N::exp_m1, |x| x.call(Function::Exp), Some(0)))
    }
    fn ln_1p(&self) -> Option<Self> {
        let slope = |x: &N| one_like(x).over(&one_like(x).plus(x));
        Some(self.analytic(N::ln_1p, slope, Some(0)))
    }
    fn sin_cos(&self) -> (Self, Self) {
        let Germ::Known { base, exact, rest } = self else {
            return (Germ::Undefined, Germ::Undefined);
        };
        let at_zero = |value: i32| is_zero(exact.as_ref()).then(|| Rational::from(value));
        let (sin, cos) = base.sin_cos();
        let Some(rest) = rest else {
            return (
                Germ::known(sin, at_zero(0), None),
                Germ::known(cos, at_zero(1), None),
            );
        };
        let Some(value) = self.value() else {
            return (Germ::Undefined, Germ::Undefined);
        };
        let (rise, slope) = value.union(base).sin_cos();
        let scaled = |slope: N| Some(rest.with(rest.factor.times(&slope)));
        (
            Germ::known(sin, at_zero(0), scaled(slope)),
            Germ::known(cos, at_zero(1), scaled(rise.negated())),
        )
    }
    fn call(&self, function: Function) -> Option<Self> {
        let same = |x: &N| x.call(function);
        Some(match function {
            Function::Exp => match self {
                Germ::Logarithm { order, factor, v } => {
                    let order = order.numer().to_i32().filter(|_| *order.denom() == 1)?;
                    let factor = factor.call(Function::Exp)?;
                    Germ::power(factor.bits(), order, factor, v.clone())
                }
                _ => self.analytic(same, same, Some(1)),
            },
            Function::Ln => self.logarithm()?,
            Function::Sin => self.sin_cos().0,
            Function::Cos => self.sin_cos().1,
            Function::Tan => {
                let slope = |x: &N| Some(one_like(x).plus(&same(x)?.squared()));
                self.analytic(same, slope, Some(0))
            }
            Function::Sinh => self.analytic(same, |x| x.call(Function::Cosh), Some(0)),
            Function::Cosh => self.analytic(same, |x| x.call(Function::Sinh), Some(1)),
            Function::Tanh => {
                let slope = |x: &N| Some(one_like(x).minus(&same(x)?.squared()));
                self.analytic(same, slope, Some(0))
            }
            Function::Atan => {
                let slope = |x: &N| one_like(x).over(&one_like(x).plus(&x.squared()));
                self.analytic(same, slope, Some(0))
            }
            Function::Erf => {
                let slope = |x: &N| {
                    let four = N::constant(x.bits(), &Rational::from(4));
                    let scale = four.over(&N::pi(x.bits()))?.sqrt()?;
                    Some(x.squared().negated().call(Function::Exp)?.times(&scale))
                };
                self.analytic(same, slope, Some(0))
            }
            Function::Abs => return None,
        })
    }
}

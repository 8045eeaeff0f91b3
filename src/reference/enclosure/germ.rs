//! Numbers as functions of a variable v, told apart from what they are at a base: x(v) = b + vᵏ y(v).
//!
//! Where b is 0 and exactly so, √x is v^(k/2) √y, which is analytic in v where y is not 0: roots that no rectangle
//! around v = 0 has. A function f of x is f(b) + vᵏ y s, and its slope s = (f(x) − f(b))/(x − b) is a mean of f′
//! between b and x, so that it lies in what f′ is on all that is in both and between.

use super::number::{Number, Plane};
use crate::symbolic::Function;
use rug::{Integer, Rational};

/// Rational numbers of more bits are not known exactly.
const MAX_EXACT: u32 = 4096;

/// x(v) on a set of v.
#[derive(Clone, Debug)]
pub(super) enum Germ<N> {
    /// b + vᵏ y(v), or b alone.
    Known {
        /// b, enclosed.
        base: N,
        /// b, where it is rational and known to be.
        exact: Option<Rational>,
        /// What is added to it.
        rest: Option<Rest<N>>,
    },
    /// k ln v + y(v), which only powers are made of.
    Logarithm {
        /// k, any rational number.
        order: Rational,
        /// y.
        factor: N,
        /// v.
        v: N,
    },
    /// Nothing is known, or there is no value.
    Undefined,
}

/// vᵏ y(v).
#[derive(Clone, Debug)]
pub(super) struct Rest<N> {
    /// k, below 0 at a pole.
    pub(super) order: i32,
    /// y.
    pub(super) factor: N,
    /// v.
    pub(super) v: N,
}

/// xᵏ, k ≥ 0; `None` for 1.
pub(super) fn power<N: Number>(x: &N, k: u32) -> Option<N> {
    let half = match k {
        0 => return None,
        1 => return Some(x.clone()),
        k => power(x, k / 2)?.squared(),
    };
    Some(if k.is_multiple_of(2) {
        half
    } else {
        half.times(x)
    })
}

impl<N: Number> Rest<N> {
    /// The factor where the same is written with a power of v that is no greater.
    fn lowered(&self, order: i32) -> N {
        match power(&self.v, self.order.abs_diff(order)) {
            Some(power) => self.factor.times(&power),
            None => self.factor.clone(),
        }
    }

    fn with(&self, factor: N) -> Rest<N> {
        Rest {
            order: self.order,
            factor,
            v: self.v.clone(),
        }
    }
}

/// The sum.
fn sum<N: Number>(parts: impl IntoIterator<Item = Rest<N>>) -> Option<Rest<N>> {
    parts.into_iter().reduce(|a, b| {
        let order = a.order.min(b.order);
        Rest {
            factor: a.lowered(order).plus(&b.lowered(order)),
            order,
            v: a.v,
        }
    })
}

fn is_zero(exact: Option<&Rational>) -> bool {
    exact.is_some_and(|q| *q == 0)
}

impl<N: Plane> Germ<N> {
    /// A number that is the same everywhere.
    pub(super) fn number(base: N, exact: Option<Rational>) -> Germ<N> {
        Germ::known(base, exact, None)
    }

    fn known(base: N, exact: Option<Rational>, rest: Option<Rest<N>>) -> Germ<N> {
        let is_short = |q: &Rational| {
            let bits = q.numer().significant_bits() + q.denom().significant_bits();
            bits <= MAX_EXACT
        };
        Germ::Known {
            base,
            exact: exact.filter(is_short),
            rest,
        }
    }

    /// vᵏ times a factor.
    pub(super) fn power(bits: u32, order: i32, factor: N, v: N) -> Germ<N> {
        let zero = Rational::new();
        let rest = Rest { order, factor, v };
        Germ::known(N::constant(bits, &zero), Some(zero), Some(rest))
    }

    /// b + vᵏ y.
    pub(super) fn value(&self) -> Option<N> {
        let Germ::Known { base, rest, .. } = self else {
            return None;
        };
        match rest {
            None => Some(base.clone()),
            Some(rest) if rest.order >= 0 => Some(base.plus(&rest.lowered(0))),
            Some(_) => None,
        }
    }

    /// The same where it is known what it is at v = 0.
    pub(super) fn based_on(self, bits: u32, q: &Rational) -> Germ<N> {
        match self {
            Germ::Known { rest, .. } if rest.as_ref().is_none_or(|rest| rest.order > 0) => {
                Germ::known(N::constant(bits, q), Some(q.clone()), rest)
            }
            other => other,
        }
    }

    /// y, where it is a number and that times v.
    pub(super) fn slope(&self) -> Option<&N> {
        match self {
            Germ::Known {
                rest: Some(rest), ..
            } if rest.order == 1 => Some(&rest.factor),
            _ => None,
        }
    }

    /// b, where it is known exactly and is all there is.
    pub(super) fn as_exact(&self) -> Option<&Rational> {
        match self {
            Germ::Known {
                exact, rest: None, ..
            } => exact.as_ref(),
            _ => None,
        }
    }

    /// f(x) where f′ is `slope`; `at_zero` is f(0) where that is rational.
    fn analytic(
        &self,
        f: impl Fn(&N) -> Option<N>,
        slope: impl Fn(&N) -> Option<N>,
        at_zero: Option<i32>,
    ) -> Germ<N> {
        let found = || {
            let Germ::Known { base, exact, rest } = self else {
                return None;
            };
            let exact = at_zero.filter(|_| is_zero(exact.as_ref()));
            let rest = match rest {
                None => None,
                Some(rest) => {
                    let slope = slope(&self.value()?.union(base))?;
                    Some(rest.with(rest.factor.times(&slope)))
                }
            };
            Some(Germ::known(f(base)?, exact.map(Rational::from), rest))
        };
        found().unwrap_or(Germ::Undefined)
    }

    fn root(&self) -> Option<Germ<N>> {
        let Germ::Known { base, exact, rest } = self else {
            return None;
        };
        if is_zero(exact.as_ref()) {
            let root = match rest {
                None => None,
                Some(rest) if rest.order % 2 == 0 => Some(Rest {
                    order: rest.order / 2,
                    ..rest.with(rest.factor.sqrt()?)
                }),
                Some(_) => return None,
            };
            return Some(Germ::known(base.clone(), exact.clone(), root));
        }
        let root = base.sqrt()?;
        let rest = match rest {
            None => None,
            Some(rest) => {
                let sum = self.value()?.sqrt()?.plus(&root);
                Some(rest.with(rest.factor.over(&sum)?))
            }
        };
        Some(Germ::known(
            root,
            exact.as_ref().and_then(rational_root),
            rest,
        ))
    }

    fn logarithm(&self) -> Option<Germ<N>> {
        match self {
            Germ::Known {
                exact,
                rest: Some(rest),
                ..
            } if is_zero(exact.as_ref()) => Some(Germ::Logarithm {
                order: Rational::from(rest.order),
                factor: rest.factor.call(Function::Ln)?,
                v: rest.v.clone(),
            }),
            Germ::Known { exact, .. } if exact.as_ref().is_some_and(|q| *q == 1) => {
                // ln 1 = 0.
                let Germ::Known { base, rest, .. } = self.by_slope_of_logarithm() else {
                    return None;
                };
                Some(Germ::known(base, Some(Rational::new()), rest))
            }
            _ => Some(self.by_slope_of_logarithm()),
        }
    }

    fn by_slope_of_logarithm(&self) -> Germ<N> {
        let slope = |x: &N| one_like(x).over(x);
        self.analytic(|x| x.call(Function::Ln), slope, None)
    }

    fn quotient(&self, divisor: &Germ<N>) -> Option<Germ<N>> {
        if let (Germ::Logarithm { order, factor, v }, Some(q)) = (self, divisor.as_exact())
            && let Germ::Known { base, .. } = divisor
            && *q != 0
        {
            return Some(Germ::Logarithm {
                order: Rational::from(order / q),
                factor: factor.over(base)?,
                v: v.clone(),
            });
        }
        let (
            Germ::Known {
                base: a,
                exact: exact_a,
                rest: rest_a,
            },
            Germ::Known {
                base: b,
                exact: exact_b,
                rest: rest_b,
            },
        ) = (self, divisor)
        else {
            return None;
        };
        let is_zero_a = is_zero(exact_a.as_ref());
        if is_zero(exact_b.as_ref()) {
            let below = rest_b.as_ref()?;
            let rest = match rest_a {
                Some(above) if is_zero_a => Rest {
                    order: above.order - below.order,
                    ..above.with(above.factor.over(&below.factor)?)
                },
                // 0 over what is not 0.
                None if is_zero_a => {
                    a.over(&below.factor)?;
                    return Some(Germ::number(b.clone(), exact_b.clone()));
                }
                _ => Rest {
                    order: -below.order,
                    ..below.with(self.value()?.over(&below.factor)?)
                },
            };
            return Some(Germ::known(b.clone(), exact_b.clone(), Some(rest)));
        }
        // a/b − p/q = (a − (p/q) b)/b less what that is at the base.
        let base = a.over(b)?;
        let whole = divisor.value()?;
        let above = rest_a.clone();
        let below = rest_b.as_ref().filter(|_| !is_zero_a);
        let below = below.map(|rest| rest.with(rest.factor.times(&base).negated()));
        let rest = match sum(above.into_iter().chain(below)) {
            None => None,
            Some(rest) => Some(rest.with(rest.factor.over(&whole)?)),
        };
        let exact = exact_a.as_ref().zip(exact_b.as_ref());
        Some(Germ::known(
            base,
            exact.map(|(a, b)| Rational::from(a / b)),
            rest,
        ))
    }
}

/// 1.
fn one_like<N: Number>(x: &N) -> N {
    N::constant(x.bits(), &Rational::from(1))
}

/// √q, where that is rational.
fn rational_root(q: &Rational) -> Option<Rational> {
    let root = |n: &Integer| n.is_perfect_square().then(|| Integer::from(n.sqrt_ref()));
    Some(Rational::from((root(q.numer())?, root(q.denom())?)))
}

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
        let (
            Germ::Known {
                base: a,
                exact: exact_a,
                rest: rest_a,
            },
            Germ::Known {
                base: b,
                exact: exact_b,
                rest: rest_b,
            },
        ) = (self, other)
        else {
            return Germ::Undefined;
        };
        let exact = exact_a.as_ref().zip(exact_b.as_ref());
        let exact = exact.map(|(a, b)| Rational::from(a + b));
        Germ::known(a.plus(b), exact, sum(rest_a.iter().chain(rest_b).cloned()))
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
        let (
            Germ::Known {
                base: a,
                exact: exact_a,
                rest: rest_a,
            },
            Germ::Known {
                base: b,
                exact: exact_b,
                rest: rest_b,
            },
        ) = (self, other)
        else {
            return Germ::Undefined;
        };
        let scaled = |rest: &Option<Rest<N>>, by: &N, exact: &Option<Rational>| {
            let rest = rest.as_ref().filter(|_| !is_zero(exact.as_ref()))?;
            Some(rest.with(rest.factor.times(by)))
        };
        let both = rest_a.as_ref().zip(rest_b.as_ref()).map(|(a, b)| Rest {
            order: a.order + b.order,
            ..a.with(a.factor.times(&b.factor))
        });
        let parts = [scaled(rest_a, b, exact_b), scaled(rest_b, a, exact_a), both];
        let rest = sum(parts.into_iter().flatten());
        if is_zero(exact_a.as_ref()) || is_zero(exact_b.as_ref()) {
            let zero = Rational::new();
            return Germ::known(N::constant(a.bits(), &zero), Some(zero), rest);
        }
        let exact = exact_a.as_ref().zip(exact_b.as_ref());
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

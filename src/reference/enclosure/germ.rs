//! Numbers as functions of a variable v, told apart from what they are at a base: x(v) = b + vᵏ y(v).
//!
//! Where b is 0 and exactly so, √x is v^(k/2) √y, which is analytic in v where y is not 0: roots that no rectangle
//! around v = 0 has. A function f of x is f(b) + vᵏ y s, and its slope s = (f(x) − f(b))/(x − b) is a mean of f′
//! between b and x, so that it lies in what f′ is on all that is in both and between.

mod functions;
mod operations;

use super::number::{Number, Plane};
use rug::Rational;

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

/// b, b exactly and what is added to it.
type Parts<'a, N> = (&'a N, Option<&'a Rational>, Option<&'a Rest<N>>);

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

    /// `None` of what is no such sum.
    fn parts(&self) -> Option<Parts<'_, N>> {
        match self {
            Germ::Known { base, exact, rest } => Some((base, exact.as_ref(), rest.as_ref())),
            Germ::Logarithm { .. } | Germ::Undefined => None,
        }
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
}

/// 1.
fn one_like<N: Number>(x: &N) -> N {
    N::constant(x.bits(), &Rational::from(1))
}

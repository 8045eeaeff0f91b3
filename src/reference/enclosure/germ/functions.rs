//! Functions and quotients of numbers around a base.

use super::{Germ, Rest, is_zero, one_like, sum};
use crate::reference::enclosure::number::Plane;
use crate::symbolic::Function;
use rug::{Integer, Rational};

impl<N: Plane> Germ<N> {
    /// f(x) where f′ is `slope`; `at_zero` is f(0) where that is rational.
    pub(super) fn analytic(
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

    /// √x.
    pub(super) fn root(&self) -> Option<Germ<N>> {
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

    /// ln x.
    pub(super) fn logarithm(&self) -> Option<Germ<N>> {
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

    /// x over another number.
    pub(super) fn quotient(&self, divisor: &Germ<N>) -> Option<Germ<N>> {
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
        let (Some((a, exact_a, rest_a)), Some((b, exact_b, rest_b))) =
            (self.parts(), divisor.parts())
        else {
            return None;
        };
        let is_zero_a = is_zero(exact_a);
        if is_zero(exact_b) {
            let below = rest_b?;
            let rest = match rest_a {
                Some(above) if is_zero_a => Rest {
                    order: above.order - below.order,
                    ..above.with(above.factor.over(&below.factor)?)
                },
                // 0 over what is not 0.
                None if is_zero_a => {
                    a.over(&below.factor)?;
                    return Some(Germ::number(b.clone(), exact_b.cloned()));
                }
                _ => Rest {
                    order: -below.order,
                    ..below.with(self.value()?.over(&below.factor)?)
                },
            };
            return Some(Germ::known(b.clone(), exact_b.cloned(), Some(rest)));
        }
        // a/b − p/q = (a − (p/q) b)/b less what that is at the base.
        let base = a.over(b)?;
        let whole = divisor.value()?;
        let above = rest_a.cloned();
        let below = rest_b.filter(|_| !is_zero_a);
        let below = below.map(|rest| rest.with(rest.factor.times(&base).negated()));
        let rest = match sum(above.into_iter().chain(below)) {
            None => None,
            Some(rest) => Some(rest.with(rest.factor.over(&whole)?)),
        };
        let exact = exact_a.zip(exact_b);
        Some(Germ::known(
            base,
            exact.map(|(a, b)| Rational::from(a / b)),
            rest,
        ))
    }
}

/// √q, where that is rational.
fn rational_root(q: &Rational) -> Option<Rational> {
    let root = |n: &Integer| n.is_perfect_square().then(|| Integer::from(n.sqrt_ref()));
    Some(Rational::from((root(q.numer())?, root(q.denom())?)))
}

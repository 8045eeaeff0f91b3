//! The recipe that cannot fail: emission as a polynomial of the depth.

use crate::symbolic::{Expr, expand};

/// The highest degree of an emission.
const MAX_DEGREE: usize = 64;

/// P̃ = P + P′ + P″ + … of a polynomial P in `t`; `None` where the derivatives do not end.
pub(super) fn sum_of_derivatives(polynomial: &Expr) -> Option<Expr> {
    let mut derivative = expand(polynomial)?;
    let mut all = Vec::new();
    for _ in 0..=MAX_DEGREE {
        if derivative.is(0) {
            return expand(&Expr::sum(all));
        }
        all.push(derivative.clone());
        derivative = expand(&derivative.differentiate("t"))?;
    }
    derivative.is(0).then(|| Expr::sum(all))
}

/// I = P̃(0) − P̃(t) e^(−t) at the depth t(λ).
pub(super) fn radiance(sum: &Expr, depth: &Expr) -> Expr {
    let at_zero = sum.substitute("t", &Expr::number(0)).simplify();
    at_zero - sum.substitute("t", depth) * (-depth).exp()
}

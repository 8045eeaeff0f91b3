//! What cancels between both ends of the ray.

use super::derive::Derived;
use crate::case::END_DERIVATIVES;
use crate::symbolic::{Expr, ZeroTest, expand, refute_zero, zero_test};
use rug::Rational;

/// Up to this derivative all are looked at; beyond, only those of integrands where one of these is the same
/// at both ends: where higher ones are, by symmetry or because the medium fades out, lower ones are too.
const ALWAYS: usize = 3;
/// Derivatives of more nodes than this are not looked at: nobody chose them to vanish.
const MAX_NODES: usize = 2000;

/// Whether derivative k is certainly the same at both ends, for an integrand that is analytic.
pub(super) fn equal_derivatives(length: &Rational, derived: &Derived) -> [bool; END_DERIVATIVES] {
    let attenuation = derived.depth.as_ref().map(|depth| (-depth).exp());
    let ends = [Expr::number(length.clone()), Expr::number(0)];
    let is_equal = |factor: &Expr| {
        let at_ends = ends.each_ref().map(|end| factor.substitute("lambda", end));
        let Some(attenuation) = &attenuation else {
            // Whatever e^(−t) is at the far end, what is 0 at both is equal.
            return at_ends.iter().all(certainly_vanishes);
        };
        let [far, near] = ends
            .each_ref()
            .map(|end| attenuation.substitute("lambda", end));
        let [at_far_end, at_near_end] = at_ends;
        certainly_vanishes(&(at_far_end * far - at_near_end * near))
    };
    let mut equal = [false; END_DERIVATIVES];
    // (g e^(−t))′ = (g′ − τ g) e^(−t)
    let mut factor = &derived.emission * &derived.extinction;
    for k in 0..END_DERIVATIVES {
        if k > ALWAYS && !equal.contains(&true) {
            break;
        }
        if k > 0 {
            let loss = &derived.extinction * &factor;
            factor = factor.differentiate("lambda") - loss;
        }
        factor = expand(&factor).unwrap_or(factor);
        if factor.nodes().len() > MAX_NODES {
            break;
        }
        if let Some(slot) = equal.get_mut(k) {
            *slot = is_equal(&factor);
        }
    }
    equal
}

/// Whether C τ at the front, less C τ e^(−t) at the far end, is certainly τ at the front times the radiance, for
/// a medium that is analytic.
pub(super) fn end_samples_cancel(length: &Rational, derived: &Derived) -> bool {
    let (Some(depth), Some(radiance)) = (&derived.depth, &derived.radiance) else {
        return false;
    };
    let far = Expr::number(length.clone());
    let front = Expr::number(0);
    let source = &derived.emission * &derived.extinction;
    let attenuated = source.substitute("lambda", &far) * (-depth.substitute("lambda", &far)).exp();
    let seen =
        derived.extinction.substitute("lambda", &front) * radiance.substitute("lambda", &far);
    let difference = source.substitute("lambda", &front) - attenuated - seen;
    let difference = expand(&difference).unwrap_or(difference);
    difference.nodes().len() <= MAX_NODES && certainly_vanishes(&difference)
}

/// Whether a constant is defined, and 0.
fn certainly_vanishes(constant: &Expr) -> bool {
    // Nearly all are not, which is quicker to see than that it is unknown.
    refute_zero(constant, &[]).is_none()
        && constant.enclose(64, &|_| None).is_ok()
        && zero_test(constant, &[]) == ZeroTest::Proved
}

//! Polynomials with coefficients in a format, lowest first.

use crate::real::{Format, Real, row};
use rug::Rational;

/// p(x) by Horner's scheme.
pub(super) fn evaluate<R: Real>(polynomial: &[R], x: &R) -> R {
    let mut terms = polynomial.iter().rev();
    let Some(mut value) = terms.next().cloned() else {
        return x.format().int(0);
    };
    for coefficient in terms {
        value *= x;
        value += coefficient;
    }
    value
}

/// outer(inner(x)); the outer coefficients are exact.
pub(super) fn compose<R: Real>(outer: &[Rational], inner: &[R], format: R::Format) -> Vec<R> {
    let mut terms = outer.iter().rev();
    let Some(last) = terms.next() else {
        return vec![format.int(0)];
    };
    let mut result = vec![format.ratio(last)];
    for coefficient in terms {
        result = multiply(&result, inner, format);
        if let Some(constant) = result.first_mut() {
            *constant += &format.ratio(coefficient);
        }
    }
    result
}

fn multiply<R: Real>(a: &[R], b: &[R], format: R::Format) -> Vec<R> {
    let mut product = vec![format.int(0); (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate() {
        for (y, slot) in b.iter().zip(&mut product[i..]) {
            *slot += &(x.clone() * y);
        }
    }
    product
}

/// factor · ∫₀ˣ p, without its constant term, which is 0: coefficient k belongs to x^(k+1).
pub(super) fn antiderivative<R: Real>(polynomial: &[R], factor: &R) -> Vec<R> {
    let integrated = |(k, c): (i64, &R)| c.clone() * factor / &factor.format().int(k);
    row((1..).zip(polynomial).map(integrated))
}

/// p(origin + scale·x).
pub(super) fn shift<R: Real>(polynomial: &[R], origin: &R, scale: &R) -> Vec<R> {
    let mut shifted = polynomial.to_vec();
    let length = shifted.len();
    // Repeated synthetic division by x − origin.
    for start in 0..length {
        for k in (start..length.saturating_sub(1)).rev() {
            let carried = shifted[k + 1].clone() * origin;
            shifted[k] += &carried;
        }
    }
    let mut power = scale.clone();
    for coefficient in shifted.iter_mut().skip(1) {
        *coefficient *= &power;
        power *= scale;
    }
    shifted
}

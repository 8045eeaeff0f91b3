//! Division without remainder.

use super::polynomial::{MAX_TERMS, Polynomial};
use rug::Rational;

/// The quotient, where it is a polynomial; leading terms are divided until nothing is left.
///
/// Terms of the dividend may have negative exponents: what all of them share is no obstacle.
pub(super) fn exact(dividend: &Polynomial, divisor: &Polynomial) -> Option<Polynomial> {
    let (content, mut rest) = dividend.split_content();
    let (leading, leading_coefficient) = divisor.leading()?;
    let inverse = leading.inverse();
    let mut quotient = Polynomial::default();
    while let Some((monomial, coefficient)) = rest.leading() {
        let monomial = monomial.product(&inverse);
        if !monomial.is_entire() || quotient.len() == MAX_TERMS {
            return None;
        }
        let coefficient = Rational::from(coefficient / leading_coefficient);
        rest = rest.sum(&divisor.scaled(&monomial, &Rational::from(-&coefficient)))?;
        quotient.add(&monomial, &coefficient);
    }
    Some(quotient.times(&content))
}

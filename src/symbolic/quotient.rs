//! Quotients with common factors cancelled: how C = I′/(τ e^(−t)) becomes a formula one can read.

mod division;
mod expand;
mod polynomial;

use super::Expr;
use expand::Expander;
use polynomial::Polynomial;

/// `numerator / denominator` with common factors cancelled.
///
/// Both are expanded into polynomials in whatever they are made of (symbols, exponentials, sines …), like
/// terms joined, and the numerator divided by the denominator where that goes without remainder;
/// otherwise common factors of all terms are cancelled. The result equals the quotient wherever both have a
/// value, but it may have a value where the quotient has none: sin²λ/sin λ becomes sin λ. That is what it is
/// for; whoever relies on more has to prove it of the result.
///
/// `None` where the denominator is 0, or expands into more terms than is reasonable.
///
/// ```
/// use volver::symbolic::{Expr, quotient};
///
/// let depth: Expr = "sin(x^2)/2".parse()?;
/// let radiance: Expr = "2 - (sin(x^2) + 2)*exp(-sin(x^2)/2)".parse()?;
/// let source = radiance.differentiate("x");
/// let weight = depth.differentiate("x") * (-depth).exp();
/// assert_eq!(quotient(&source, &weight).map(|c| c.to_string()), Some("sin(x^2)".into()));
/// # Ok::<(), volver::symbolic::ParseError>(())
/// ```
#[must_use]
pub fn quotient(numerator: &Expr, denominator: &Expr) -> Option<Expr> {
    let mut expander = Expander::new();
    let (above, below) = (
        expander.fraction(numerator)?,
        expander.fraction(denominator)?,
    );
    if below.numerator.is_zero() {
        return None;
    }
    if above.numerator.is_zero() {
        return Some(Expr::number(0));
    }
    let mut numerator = above.numerator;
    let mut divisors = above.divisors;
    for divisor in below.divisors {
        // Factors that both quotients have in their denominators are gone.
        if let Some(place) = divisors.iter().position(|other| *other == divisor) {
            divisors.swap_remove(place);
        } else {
            numerator = numerator.product(&divisor)?;
        }
    }
    divisors.push(below.numerator);
    let mut left = Vec::new();
    for divisor in divisors {
        let (content, rest) = divisor.split_content();
        numerator = numerator.times(&content.inverse());
        match division::exact(&numerator, &rest) {
            Some(quotient) => numerator = quotient,
            None => left.push(rest),
        }
    }
    let divisor = left
        .into_iter()
        .try_fold(Polynomial::one(), |product, divisor| {
            product.product(&divisor)
        })?;
    let above = expander.expr(&numerator);
    if divisor.is_one() {
        return Some(above);
    }
    Some(above / expander.expr(&divisor))
}

/// The expression as a sum of products with like terms joined; `None` where that is too long.
#[must_use]
pub fn expand(expr: &Expr) -> Option<Expr> {
    quotient(expr, &Expr::number(1))
}

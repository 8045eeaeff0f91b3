//! Expressions as terms of the proof assistant Coq, over its real numbers.

use super::print::is_half;
use super::{Expr, Function, Kind};
use rug::Rational;

/// What no term of the elementary functions that Coq differentiates says.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CoqError {
    /// |x|, min, max or a piecewise expression.
    #[error("'{part}' has branches (allowed: one formula for all of the ray)")]
    Branches {
        /// The part of the expression.
        part: String,
    },
    /// A power that is neither whole nor a square root.
    #[error("'{part}' is a fractional power (allowed: whole exponents and sqrt)")]
    FractionalPower {
        /// The part of the expression.
        part: String,
    },
}

/// How tightly a term holds together; looser terms go in parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Power,
    Application,
    Atom,
}

impl Expr {
    /// The expression as a term of Coq in `R_scope`; erf is the one of `proofs/theory/Erf.v`.
    ///
    /// ```
    /// use volver::symbolic::Expr;
    ///
    /// let transmittance: Expr = "exp(-sin(lambda^2)/2)".parse()?;
    /// assert_eq!(transmittance.to_coq()?, "exp (-1 / 2 * sin (lambda ^ 2))");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CoqError`] where the expression has branches or a fractional power.
    pub fn to_coq(&self) -> Result<String, CoqError> {
        match self.kind() {
            Kind::Number(q) => Ok(number(q)),
            Kind::Pi => Ok("PI".into()),
            Kind::Symbol(name) => Ok(name.to_string()),
            Kind::Sum(terms) => sum(terms),
            Kind::Product(factors) => product(factors),
            Kind::Power(base, exponent) if *exponent < 0 => Ok(format!(
                "1 / {}",
                self.power(base, &Rational::from(-exponent))?
            )),
            Kind::Power(base, exponent) => self.power(base, exponent),
            Kind::Call(Function::Abs, _) | Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..) => {
                Err(CoqError::Branches {
                    part: self.to_string(),
                })
            }
            Kind::Call(function, argument) => {
                Ok(format!("{function} {}", at(argument, Strength::Atom)?))
            }
        }
    }

    /// A positive power; `self` is what an error shows.
    fn power(&self, base: &Expr, exponent: &Rational) -> Result<String, CoqError> {
        if is_half(exponent) {
            return Ok(format!("sqrt {}", at(base, Strength::Atom)?));
        }
        if *exponent.denom() != 1 {
            return Err(CoqError::FractionalPower {
                part: self.to_string(),
            });
        }
        if *exponent == 1 {
            return at(base, Strength::Power);
        }
        Ok(format!("{} ^ {exponent}", at(base, Strength::Application)?))
    }
}

fn at(expr: &Expr, least: Strength) -> Result<String, CoqError> {
    let term = expr.to_coq()?;
    if strength(expr) < least {
        Ok(format!("({term})"))
    } else {
        Ok(term)
    }
}

fn strength(expr: &Expr) -> Strength {
    match expr.kind() {
        Kind::Number(q) if *q < 0 => Strength::Sum,
        Kind::Number(q) if *q.denom() != 1 => Strength::Product,
        Kind::Sum(_) => Strength::Sum,
        Kind::Product(factors) => match factors.first().and_then(Expr::as_number) {
            Some(q) if *q < 0 => Strength::Sum,
            _ => Strength::Product,
        },
        Kind::Power(_, exponent) if *exponent < 0 => Strength::Product,
        Kind::Power(_, exponent) if is_half(exponent) => Strength::Application,
        Kind::Power(..) => Strength::Power,
        Kind::Call(..) => Strength::Application,
        _ => Strength::Atom,
    }
}

fn number(q: &Rational) -> String {
    if *q.denom() == 1 {
        q.to_string()
    } else {
        format!("{} / {}", q.numer(), q.denom())
    }
}

fn sum(terms: &[Expr]) -> Result<String, CoqError> {
    let mut text = String::new();
    for (i, term) in terms.iter().enumerate() {
        if i == 0 {
            text += &term.to_coq()?;
        } else if strength(term) == Strength::Sum {
            // Only a minus sign in front makes a term so loose: sums in sums are flat.
            text += " - ";
            text += &at(&-term, Strength::Product)?;
        } else {
            text += " + ";
            text += &at(term, Strength::Product)?;
        }
    }
    Ok(text)
}

fn product(factors: &[Expr]) -> Result<String, CoqError> {
    let mut text = String::new();
    for (i, factor) in factors.iter().enumerate() {
        match factor.kind() {
            // Only the first factor is a number: its sign stands before the whole product.
            Kind::Number(q) if i == 0 && *q == -1 => text += "- ",
            Kind::Number(q) if i == 0 => text += &number(q),
            Kind::Power(base, exponent) if *exponent < 0 => {
                text += if text.is_empty() || text == "- " {
                    "1 / "
                } else {
                    " / "
                };
                text += &factor.power(base, &Rational::from(-exponent))?;
            }
            _ => {
                if !(text.is_empty() || text == "- ") {
                    text += " * ";
                }
                text += &at(factor, Strength::Power)?;
            }
        }
    }
    Ok(text)
}

//! Expressions as text that reads back as the same expression.

use super::{Expr, Kind};
use rug::Rational;
use std::fmt::{self, Display, Write};

/// How tightly a piece of text holds together; looser text goes in parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Power,
    Atom,
}

impl Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_at(f, self, Strength::Sum)
    }
}

fn write_at(f: &mut fmt::Formatter<'_>, expr: &Expr, least: Strength) -> fmt::Result {
    if strength(expr) < least {
        f.write_char('(')?;
        write(f, expr)?;
        f.write_char(')')
    } else {
        write(f, expr)
    }
}

/// How tightly the text of an expression holds together.
fn strength(expr: &Expr) -> Strength {
    match expr.kind() {
        Kind::Number(q) if *q < 0 => Strength::Sum,
        Kind::Number(q) if *q.denom() != 1 => Strength::Product,
        Kind::Sum(_) => Strength::Sum,
        Kind::Product(factors) => match factors[0].as_number() {
            Some(q) if *q < 0 => Strength::Sum,
            _ => Strength::Product,
        },
        Kind::Power(_, exponent) if *exponent < 0 => Strength::Product,
        Kind::Power(_, exponent) if !is_half(exponent) => Strength::Power,
        _ => Strength::Atom,
    }
}

fn write(f: &mut fmt::Formatter<'_>, expr: &Expr) -> fmt::Result {
    match expr.kind() {
        Kind::Number(q) => write!(f, "{q}"),
        Kind::Pi => f.write_str("pi"),
        Kind::Symbol(name) => f.write_str(name),
        Kind::Sum(terms) => {
            for (i, term) in terms.iter().enumerate() {
                match (i, opposite(term)) {
                    (0, _) => write_at(f, term, Strength::Sum)?,
                    (_, Some(opposite)) => {
                        f.write_str(" - ")?;
                        write_at(f, &opposite, Strength::Product)?;
                    }
                    (_, None) => {
                        f.write_str(" + ")?;
                        write_at(f, term, Strength::Product)?;
                    }
                }
            }
            Ok(())
        }
        Kind::Product(factors) => write_product(f, factors),
        Kind::Power(base, exponent) if *exponent < 0 => {
            f.write_str("1/")?;
            write_power(f, base, &Rational::from(-exponent))
        }
        Kind::Power(base, exponent) => write_power(f, base, exponent),
        Kind::Call(function, argument) => write!(f, "{function}({argument})"),
        Kind::Min(a, b) => write!(f, "min({a}, {b})"),
        Kind::Max(a, b) => write!(f, "max({a}, {b})"),
        Kind::Piecewise(branches, otherwise) => {
            f.write_str("piecewise(")?;
            for branch in branches {
                let condition = &branch.condition;
                write!(
                    f,
                    "{} {} {}, {}, ",
                    condition.left,
                    condition.relation.as_str(),
                    condition.right,
                    branch.value
                )?;
            }
            write!(f, "{otherwise})")
        }
    }
}

/// −x for a term that is written with a minus sign in front.
fn opposite(term: &Expr) -> Option<Expr> {
    match term.kind() {
        Kind::Number(q) if *q < 0 => Some(-term),
        Kind::Product(factors) if factors[0].as_number().is_some_and(|q| *q < 0) => Some(-term),
        _ => None,
    }
}

fn write_product(f: &mut fmt::Formatter<'_>, factors: &[Expr]) -> fmt::Result {
    let mut first = true;
    for factor in factors {
        match factor.kind() {
            Kind::Number(q) if first && *q == -1 => {
                f.write_char('-')?;
                continue;
            }
            // Only the first factor is a number: its sign stands before the whole product.
            Kind::Number(q) => write!(f, "{q}")?,
            Kind::Power(base, exponent) if *exponent < 0 => {
                f.write_str(if first { "1/" } else { "/" })?;
                write_power(f, base, &Rational::from(-exponent))?;
            }
            _ => {
                if !first {
                    f.write_char('*')?;
                }
                write_at(f, factor, Strength::Power)?;
            }
        }
        first = false;
    }
    Ok(())
}

/// Whether this is the exponent of a square root.
pub(super) fn is_half(exponent: &Rational) -> bool {
    *exponent.numer() == 1 && *exponent.denom() == 2
}

/// A positive power.
fn write_power(f: &mut fmt::Formatter<'_>, base: &Expr, exponent: &Rational) -> fmt::Result {
    if is_half(exponent) {
        return write!(f, "sqrt({base})");
    }
    if *exponent == 1 {
        return write_at(f, base, Strength::Power);
    }
    write_at(f, base, Strength::Atom)?;
    if *exponent.denom() == 1 && *exponent >= 0 {
        write!(f, "^{exponent}")
    } else {
        write!(f, "^({exponent})")
    }
}

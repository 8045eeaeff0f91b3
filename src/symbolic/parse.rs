//! Reading expressions.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = ("+" | "-") signed | power
//! power   = atom [ "^" signed ]                  the exponent must come out as a rational number
//! atom    = number | name | name "(" arguments ")" | "(" sum ")"
//! number  = digits [ "." digits ] [ "e" ["+" | "-"] digits ]
//! ```
//!
//! Functions are those of [`Function`] and `sqrt`, `min(a, b)`, `max(a, b)` and
//! `piecewise(condition, value, …, otherwise)` with conditions `a < b`, `<=`, `>`, `>=`. `pi` is π; every
//! other name is a symbol. A sign binds less tightly than a power: −x² is −(x²).

mod error;
mod number;
mod token;

pub use error::{ParseError, Problem};

use super::{Branch, Condition, Expr, Function, Kind, Relation};
use rug::Rational;
use std::str::FromStr;
use token::{Token, Tokens};

/// The longest text that is read.
pub const MAX_TEXT: usize = 1 << 16;
/// The deepest nesting that is read.
pub const MAX_DEPTH: usize = 100;
/// The most numbers, names and operations that are read.
pub const MAX_TOKENS: usize = 1 << 13;
/// The most bits of the numbers that a sum or a product joins into one.
pub const MAX_BITS: u64 = 1 << 16;
/// The greatest numerator and denominator of an exponent.
pub const MAX_EXPONENT: u32 = 1000;

impl FromStr for Expr {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Expr, ParseError> {
        if text.len() > MAX_TEXT {
            return Err(ParseError::new(
                text,
                MAX_TEXT,
                Problem::TooLong { bytes: text.len() },
            ));
        }
        let mut parser = Parser {
            text,
            tokens: Tokens::new(text)?,
            depth: 0,
        };
        let expr = parser.sum()?;
        match parser.tokens.peek() {
            (_, Token::End) => Ok(expr),
            (at, Token::Close) => Err(parser.error(at, Problem::Unopened)),
            (at, token) => Err(parser.error(
                at,
                Problem::ExpectedOperator {
                    found: token.to_string(),
                },
            )),
        }
    }
}

struct Parser<'t> {
    text: &'t str,
    tokens: Tokens<'t>,
    depth: usize,
}

impl Parser<'_> {
    fn error(&self, at: usize, problem: Problem) -> ParseError {
        ParseError::new(self.text, at, problem)
    }

    /// Runs `inside` one level deeper.
    fn deeper<T>(
        &mut self,
        inside: impl FnOnce(&mut Self) -> Result<T, ParseError>,
    ) -> Result<T, ParseError> {
        if self.depth == MAX_DEPTH {
            let (at, _) = self.tokens.peek();
            return Err(self.error(at, Problem::TooDeep));
        }
        self.depth += 1;
        let result = inside(self);
        self.depth -= 1;
        result
    }

    /// Refuses to join numbers that would take long: their bits add up.
    fn check_numbers(&self, at: usize, parts: &[Expr]) -> Result<(), ParseError> {
        let bits = |q: &Rational| {
            u64::from(q.numer().significant_bits()) + u64::from(q.denom().significant_bits())
        };
        let numbers = parts.iter().filter_map(|part| match part.kind() {
            // A product may begin with a number.
            Kind::Product(factors) => factors.first()?.as_number(),
            _ => part.as_number(),
        });
        if numbers.map(bits).sum::<u64>() > MAX_BITS {
            return Err(self.error(at, Problem::NumbersTooLong));
        }
        Ok(())
    }

    fn sum(&mut self) -> Result<Expr, ParseError> {
        let (at, _) = self.tokens.peek();
        let mut terms = vec![self.product()?];
        loop {
            match self.tokens.peek() {
                (_, Token::Plus) => {
                    self.tokens.next();
                    terms.push(self.product()?);
                }
                (_, Token::Minus) => {
                    self.tokens.next();
                    terms.push(-self.product()?);
                }
                _ => {
                    self.check_numbers(at, &terms)?;
                    return Ok(Expr::sum(terms));
                }
            }
        }
    }

    fn product(&mut self) -> Result<Expr, ParseError> {
        let (start, _) = self.tokens.peek();
        let mut factors = vec![self.signed()?];
        loop {
            match self.tokens.peek() {
                (_, Token::Times) => {
                    self.tokens.next();
                    factors.push(self.signed()?);
                }
                (at, Token::Over) => {
                    self.tokens.next();
                    let divisor = self.signed()?;
                    if divisor.is(0) {
                        return Err(self.error(at, Problem::DivisionByZero));
                    }
                    factors.push(divisor.recip());
                }
                _ => {
                    self.check_numbers(start, &factors)?;
                    return Ok(Expr::product(factors));
                }
            }
        }
    }

    fn signed(&mut self) -> Result<Expr, ParseError> {
        match self.tokens.peek() {
            (_, Token::Minus) => {
                self.tokens.next();
                Ok(-self.deeper(Self::signed)?)
            }
            (_, Token::Plus) => {
                self.tokens.next();
                self.deeper(Self::signed)
            }
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Result<Expr, ParseError> {
        let base = self.atom()?;
        let (at, Token::Caret) = self.tokens.peek() else {
            return Ok(base);
        };
        self.tokens.next();
        let (exponent_at, _) = self.tokens.peek();
        let exponent = self.deeper(Self::signed)?;
        let Some(exponent) = exponent.as_number() else {
            return Err(self.error(exponent_at, Problem::ExponentNotConstant));
        };
        if *exponent.numer().as_abs() > MAX_EXPONENT || *exponent.denom() > MAX_EXPONENT {
            return Err(self.error(exponent_at, Problem::ExponentTooLarge));
        }
        if base.is(0) && *exponent == 0 {
            return Err(self.error(at, Problem::ZeroToTheZero));
        }
        if base.is(0) && *exponent < 0 {
            return Err(self.error(at, Problem::DivisionByZero));
        }
        Ok(base.pow(exponent.clone()))
    }

    fn atom(&mut self) -> Result<Expr, ParseError> {
        let (at, token) = self.tokens.next();
        match token {
            Token::Number(digits) => match number::read(digits) {
                Some(q) => Ok(Expr::number(q)),
                None => Err(self.error(at, Problem::NumberTooLarge)),
            },
            Token::Name(name) => match self.tokens.peek() {
                (_, Token::Open) => self.call(at, name),
                _ if is_function(name) => Err(self.error(
                    at + name.len(),
                    Problem::MissingArguments {
                        function: name.into(),
                    },
                )),
                _ if name == "pi" => Ok(Expr::pi()),
                _ => Ok(Expr::symbol(name)),
            },
            Token::Open => {
                let inner = self.deeper(Self::sum)?;
                self.close(at, "')'")?;
                Ok(inner)
            }
            found => Err(self.error(
                at,
                Problem::ExpectedOperand {
                    found: found.to_string(),
                },
            )),
        }
    }

    /// The closing parenthesis that belongs to the one at `opened`.
    fn close(&mut self, opened: usize, allowed: &'static str) -> Result<(), ParseError> {
        match self.tokens.next() {
            (_, Token::Close) => Ok(()),
            (at, Token::End) => Err(self.error(at, Problem::Unclosed { opened })),
            (at, found) => Err(self.error(
                at,
                Problem::Expected {
                    found: found.to_string(),
                    allowed,
                },
            )),
        }
    }

    fn call(&mut self, at: usize, name: &str) -> Result<Expr, ParseError> {
        if !is_function(name) {
            return Err(self.error(at, Problem::UnknownFunction { name: name.into() }));
        }
        let (opened, _) = self.tokens.next();
        if name == "piecewise" {
            let result = self.deeper(Self::branches)?;
            self.close(opened, "',' or ')'")?;
            return Ok(result);
        }
        let mut arguments = Vec::new();
        if !matches!(self.tokens.peek(), (_, Token::Close)) {
            arguments.push(self.deeper(Self::sum)?);
            while let (_, Token::Comma) = self.tokens.peek() {
                self.tokens.next();
                arguments.push(self.deeper(Self::sum)?);
            }
        }
        self.close(opened, "an operator, ',' or ')'")?;
        let wanted = if matches!(name, "min" | "max") { 2 } else { 1 };
        match (name, Function::from_name(name), &arguments[..]) {
            ("min", _, [a, b]) => Ok(a.min(b)),
            ("max", _, [a, b]) => Ok(a.max(b)),
            ("sqrt", _, [a]) => Ok(a.sqrt()),
            (_, Some(function), [a]) => Ok(a.call(function)),
            _ => Err(self.error(
                at,
                Problem::ArgumentCount {
                    function: name.into(),
                    given: arguments.len(),
                    wanted,
                },
            )),
        }
    }

    /// What stands inside `piecewise( … )`.
    fn branches(&mut self) -> Result<Expr, ParseError> {
        let mut branches = Vec::new();
        loop {
            let left = self.sum()?;
            let relation = match self.tokens.peek() {
                (_, Token::Compare(relation)) => relation,
                (_, Token::Close) if !branches.is_empty() => {
                    return Ok(Expr::piecewise(branches, left));
                }
                (at, found) => {
                    return Err(self.error(
                        at,
                        Problem::Expected {
                            found: found.to_string(),
                            allowed: "a condition like 'x < 1/2', and a last value without one",
                        },
                    ));
                }
            };
            self.tokens.next();
            let condition = Condition {
                left,
                relation,
                right: self.sum()?,
            };
            self.comma()?;
            branches.push(Branch {
                condition,
                value: self.sum()?,
            });
            self.comma()?;
        }
    }

    fn comma(&mut self) -> Result<(), ParseError> {
        match self.tokens.next() {
            (_, Token::Comma) => Ok(()),
            (at, found) => Err(self.error(
                at,
                Problem::Expected {
                    found: found.to_string(),
                    allowed: "an operator or ','",
                },
            )),
        }
    }
}

fn is_function(name: &str) -> bool {
    matches!(name, "sqrt" | "min" | "max" | "piecewise") || Function::from_name(name).is_some()
}

/// The exact number that is written, for `--option` values and files: an integer, a decimal or a quotient.
///
/// # Errors
/// [`ParseError`] where the text is no expression, or one that is no number.
pub fn parse_number(text: &str) -> Result<Rational, ParseError> {
    let expr: Expr = text.parse()?;
    match expr.as_number() {
        Some(q) => Ok(q.clone()),
        None => Err(ParseError::new(text, 0, Problem::NotANumber)),
    }
}

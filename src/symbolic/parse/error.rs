//! What is wrong with a text, and where.

use super::{MAX_BITS, MAX_DEPTH, MAX_EXPONENT, MAX_TEXT, MAX_TOKENS};
use crate::symbolic::Function;

/// What is wrong with a text, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column {column}: {problem}")]
pub struct ParseError {
    /// The character it is about, counted from 1.
    pub column: usize,
    /// What is wrong.
    pub problem: Problem,
    /// The text around the place, and how many characters of it stand before the place.
    excerpt: (String, usize),
}

/// What can be wrong with the text of an expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Problem {
    /// Too many bytes.
    #[error("{bytes} bytes are too long an expression (allowed: up to {MAX_TEXT})")]
    TooLong {
        /// How many.
        bytes: usize,
    },
    /// Too many words.
    #[error("too long an expression (allowed: up to {MAX_TOKENS} numbers, names and signs)")]
    TooManyTokens,
    /// Nested too deeply.
    #[error("too deeply nested (allowed: up to {MAX_DEPTH} levels)")]
    TooDeep,
    /// A character that means nothing here.
    #[error(
        "unexpected character '{}' (allowed: ASCII letters, digits, + - * / ^ . , < > = and parentheses)",
        found.escape_default()
    )]
    UnexpectedCharacter {
        /// The character.
        found: char,
    },
    /// Something else than an operand.
    #[error("expected a number, a name or '(', found {found}")]
    ExpectedOperand {
        /// What stands there.
        found: String,
    },
    /// Something else than an operator or the end.
    #[error("expected an operator or the end, found {found} (a product is written with '*')")]
    ExpectedOperator {
        /// What stands there.
        found: String,
    },
    /// Something else than what may stand there.
    #[error("found {found} (allowed: {allowed})")]
    Expected {
        /// What stands there.
        found: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// An opening parenthesis without its closing one.
    #[error("the '(' of column {} is not closed (allowed: ')')", opened + 1)]
    Unclosed {
        /// The byte where it was opened; only ASCII stands before it.
        opened: usize,
    },
    /// A closing parenthesis without its opening one.
    #[error("')' closes nothing (allowed: an operator or the end)")]
    Unopened,
    /// No such function.
    #[error("unknown function '{name}' (allowed: {})", function_names())]
    UnknownFunction {
        /// The name.
        name: String,
    },
    /// A function's name without arguments.
    #[error("'{function}' is a function (allowed: '(' after its name)")]
    MissingArguments {
        /// The name.
        function: String,
    },
    /// Too many or too few arguments.
    #[error("{given} arguments of '{function}' (allowed: {wanted})")]
    ArgumentCount {
        /// The name.
        function: String,
        /// How many were given.
        given: usize,
        /// How many it has.
        wanted: usize,
    },
    /// A number of too many digits or too great an exponent.
    #[error("too large a number (allowed: up to 1000 digits, powers of ten from -1000 to 1000)")]
    NumberTooLarge,
    /// Numbers that are too long to be added or multiplied.
    #[error("too long numbers to join (allowed: up to {MAX_BITS} bits together)")]
    NumbersTooLong,
    /// An exponent with symbols in it.
    #[error("the exponent is no rational number (allowed: numbers; a^b is exp(b*ln(a)))")]
    ExponentNotConstant,
    /// An exponent that is too large.
    #[error("too large an exponent (allowed: numerator and denominator up to {MAX_EXPONENT})")]
    ExponentTooLarge,
    /// 0^0.
    #[error("0^0 has no value (allowed: a positive exponent of 0)")]
    ZeroToTheZero,
    /// Division by 0.
    #[error("division by zero (allowed: divisors other than 0)")]
    DivisionByZero,
    /// An expression where a number is wanted.
    #[error("not a number (allowed: an integer, a decimal or a quotient like 1/3)")]
    NotANumber,
}

fn function_names() -> String {
    let names: Vec<&str> = Function::ALL.iter().map(|f| f.name()).collect();
    names.join(", ") + ", sqrt, min, max, piecewise"
}

/// How many characters of the text are shown on either side of the place.
const CONTEXT: usize = 32;

impl ParseError {
    /// `at` is the byte the problem starts at.
    pub(super) fn new(text: &str, at: usize, problem: Problem) -> ParseError {
        let before = text.get(..at).unwrap_or(text);
        let column = before.chars().count() + 1;
        let start = before
            .char_indices()
            .rev()
            .nth(CONTEXT - 1)
            .map_or(0, |(i, _)| i);
        let shown: String = text
            .get(start..)
            .unwrap_or("")
            .chars()
            .take(2 * CONTEXT)
            .map(|c| if c.is_control() { ' ' } else { c })
            .collect();
        let excerpt = (
            shown,
            column - 1 - text.get(..start).unwrap_or("").chars().count(),
        );
        ParseError {
            column,
            problem,
            excerpt,
        }
    }

    /// Two lines: the text around the place, and a caret under the place.
    ///
    /// ```
    /// let error = "sin(2*x".parse::<volver::symbolic::Expr>().unwrap_err();
    /// assert_eq!(error.caret(), "sin(2*x\n       ^");
    /// ```
    #[must_use]
    pub fn caret(&self) -> String {
        let (text, before) = &self.excerpt;
        format!("{text}\n{:before$}^", "")
    }
}

//! Why no case can be made.

use super::Statement;
use crate::symbolic::{CompileError, Expr, Interval, PiecesError};
use rug::Rational;

/// A closed form and the integral that it is not.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "{quantity} is {closed} by its closed form and {integral} by integration{} (allowed: closed forms that are the integral)",
    if *is_proved { ", although every statement on it is proved: a fault of volver, which should be reported" } else { "" }
)]
pub struct Contradiction {
    /// Of what: "t(D)" or "I(D)".
    pub quantity: &'static str,
    /// The closed form.
    pub closed: Interval,
    /// The integral, with its error.
    pub integral: Interval,
    /// Whether every statement that the closed form rests on is proved.
    pub is_proved: bool,
}

/// Why no case can be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ManufactureError {
    /// A statement that no case can do without is refuted.
    #[error(
        "{statement} fails at lambda = {witness}{} (allowed: {})",
        value.as_ref().map_or(String::new(), |value| format!(", where the value or the difference of both sides is {value}")),
        statement.allowed()
    )]
    Refuted {
        /// The statement.
        statement: Statement,
        /// Where it fails.
        witness: Rational,
        /// What is there instead.
        value: Option<Interval>,
    },
    /// A closed form is not what integration without it gives.
    #[error(transparent)]
    Contradicted(Box<Contradiction>),
    /// The chosen depth does not grow, so that no emission can be derived.
    #[error(
        "the extinction is 0 from lambda = {from} on, where no emission follows from the radiance (allowed: give extinction and emission, with depth and radiance as claims)"
    )]
    NoExtinction {
        /// Where that begins.
        from: Expr,
    },
    /// C as a function of depth that is no polynomial, with no radiance to go with it.
    #[error(
        "emission_of_depth = {emission} is no polynomial in t with derivatives that end (allowed: a polynomial of degree up to 64, or a claimed radiance beside it)"
    )]
    NotPolynomial {
        /// The emission.
        emission: Expr,
    },
    /// A field other than λ whose inverse is not given.
    #[error("the field {field} has no inverse (allowed: inverse, of s, beside it)")]
    NoInverse {
        /// The field.
        field: Expr,
    },
    /// Neither depth, radiance nor emission enough to make a case of.
    #[error("the case gives too little (allowed: see the recipes of case files)")]
    Incomplete,
    /// Branches that cannot be told apart.
    #[error(transparent)]
    Pieces(#[from] PiecesError),
    /// A formula with another symbol than its own.
    #[error(transparent)]
    Compile(#[from] CompileError),
}

impl ManufactureError {
    /// Whether C and τ as they are given are no medium, whatever else is claimed.
    #[must_use]
    pub fn is_of_medium(&self) -> bool {
        matches!(self, ManufactureError::Refuted { statement, .. } if statement.is_of_medium())
    }
}

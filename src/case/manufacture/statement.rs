//! What is checked of a case.

use crate::case::Unproved;
use crate::symbolic::{ConstantTest, Interval};
use rug::{Float, Rational};
use serde::Serialize;
use std::fmt;

/// Rational numbers of more characters are shown as decimals.
const LONGEST: usize = 24;

/// What has to hold of a case on [0, D].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Statement {
    /// λ(s(λ)) has a value everywhere, where an inverse is given.
    InverseDefined,
    /// λ(s(λ)) = λ, where an inverse is given.
    Inverse,
    /// s has a value everywhere.
    FieldDefined,
    /// t has a value everywhere.
    DepthDefined,
    /// t(0) = 0.
    DepthAtZero,
    /// t is continuous at both ends and where its pieces meet: from either side and at the very place.
    DepthContinuous,
    /// t′ = τ, wherever t has a derivative.
    DepthDerivative,
    /// τ has a finite value everywhere.
    ExtinctionDefined,
    /// τ ≥ 0.
    ExtinctionNonNegative,
    /// I has a value everywhere.
    RadianceDefined,
    /// I(0) = 0.
    RadianceAtZero,
    /// I is continuous at both ends and where its pieces meet.
    RadianceContinuous,
    /// I′ = C τ e^(−t), wherever I has a derivative.
    RadianceDerivative,
    /// C has a finite value everywhere.
    EmissionDefined,
    /// C ≥ 0.
    EmissionNonNegative,
}

impl Statement {
    /// Whether the exact radiance rests on it: all but the signs, which the integral does not need.
    #[must_use]
    pub fn is_of_closed_form(self) -> bool {
        !matches!(
            self,
            Statement::ExtinctionNonNegative | Statement::EmissionNonNegative
        )
    }

    /// Whether it is of C and τ as they are given, and of no depth or radiance claimed beside them: without it there is
    /// no medium.
    #[must_use]
    pub fn is_of_medium(self) -> bool {
        matches!(
            self,
            Statement::FieldDefined
                | Statement::ExtinctionDefined
                | Statement::ExtinctionNonNegative
                | Statement::EmissionDefined
        )
    }

    /// Whether theorems on orders of accuracy ask for it.
    #[must_use]
    pub fn is_asked_by_theorems(self) -> bool {
        matches!(
            self,
            Statement::FieldDefined | Statement::ExtinctionDefined | Statement::EmissionDefined
        )
    }

    /// Whether a case may be without it.
    #[must_use]
    pub fn is_optional(self) -> bool {
        self == Statement::EmissionNonNegative
    }

    /// What would do.
    #[must_use]
    pub fn allowed(self) -> &'static str {
        match self {
            Statement::InverseDefined => "an inverse with a value everywhere on the ray",
            Statement::Inverse => "an inverse that gives lambda back",
            Statement::FieldDefined => "a field with a value everywhere on the ray",
            Statement::DepthDefined => "a depth with a value everywhere on the ray",
            Statement::DepthAtZero => "a depth that begins at 0",
            Statement::DepthContinuous => "a continuous depth",
            Statement::DepthDerivative => "a depth whose derivative is the extinction",
            Statement::ExtinctionDefined => {
                "an extinction with a finite value everywhere on the ray"
            }
            Statement::ExtinctionNonNegative => {
                "an extinction of at least 0, as of a depth that never falls"
            }
            Statement::RadianceDefined => "a radiance with a value everywhere on the ray",
            Statement::RadianceAtZero => "a radiance that begins at 0",
            Statement::RadianceContinuous => "a continuous radiance",
            Statement::RadianceDerivative => "a radiance whose derivative is C tau exp(-t)",
            Statement::EmissionDefined => "an emission with a finite value everywhere on the ray",
            Statement::EmissionNonNegative => "an emission of at least 0",
        }
    }
}

impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Statement::InverseDefined => "lambda(s(lambda)) defined",
            Statement::Inverse => "lambda(s(lambda)) = lambda",
            Statement::FieldDefined => "s defined",
            Statement::DepthDefined => "t defined",
            Statement::DepthAtZero => "t(0) = 0",
            Statement::DepthContinuous => "t continuous",
            Statement::DepthDerivative => "t' = tau",
            Statement::ExtinctionDefined => "tau defined",
            Statement::ExtinctionNonNegative => "tau >= 0",
            Statement::RadianceDefined => "I defined",
            Statement::RadianceAtZero => "I(0) = 0",
            Statement::RadianceContinuous => "I continuous",
            Statement::RadianceDerivative => "I' = C tau exp(-t)",
            Statement::EmissionDefined => "C defined",
            Statement::EmissionNonNegative => "C >= 0",
        })
    }
}

/// What became of a statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It holds.
    Proved,
    /// It fails.
    Refuted {
        /// Where.
        witness: Rational,
        /// What the value is there, or the difference of both sides; nothing where it is not defined.
        value: Option<Interval>,
    },
    /// Neither is known.
    Undecided {
        /// A place that no proof got close to, where one is known.
        near: Option<Rational>,
    },
}

impl Outcome {
    /// What became of the claim that something is 0 at a place.
    pub(super) fn of_zero(constant: ConstantTest, at: &Rational) -> Outcome {
        match constant {
            ConstantTest::Zero => Outcome::Proved,
            ConstantTest::Nonzero(value) => Outcome::Refuted {
                witness: at.clone(),
                value: Some(value),
            },
            ConstantTest::NotDefined | ConstantTest::Unknown => Outcome::Undecided {
                near: Some(at.clone()),
            },
        }
    }
}

/// "refuted at lambda = 1/3: value in […]".
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Outcome::Proved => f.write_str("proved"),
            Outcome::Refuted { witness, value } => {
                write!(f, "refuted at lambda = {}: ", short(witness))?;
                match value {
                    Some(value) => write!(f, "value in {value}"),
                    None => f.write_str("no value"),
                }
            }
            Outcome::Undecided { near: Some(near) } => {
                write!(f, "undecided near lambda = {}", short(near))
            }
            Outcome::Undecided { near: None } => f.write_str("undecided"),
        }
    }
}

/// A rational number as it is, or nearly where that takes too many digits.
fn short(q: &Rational) -> String {
    let text = q.to_string();
    if text.len() <= LONGEST {
        return text;
    }
    format!("about {:.6}", Float::with_val(64, q))
}

/// A statement and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The statement.
    pub statement: Statement,
    /// What became of it.
    pub outcome: Outcome,
}

impl Check {
    /// What it says, and why it is not proved; `None` where it is.
    #[must_use]
    pub fn unproved(&self) -> Option<Unproved> {
        (self.outcome != Outcome::Proved).then(|| Unproved {
            claim: self.statement.to_string(),
            reason: self.outcome.to_string(),
        })
    }
}

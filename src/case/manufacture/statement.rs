//! What is checked of a case.

use crate::symbolic::Interval;
use rug::Rational;
use serde::Serialize;
use std::fmt;

/// What has to hold of a case on [0, D].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Statement {
    /// λ(s(λ)) = λ, where an inverse is given.
    Inverse,
    /// s has a value everywhere.
    FieldDefined,
    /// t has a value everywhere.
    DepthDefined,
    /// t(0) = 0.
    DepthAtZero,
    /// t is continuous where its pieces meet.
    DepthContinuous,
    /// t′ = τ.
    DepthDerivative,
    /// τ has a finite value everywhere.
    ExtinctionDefined,
    /// τ ≥ 0.
    ExtinctionNonNegative,
    /// I has a value everywhere.
    RadianceDefined,
    /// I(0) = 0.
    RadianceAtZero,
    /// I is continuous where its pieces meet.
    RadianceContinuous,
    /// I′ = C τ e^(−t).
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

    /// Whether a case may be without it.
    #[must_use]
    pub fn is_optional(self) -> bool {
        self == Statement::EmissionNonNegative
    }

    /// What would do.
    #[must_use]
    pub fn allowed(self) -> &'static str {
        match self {
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

/// A statement and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The statement.
    pub statement: Statement,
    /// What became of it.
    pub outcome: Outcome,
}

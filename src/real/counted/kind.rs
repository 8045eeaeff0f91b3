//! What can be counted.

use serde::Serialize;
use std::fmt;

/// A kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// a + b and a − b.
    Addition,
    /// a·b.
    Multiplication,
    /// a/b.
    Division,
    /// −a and |a|.
    Negation,
    /// a < b, a = b and the like.
    Comparison,
    /// √a.
    SquareRoot,
    /// eᵃ.
    Exponential,
    /// eᵃ − 1.
    ExponentialMinusOne,
    /// ln a and ln(1 + a).
    Logarithm,
    /// Sine and cosine of one number, together.
    SineCosine,
    /// tan a.
    Tangent,
    /// sinh a, cosh a or tanh a.
    Hyperbolic,
    /// atan a.
    Arctangent,
    /// erf a.
    ErrorFunction,
    /// An integer brought into the format.
    Integer,
    /// A quotient of machine integers, rounded: the place of a node, for instance.
    Fraction,
    /// A rational number or π, rounded: weights and steps.
    Constant,
    /// A number copied; free in a native format, an allocation in MPFR.
    Copy,
    /// A field s evaluated.
    Field,
    /// Both transfer functions C and τ evaluated together.
    Transfer,
    /// τ evaluated alone.
    Extinction,
}

impl Kind {
    /// All kinds, in the order of their declaration.
    pub const ALL: [Kind; 21] = [
        Kind::Addition,
        Kind::Multiplication,
        Kind::Division,
        Kind::Negation,
        Kind::Comparison,
        Kind::SquareRoot,
        Kind::Exponential,
        Kind::ExponentialMinusOne,
        Kind::Logarithm,
        Kind::SineCosine,
        Kind::Tangent,
        Kind::Hyperbolic,
        Kind::Arctangent,
        Kind::ErrorFunction,
        Kind::Integer,
        Kind::Fraction,
        Kind::Constant,
        Kind::Copy,
        Kind::Field,
        Kind::Transfer,
        Kind::Extinction,
    ];

    /// The kind as a plural, for tables: "additions".
    #[must_use]
    pub fn plural(self) -> &'static str {
        match self {
            Kind::Addition => "additions",
            Kind::Multiplication => "multiplications",
            Kind::Division => "divisions",
            Kind::Negation => "negations",
            Kind::Comparison => "comparisons",
            Kind::SquareRoot => "square roots",
            Kind::Exponential => "exponentials",
            Kind::ExponentialMinusOne => "exponentials minus one",
            Kind::Logarithm => "logarithms",
            Kind::SineCosine => "sines with cosines",
            Kind::Tangent => "tangents",
            Kind::Hyperbolic => "hyperbolic functions",
            Kind::Arctangent => "arctangents",
            Kind::ErrorFunction => "error functions",
            Kind::Integer => "integers",
            Kind::Fraction => "fractions",
            Kind::Constant => "constants",
            Kind::Copy => "copies",
            Kind::Field => "fields",
            Kind::Transfer => "transfers",
            Kind::Extinction => "extinctions",
        }
    }

    /// Whether it is an evaluation of a medium, which is made of operations of other kinds.
    #[must_use]
    pub fn is_evaluation(self) -> bool {
        matches!(self, Kind::Field | Kind::Transfer | Kind::Extinction)
    }

    /// Whether it is a transcendental function: what most of a run in many bits is spent on.
    #[must_use]
    pub fn is_transcendental(self) -> bool {
        matches!(
            self,
            Kind::Exponential
                | Kind::ExponentialMinusOne
                | Kind::Logarithm
                | Kind::SineCosine
                | Kind::Tangent
                | Kind::Hyperbolic
                | Kind::Arctangent
                | Kind::ErrorFunction
        )
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.plural())
    }
}

//! The elementary functions of one argument.

use std::fmt;

/// A function of one real argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// eˣ.
    Exp,
    /// The natural logarithm, for x > 0.
    Ln,
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent, where cos x ≠ 0.
    Tan,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
    /// The arc tangent.
    Atan,
    /// The error function, 2/√π ∫₀ˣ e^(−u²) du.
    Erf,
    /// |x|.
    Abs,
}

impl Function {
    /// All of them.
    pub const ALL: [Function; 11] = [
        Function::Exp,
        Function::Ln,
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Atan,
        Function::Erf,
        Function::Abs,
    ];

    /// The name it is written by.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Atan => "atan",
            Function::Erf => "erf",
            Function::Abs => "abs",
        }
    }

    /// The function of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Function> {
        Function::ALL.into_iter().find(|f| f.name() == name)
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

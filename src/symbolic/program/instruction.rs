//! What a program is made of.

use crate::symbolic::{Function, Relation};

/// Where a value is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operand {
    /// An input, by its place.
    Input(usize),
    /// A constant, by its place.
    Constant(usize),
    /// What an earlier instruction left.
    Register(usize),
}

/// One step: an operation, and the first register that it fills. No register is filled twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// What is done.
    pub operation: Operation,
    /// The register of the result.
    pub target: usize,
}

/// What can be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// a + b.
    Add(Operand, Operand),
    /// a − b.
    Subtract(Operand, Operand),
    /// a·b.
    Multiply(Operand, Operand),
    /// a/b.
    Divide(Operand, Operand),
    /// −a.
    Negate(Operand),
    /// √a.
    Sqrt(Operand),
    /// e^a − 1.
    ExpM1(Operand),
    /// ln(1 + a).
    Ln1p(Operand),
    /// sin a, and cos a in the next register.
    SinCos(Operand),
    /// A function other than sin and cos.
    Call(Function, Operand),
    /// The lesser of a and b; NaN where one of them is.
    Min(Operand, Operand),
    /// The greater of a and b; NaN where one of them is.
    Max(Operand, Operand),
    /// `then` where `left` stands in `relation` to `right`, otherwise `otherwise`; NaN where they
    /// cannot be compared.
    Select {
        /// How they are compared.
        relation: Relation,
        /// The left-hand side.
        left: Operand,
        /// The right-hand side.
        right: Operand,
        /// The value where it holds.
        then: Operand,
        /// The value where it does not.
        otherwise: Operand,
    },
}

impl Operation {
    /// What it needs.
    #[must_use]
    pub fn operands(self) -> Vec<Operand> {
        match self {
            Operation::Add(a, b)
            | Operation::Subtract(a, b)
            | Operation::Multiply(a, b)
            | Operation::Divide(a, b)
            | Operation::Min(a, b)
            | Operation::Max(a, b) => vec![a, b],
            Operation::Negate(a)
            | Operation::Sqrt(a)
            | Operation::ExpM1(a)
            | Operation::Ln1p(a)
            | Operation::SinCos(a)
            | Operation::Call(_, a) => vec![a],
            Operation::Select {
                left,
                right,
                then,
                otherwise,
                ..
            } => vec![left, right, then, otherwise],
        }
    }
}

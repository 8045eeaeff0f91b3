//! Branches of piecewise expressions, and the comparisons that decide between them.

use super::Expr;

/// One branch of a piecewise expression.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Branch {
    /// When it is taken.
    pub condition: Condition,
    /// What it is then.
    pub value: Expr,
}

/// A comparison of two expressions.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Condition {
    /// The left-hand side.
    pub left: Expr,
    /// How they are compared.
    pub relation: Relation,
    /// The right-hand side.
    pub right: Expr,
}

/// How two numbers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// <
    Less,
    /// <=
    LessEqual,
    /// >
    Greater,
    /// >=
    GreaterEqual,
}

impl Relation {
    /// Whether `left` stands so to `right`; not where one of them is NaN.
    pub fn holds<T: PartialOrd>(self, left: &T, right: &T) -> bool {
        match self {
            Relation::Less => left < right,
            Relation::LessEqual => left <= right,
            Relation::Greater => left > right,
            Relation::GreaterEqual => left >= right,
        }
    }

    /// As it is written.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Relation::Less => "<",
            Relation::LessEqual => "<=",
            Relation::Greater => ">",
            Relation::GreaterEqual => ">=",
        }
    }
}

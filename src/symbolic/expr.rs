//! Expressions: exact numbers, symbols, arithmetic, elementary functions, branches.

mod branch;
mod operators;
mod power;

pub use branch::{Branch, Condition, Relation};

use super::function::Function;
use crate::symbolic::hash::{HashSet, Multiply};
use power::power_of_number;
use rug::Rational;
use std::fmt::{self, Debug};
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// A real expression with exact rational constants.
///
/// An expression is a value: cheap to clone, and parts that occur more than once may be shared.
/// Constructors keep what is written but for what loses nothing anywhere: nested sums and products are
/// flattened, numbers are folded, and 1/xᵃ is x⁻ᵃ for a > 0. So text read from what [`Display`](fmt::Display)
/// prints is the same expression again. Everything that needs to know where an expression is defined is
/// left to [`simplify`](Expr::simplify).
///
/// ```
/// use volver::symbolic::Expr;
///
/// let depth: Expr = "sin(lambda^2)/2".parse()?;
/// assert_eq!(depth.differentiate("lambda").to_string(), "cos(lambda^2)*lambda");
/// # Ok::<(), volver::symbolic::ParseError>(())
/// ```
#[derive(Clone)]
pub struct Expr(Arc<Node>);

struct Node {
    kind: Kind,
    /// Of the whole tree, made once: expressions are keys of hash maps everywhere.
    hash: u64,
}

/// What an expression is made of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// An exact number.
    Number(Rational),
    /// π.
    Pi,
    /// A variable or a named parameter.
    Symbol(Arc<str>),
    /// A sum of at least two terms, none of them a sum and at most one a number, which is not 0.
    Sum(Vec<Expr>),
    /// A product of at least two factors, none of them a product; only the first may be a number, which
    /// is not 1.
    Product(Vec<Expr>),
    /// A constant power: an integer one of any base, a fractional one of a base ≥ 0.
    Power(Expr, Rational),
    /// A function of one argument.
    Call(Function, Expr),
    /// The lesser of two.
    Min(Expr, Expr),
    /// The greater of two.
    Max(Expr, Expr),
    /// The value of the first branch whose condition holds, otherwise the last expression.
    Piecewise(Vec<Branch>, Expr),
}

impl Expr {
    fn new(kind: Kind) -> Expr {
        let mut hasher = Multiply::default();
        kind.hash(&mut hasher);
        let hash = hasher.finish();
        Expr(Arc::new(Node { kind, hash }))
    }

    /// What it is made of.
    #[must_use]
    pub fn kind(&self) -> &Kind {
        &self.0.kind
    }

    /// An exact number.
    pub fn number(q: impl Into<Rational>) -> Expr {
        Expr::new(Kind::Number(q.into()))
    }

    /// π.
    #[must_use]
    pub fn pi() -> Expr {
        Expr::new(Kind::Pi)
    }

    /// A variable or a named parameter.
    #[must_use]
    pub fn symbol(name: &str) -> Expr {
        Expr::new(Kind::Symbol(name.into()))
    }

    /// The sum of any number of terms.
    #[must_use]
    pub fn sum(terms: impl IntoIterator<Item = Expr>) -> Expr {
        let mut flat: Vec<Expr> = Vec::new();
        let mut number: Option<(usize, Rational)> = None;
        let mut add = |term: &Expr| match term.kind() {
            Kind::Number(q) => match &mut number {
                Some((_, sum)) => *sum += q,
                None => number = Some((flat.len(), q.clone())),
            },
            _ => flat.push(term.clone()),
        };
        for term in terms {
            match term.kind() {
                Kind::Sum(inner) => inner.iter().for_each(&mut add),
                _ => add(&term),
            }
        }
        if let Some((place, sum)) = number
            && (sum != 0 || flat.is_empty())
        {
            flat.insert(place, Expr::number(sum));
        }
        match flat.len() {
            0 => Expr::number(0),
            1 => flat.swap_remove(0),
            _ => Expr::new(Kind::Sum(flat)),
        }
    }

    /// The product of any number of factors.
    #[must_use]
    pub fn product(factors: impl IntoIterator<Item = Expr>) -> Expr {
        let mut flat: Vec<Expr> = Vec::new();
        let mut coefficient = Rational::from(1);
        let mut multiply = |factor: &Expr| match factor.kind() {
            Kind::Number(q) => coefficient *= q,
            _ => flat.push(factor.clone()),
        };
        for factor in factors {
            match factor.kind() {
                Kind::Product(inner) => inner.iter().for_each(&mut multiply),
                _ => multiply(&factor),
            }
        }
        if coefficient != 1 || flat.is_empty() {
            flat.insert(0, Expr::number(coefficient));
        }
        match flat.len() {
            1 => flat.swap_remove(0),
            _ => Expr::new(Kind::Product(flat)),
        }
    }

    /// The constant power `self`^`exponent`.
    #[must_use]
    pub fn pow(&self, exponent: impl Into<Rational>) -> Expr {
        let exponent: Rational = exponent.into();
        if exponent == 1 {
            return self.clone();
        }
        match self.kind() {
            Kind::Number(q) => {
                if let Some(folded) = power_of_number(q, &exponent) {
                    return Expr::number(folded);
                }
            }
            // 1/(1/x) is not x: it has no value at 0.
            Kind::Power(base, inner) if exponent == -1 && *inner > 0 => {
                return base.pow(Rational::from(-inner));
            }
            _ => {}
        }
        Expr::new(Kind::Power(self.clone(), exponent))
    }

    /// 1 / `self`.
    #[must_use]
    pub fn recip(&self) -> Expr {
        self.pow(-1)
    }

    /// √`self`.
    #[must_use]
    pub fn sqrt(&self) -> Expr {
        self.pow((1, 2))
    }

    /// A function of `self`.
    #[must_use]
    pub fn call(&self, function: Function) -> Expr {
        Expr::new(Kind::Call(function, self.clone()))
    }

    /// e^`self`.
    #[must_use]
    pub fn exp(&self) -> Expr {
        self.call(Function::Exp)
    }

    /// The lesser of the two.
    #[must_use]
    pub fn min(&self, other: &Expr) -> Expr {
        Expr::new(Kind::Min(self.clone(), other.clone()))
    }

    /// The greater of the two.
    #[must_use]
    pub fn max(&self, other: &Expr) -> Expr {
        Expr::new(Kind::Max(self.clone(), other.clone()))
    }

    /// The first branch whose condition holds, or `otherwise`.
    #[must_use]
    pub fn piecewise(branches: Vec<Branch>, otherwise: Expr) -> Expr {
        if branches.is_empty() {
            return otherwise;
        }
        Expr::new(Kind::Piecewise(branches, otherwise))
    }

    /// The number that this is, if it is one.
    #[must_use]
    pub fn as_number(&self) -> Option<&Rational> {
        match self.kind() {
            Kind::Number(q) => Some(q),
            _ => None,
        }
    }

    /// Whether this is the number `n`.
    #[must_use]
    pub fn is(&self, n: i32) -> bool {
        self.as_number().is_some_and(|q| *q == n)
    }

    /// The parts that it is directly made of, conditions included, in the order they are written.
    #[must_use]
    pub fn parts(&self) -> Vec<&Expr> {
        match self.kind() {
            Kind::Number(_) | Kind::Pi | Kind::Symbol(_) => Vec::new(),
            Kind::Sum(parts) | Kind::Product(parts) => parts.iter().collect(),
            Kind::Power(base, _) => vec![base],
            Kind::Call(_, argument) => vec![argument],
            Kind::Min(a, b) | Kind::Max(a, b) => vec![a, b],
            Kind::Piecewise(branches, otherwise) => branches
                .iter()
                .flat_map(|b| [&b.condition.left, &b.condition.right, &b.value])
                .chain([otherwise])
                .collect(),
        }
    }

    /// The same kind of expression of other parts, in the order of [`parts`](Expr::parts).
    pub(super) fn with_parts(&self, parts: &[Expr]) -> Expr {
        match (self.kind(), parts) {
            (Kind::Sum(_), terms) => Expr::sum(terms.iter().cloned()),
            (Kind::Product(_), factors) => Expr::product(factors.iter().cloned()),
            (Kind::Power(_, exponent), [base]) => base.pow(exponent.clone()),
            (Kind::Call(function, _), [argument]) => argument.call(*function),
            (Kind::Min(..), [a, b]) => a.min(b),
            (Kind::Max(..), [a, b]) => a.max(b),
            (Kind::Piecewise(old, _), [branches @ .., otherwise]) => {
                let branches = branches
                    .chunks_exact(3)
                    .zip(old)
                    .map(|(parts, branch)| Branch {
                        condition: Condition {
                            left: parts[0].clone(),
                            relation: branch.condition.relation,
                            right: parts[1].clone(),
                        },
                        value: parts[2].clone(),
                    })
                    .collect();
                Expr::piecewise(branches, otherwise.clone())
            }
            // Numbers and symbols have no parts.
            _ => self.clone(),
        }
    }

    /// The names of all symbols in it, sorted.
    #[must_use]
    pub fn symbols(&self) -> Vec<Arc<str>> {
        let mut names: Vec<Arc<str>> = self
            .nodes()
            .into_iter()
            .filter_map(|node| match node.kind() {
                Kind::Symbol(name) => Some(Arc::clone(name)),
                _ => None,
            })
            .collect();
        names.sort();
        names
    }

    /// Whether `symbol` occurs in it.
    #[must_use]
    pub fn contains(&self, symbol: &str) -> bool {
        self.symbols().iter().any(|name| **name == *symbol)
    }

    /// Every different expression in it, each once, parts before what is made of them.
    #[must_use]
    pub fn nodes(&self) -> Vec<&Expr> {
        fn visit<'e>(expr: &'e Expr, seen: &mut HashSet<&'e Expr>, order: &mut Vec<&'e Expr>) {
            if seen.contains(expr) {
                return;
            }
            for part in expr.parts() {
                visit(part, seen, order);
            }
            seen.insert(expr);
            order.push(expr);
        }
        let mut order = Vec::new();
        visit(self, &mut HashSet::default(), &mut order);
        order
    }
}

impl PartialEq for Expr {
    fn eq(&self, other: &Expr) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || (self.0.hash == other.0.hash && self.0.kind == other.0.kind)
    }
}

impl Eq for Expr {}

impl Hash for Expr {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.0.hash);
    }
}

impl Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

impl From<Rational> for Expr {
    fn from(q: Rational) -> Expr {
        Expr::number(q)
    }
}

impl From<i32> for Expr {
    fn from(n: i32) -> Expr {
        Expr::number(n)
    }
}

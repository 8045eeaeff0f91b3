//! A rule as a program: statements that Python and C have in common, which either printer writes in its own way.

mod expression;
mod law;
mod march;
mod path;
mod seam;
mod segment;
mod used;

pub(super) use march::radiance;
pub(super) use used::{expressions, mentions};

use super::Curve;
use expression::number;

/// One statement; expressions are text that means the same in both languages.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Statement {
    /// name = value.
    Set(&'static str, String),
    /// name op= value.
    Change(&'static str, char, String),
    /// What is done where a condition holds, and where it does not.
    If(String, Vec<Statement>, Vec<Statement>),
    /// For each integer of a range.
    For(Range, Vec<Statement>),
    /// The loop ends.
    Break,
    /// The function's value.
    Return(String),
    /// For the reader.
    Note(&'static str),
}

/// The integers from `from` on, below `to`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) name: &'static str,
    pub(super) from: String,
    pub(super) to: String,
    pub(super) backwards: bool,
}

/// A function of numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) parameter: &'static str,
    pub(super) body: Vec<Statement>,
}

/// name = value.
fn set(name: &'static str, value: impl Into<String>) -> Statement {
    Statement::Set(name, value.into())
}

/// name op= value.
fn change(name: &'static str, op: char, value: impl Into<String>) -> Statement {
    Statement::Change(name, op, value.into())
}

/// Statements under a condition.
fn when(condition: impl Into<String>, then: Vec<Statement>) -> Statement {
    Statement::If(condition.into(), then, Vec::new())
}

/// No more than `most`.
fn at_most(name: &'static str, most: f64) -> Statement {
    let most = number(most);
    when(format!("{name} > {most}"), vec![set(name, most)])
}

/// No less than `least`.
fn at_least(name: &'static str, least: f64) -> Statement {
    let least = number(least);
    when(format!("{name} < {least}"), vec![set(name, least)])
}

/// name = g(name).
fn curved(curve: Curve, name: &'static str) -> Vec<Statement> {
    let raised = |power: &str| format!("pow({name}, {power})");
    match curve {
        Curve::Linear => Vec::new(),
        Curve::Gamma(power) => vec![Statement::If(
            format!("{name} <= 0"),
            vec![set(name, "0.0")],
            vec![set(name, raised(&number(power)))],
        )],
        Curve::Srgb => vec![Statement::If(
            format!("{name} <= 0.0031308"),
            vec![change(name, '*', "12.92")],
            vec![set(name, format!("1.055 * {} - 0.055", raised("1 / 2.4")))],
        )],
        Curve::Reinhard => vec![change(name, '/', format!("1 + {name}"))],
        Curve::Exposure => vec![set(name, format!("-expm1(-{name})"))],
    }
}

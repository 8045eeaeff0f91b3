//! Exact numbers, and expressions with the parameters put in.

use super::table::{Entry, Table};
use super::{FileError, FileProblem, MAX_NAME};
use crate::symbolic::{Expr, Kind, ParseError, Problem, parse_number};
use rug::{Integer, Rational};
use std::collections::BTreeMap;
use toml::de::DeValue;

/// The most bits of a numerator or a denominator: 1000 decimal digits.
pub(super) const MAX_BITS: u32 = 3322;

/// The brightest background.
const BRIGHTEST: u64 = 1_000_000_000_000;

/// The named numbers of a file.
pub(super) struct Parameters(BTreeMap<String, Expr>);

impl Parameters {
    pub(super) fn read(top: &Table<'_>) -> Result<Parameters, FileError> {
        let mut parameters = BTreeMap::new();
        if let Some(entry) = top.entry("parameters") {
            for entry in entry.table()?.entries() {
                let name = entry.name_of_key();
                // Whatever reads as one symbol can be a symbol: pi and functions do not.
                let symbol = name.parse() == Ok(Expr::symbol(name));
                if !symbol || name.len() > MAX_NAME || ["lambda", "s", "t"].contains(&name) {
                    let text = name.into();
                    return Err(entry.error(FileProblem::Parameter { text }));
                }
                parameters.insert(name.to_string(), Expr::number(number(&entry)?));
            }
        }
        Ok(Parameters(parameters))
    }

    /// The expression of `variable` that stands at `key`, if any.
    pub(super) fn expression(
        &self,
        table: &Table<'_>,
        key: &str,
        variable: &str,
    ) -> Result<Option<Expr>, FileError> {
        let Some(entry) = table.entry(key) else {
            return Ok(None);
        };
        let text = entry.text()?;
        let expr: Expr = text.parse().map_err(|error| parse_error(&entry, &error))?;
        let symbols = expr.symbols();
        let unknown = symbols
            .iter()
            .filter(|name| ***name != *variable && !self.0.contains_key(&***name))
            .map(|name| (place_of_symbol(text, name), name));
        if let Some((at, symbol)) = unknown.min() {
            let names = std::iter::once(variable).chain(self.0.keys().map(String::as_str));
            let problem = FileProblem::Symbol {
                key: entry.path().into(),
                symbol: symbol.to_string(),
                allowed: names.map(str::to_string).collect(),
            };
            return Err(entry.text_error(at, problem));
        }
        let expr = expr.substitute_all(|name| self.0.get(name).cloned());
        match valueless_power(&expr) {
            Some(problem) => Err(entry.text_error(0, of_key(&entry, problem))),
            None => Ok(Some(expr)),
        }
    }
}

/// What the parser refuses, come about by a parameter: a power of 0 without a value.
fn valueless_power(expr: &Expr) -> Option<Problem> {
    expr.nodes().into_iter().find_map(|node| match node.kind() {
        Kind::Power(base, exponent) if base.is(0) && *exponent == 0 => Some(Problem::ZeroToTheZero),
        Kind::Power(base, exponent) if base.is(0) && *exponent < 0 => Some(Problem::DivisionByZero),
        _ => None,
    })
}

/// The first byte of the first word `name` in the text of an expression.
fn place_of_symbol(text: &str, name: &str) -> usize {
    let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.match_indices(name)
        .map(|(at, _)| at)
        .find(|&at| {
            let (before, after) = text.split_at_checked(at).unwrap_or((text, ""));
            let after = after.strip_prefix(name).unwrap_or(after);
            !before.ends_with(of_word) && !after.starts_with(of_word)
        })
        .unwrap_or(0)
}

/// D > 0.
pub(super) fn length(entry: &Entry<'_>) -> Result<Rational, FileError> {
    let length = number(entry)?;
    if length <= 0 {
        let text = length.to_string();
        return Err(entry.value_error(FileProblem::Length { text }));
    }
    Ok(length)
}

/// 0 ≤ B, and no more than a renderer takes.
pub(super) fn background(entry: &Entry<'_>) -> Result<Rational, FileError> {
    let background = number(entry)?;
    if background < 0 || background > BRIGHTEST {
        let text = background.to_string();
        return Err(entry.value_error(FileProblem::Background { text }));
    }
    Ok(background)
}

/// An exact number: a text or an integer.
fn number(entry: &Entry<'_>) -> Result<Rational, FileError> {
    let key = || entry.path().to_string();
    let number = match entry.value() {
        DeValue::String(text) => parse_number(text).map_err(|error| parse_error(entry, &error))?,
        DeValue::Integer(integer) => {
            let number = i64::from_str_radix(integer.as_str(), integer.radix())
                .map_err(|_| entry.value_error(FileProblem::Integer { key: key() }))?;
            Rational::from(number)
        }
        DeValue::Float(float) => {
            let text = float.as_str().into();
            return Err(entry.value_error(FileProblem::Float { key: key(), text }));
        }
        _ => return Err(entry.type_error("an integer, or a number in quotes")),
    };
    let bits = [number.numer(), number.denom()].map(Integer::significant_bits);
    if bits.into_iter().any(|bits| bits > MAX_BITS) {
        return Err(entry.value_error(FileProblem::Digits { key: key() }));
    }
    Ok(number)
}

/// What the parser of expressions says, at its place in the file.
fn parse_error(entry: &Entry<'_>, error: &ParseError) -> FileError {
    let text = entry.value().as_str().unwrap_or("");
    let at = text
        .char_indices()
        .nth(error.column.saturating_sub(1))
        .map_or(text.len(), |(at, _)| at);
    let problem = match (&error.problem, entry.column_of_text()) {
        // Only ASCII stands before it, so that its column is counted in bytes too.
        (Problem::Unclosed { opened }, Some(column)) => Problem::Unclosed {
            opened: opened + column - 1,
        },
        (problem, _) => problem.clone(),
    };
    entry.text_error(at, of_key(entry, problem))
}

fn of_key(entry: &Entry<'_>, problem: Problem) -> FileProblem {
    let key = entry.path().into();
    FileProblem::Expression { key, problem }
}

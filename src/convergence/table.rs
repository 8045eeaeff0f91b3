//! Tables of measurements as text: steps with errors, or with values.
//!
//! One row a level, fields separated by commas, semicolons, tabs or blanks; `#` starts a comment. A
//! header is optional and may name its columns in any case and order: `h`, `d`, `dx`, `step` or
//! `n` (then h = 1/n); `error`, `err`, `e` or `value`, `v`, `q`, `result`; `floor`; `stderr`, `se`.
//! An error or value may be `nan` or `inf`.
//! Without a header the columns are step and error, or step and value where [`Reading`] asks for values.

mod columns;
mod error;
#[cfg(feature = "studies")]
mod remainders;

pub use error::TableError;
#[cfg(feature = "studies")]
pub use remainders::{Remainder, remainders};

use super::decimal::Decimal;
use super::{Sample, ValueSample};
use columns::{Columns, header, without_header};
use rug::Float;
use rug::ops::Pow;
use serde::Serialize;

/// More rows are no ladder.
pub const MAX_ROWS: usize = 1 << 20;

/// What to make of a table beyond what its header says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The exact result: values become errors.
    pub exact: Option<Float>,
    /// The second column holds values, and no exact result is known.
    pub differences: bool,
    /// A floor for every level, where the table has no floor column.
    pub floor: Option<Float>,
}

/// The levels of a table, coarse to fine.
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// Signed errors, for [`fit`](super::fit()).
    Errors(Vec<Sample>),
    /// Signed errors and their standard errors, for [`fit_uncertain`](super::fit_uncertain).
    Uncertain(Vec<Sample>, Vec<Float>),
    /// Values without an exact result, for [`fit_differences`](super::fit_differences).
    Values(Vec<ValueSample>),
}

/// Where the floors of a table come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FloorSource {
    /// A column of the table.
    Column,
    /// [`Reading::floor`].
    Given,
    /// Half a unit of the last digit that any value of the table has.
    Digits,
    /// Nowhere: errors without a floor.
    Unknown,
}

/// A table read.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The levels, coarse to fine.
    pub levels: Levels,
    /// Where their floors come from.
    pub floor_source: FloorSource,
}

/// One row of numbers.
struct Row {
    line: usize,
    n: Option<u64>,
    step: f64,
    step_text: String,
    y: Decimal,
    floor: Option<Float>,
    standard_error: Option<Float>,
}

/// Reads a table: rows in any order, each number at the precision its digits need.
///
/// Values without a floor get half a unit of the last digit that any of them has, since more is not known.
///
/// # Errors
///
/// [`TableError`], with line and column, the offending text and what is allowed.
pub fn read(text: &str, reading: &Reading) -> Result<Table, TableError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
        .peekable();
    let Some(&(line, first)) = lines.peek() else {
        return Err(TableError::Empty);
    };
    let separator = separator(first);
    let names = fields(first, separator);
    let columns = if names.iter().any(|f| is_number_like(f)) {
        without_header(line, names.len(), reading)?
    } else {
        lines.next();
        header(line, &names, reading)?
    };
    let mut rows = Vec::new();
    for (line, text) in lines {
        if rows.len() == MAX_ROWS {
            return Err(TableError::TooManyRows { line });
        }
        rows.push(row(line, &fields(text, separator), &columns)?);
    }
    rows.sort_by(|a, b| b.step.total_cmp(&a.step));
    for pair in rows.windows(2) {
        if pair[0].step.total_cmp(&pair[1].step).is_eq() {
            return Err(TableError::Duplicate {
                line: pair[1].line,
                first: pair[0].line,
                text: pair[1].step_text.clone(),
            });
        }
    }
    match &rows[..] {
        [] => Err(TableError::Empty),
        [only] => Err(TableError::SingleRow { line: only.line }),
        _ => Ok(levels(rows, &columns, reading)),
    }
}

/// The separator of all lines, from the first; blanks where it has no other.
fn separator(line: &str) -> Option<char> {
    [';', '\t', ','].into_iter().find(|c| line.contains(*c))
}

/// The fields of a line, without blanks and quotes around them.
fn fields(line: &str, separator: Option<char>) -> Vec<&str> {
    let parts: Vec<&str> = match separator {
        Some(separator) => line.split(separator).collect(),
        None => line.split_whitespace().collect(),
    };
    parts
        .into_iter()
        .map(|part| part.trim().trim_matches('"').trim())
        .collect()
}

/// A number, or something that wants to be one and is refused as a number.
fn is_number_like(field: &str) -> bool {
    field.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        || field.parse::<f64>().is_ok()
}

/// One row of numbers.
fn row(line: usize, fields: &[&str], columns: &Columns) -> Result<Row, TableError> {
    if fields.len() != columns.count {
        return Err(TableError::Fields {
            line,
            found: fields.len(),
            allowed: columns.count,
        });
    }
    let column = |index: usize| columns.names[index].clone();
    let number = |index: usize| {
        Decimal::parse(fields[index]).ok_or_else(|| TableError::NotANumber {
            line,
            column: column(index),
            text: fields[index].into(),
        })
    };
    let x = number(columns.x)?.value;
    let step_text = fields[columns.x].to_string();
    let (n, step) = if columns.x_is_n {
        let n = x
            .to_integer()
            .and_then(|n| n.to_u64())
            .filter(|n| x.is_integer() && (1..=1 << 53).contains(n));
        let n = n.ok_or_else(|| TableError::Segments {
            line,
            column: column(columns.x),
            text: step_text.clone(),
        })?;
        (Some(n), 1.0 / n as f64)
    } else {
        (None, x.to_f64())
    };
    if !step.is_normal() || step < 0.0 {
        return Err(TableError::Step {
            line,
            column: column(columns.x),
            text: step_text,
        });
    }
    let floor = match columns.floor {
        Some(index) => {
            let floor = number(index)?.value;
            if floor < 0 {
                return Err(TableError::Floor {
                    line,
                    column: column(index),
                    text: fields[index].into(),
                });
            }
            Some(floor)
        }
        None => None,
    };
    let standard_error = match columns.standard_error {
        Some(index) => {
            let size = number(index)?.value;
            if size <= 0 {
                return Err(TableError::StandardError {
                    line,
                    column: column(index),
                    text: fields[index].into(),
                });
            }
            Some(size)
        }
        None => None,
    };
    let y = match not_finite(fields[columns.y]) {
        Some(y) => y,
        None => number(columns.y)?,
    };
    Ok(Row {
        line,
        n,
        step,
        step_text,
        y,
        floor,
        standard_error,
    })
}

/// NaN and infinities, by their names alone.
fn not_finite(text: &str) -> Option<Decimal> {
    let name = text.strip_prefix(['+', '-']).unwrap_or(text);
    let value: f64 = text.parse().ok()?;
    name.bytes()
        .all(|b| b.is_ascii_alphabetic())
        .then(|| Decimal {
            value: Float::with_val(53, value),
            last_place: i64::MAX,
        })
}

/// Samples from rows already in order.
fn levels(rows: Vec<Row>, columns: &Columns, reading: &Reading) -> Table {
    let (common, floor_source) = if columns.floor.is_some() {
        (Float::new(53), FloorSource::Column)
    } else if let Some(floor) = &reading.floor {
        (floor.clone(), FloorSource::Given)
    } else if columns.y_is_value {
        let finite = rows.iter().filter(|r| r.y.value.is_finite());
        let last_place = finite.map(|r| r.y.last_place).min().unwrap_or(0);
        (
            Float::with_val(53, 10).pow(last_place) / 2_u32,
            FloorSource::Digits,
        )
    } else {
        (Float::new(53), FloorSource::Unknown)
    };
    let values = columns.y_is_value && reading.exact.is_none();
    let floor = |row: &Row| row.floor.clone().unwrap_or_else(|| common.clone());
    let levels = if values {
        let sample = |row: Row| ValueSample {
            n: row.n,
            step: row.step,
            floor: floor(&row),
            value: row.y.value,
        };
        Levels::Values(rows.into_iter().map(sample).collect())
    } else {
        let deviations: Option<Vec<Float>> =
            rows.iter().map(|row| row.standard_error.clone()).collect();
        let sample = |row: Row| Sample {
            n: row.n,
            step: row.step,
            floor: floor(&row),
            error: match &reading.exact {
                Some(exact) => {
                    let bits = row.y.value.prec().max(exact.prec());
                    Float::with_val(bits, &row.y.value - exact)
                }
                None => row.y.value,
            },
        };
        let samples = rows.into_iter().map(sample).collect();
        match deviations {
            Some(deviations) => Levels::Uncertain(samples, deviations),
            None => Levels::Errors(samples),
        }
    };
    Table {
        levels,
        floor_source,
    }
}

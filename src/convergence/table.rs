//! Tables of measurements as text: steps with errors, or with values.
//!
//! One row a level, fields separated by commas, semicolons, tabs or blanks; `#` starts a comment. A
//! header is optional and may name its columns in any case and order: `h`, `d`, `dx`, `step` or
//! `n` (then h = 1/n); `error`, `err`, `e` or `value`, `v`, `q`, `result`; `floor`.
//! Without a header the columns are step and error, or step and value where [`Reading`] asks for values.

use super::decimal::Decimal;
use super::{Sample, ValueSample};
use rug::Float;
use rug::ops::Pow;
use serde::Serialize;

const X_NAMES: [&str; 4] = ["h", "d", "dx", "step"];
const ERROR_NAMES: [&str; 3] = ["error", "err", "e"];
const VALUE_NAMES: [&str; 4] = ["value", "v", "q", "result"];
const ALLOWED_NAMES: &str = "h, d, dx, step or n; error, err, e, value, v, q or result; floor";

/// What to make of a table beyond what its header says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The exact result: values become errors.
    pub exact: Option<Float>,
    /// The second column holds values, and no exact result is known.
    pub differences: bool,
    /// A floor for every level; it stands in for a floor column.
    pub floor: Option<Float>,
}

/// The levels of a table, coarse to fine.
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// Signed errors, for [`fit`](super::fit()).
    Errors(Vec<Sample>),
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

/// Text that is no table of measurements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// No row of numbers.
    #[error("no rows of numbers (allowed: two or more rows of step and error or value)")]
    Empty,
    /// One row alone.
    #[error("line {line}: a single row has no order (allowed: two or more rows)")]
    SingleRow {
        /// Line of the row.
        line: usize,
    },
    /// A row with another number of fields.
    #[error("line {line}: {found} fields (allowed: {allowed})")]
    Fields {
        /// Line of the row.
        line: usize,
        /// Fields found.
        found: usize,
        /// Fields that the header or the first row has.
        allowed: usize,
    },
    /// A field that is no finite decimal number.
    #[error("line {line}, {column}: '{text}' is not allowed (allowed: finite decimal numbers)")]
    NotANumber {
        /// Line of the field.
        line: usize,
        /// Column of the field.
        column: String,
        /// The field.
        text: String,
    },
    /// A step that is not positive, or outside binary64's normal range.
    #[error(
        "line {line}, {column}: step '{text}' is not allowed (allowed: above 0, within binary64's range)"
    )]
    Step {
        /// Line of the field.
        line: usize,
        /// Column of the field.
        column: String,
        /// The field.
        text: String,
    },
    /// A number of segments that is no positive whole number.
    #[error(
        "line {line}, {column}: '{text}' segments are not allowed (allowed: whole numbers, 1 to 2^53)"
    )]
    Segments {
        /// Line of the field.
        line: usize,
        /// Column of the field.
        column: String,
        /// The field.
        text: String,
    },
    /// A floor below 0.
    #[error("line {line}, {column}: '{text}' is not allowed (allowed: 0 or above)")]
    Floor {
        /// Line of the field.
        line: usize,
        /// Column of the field.
        column: String,
        /// The field.
        text: String,
    },
    /// Two rows with the same step.
    #[error("line {line}: step '{text}' stands in line {first} already (allowed: each step once)")]
    Duplicate {
        /// Line of the second row.
        line: usize,
        /// Line of the first row.
        first: usize,
        /// The step in the second row.
        text: String,
    },
    /// A header with an unknown name.
    #[error("line {line}: unknown column '{name}' (allowed: {ALLOWED_NAMES})")]
    UnknownColumn {
        /// Line of the header.
        line: usize,
        /// The name.
        name: String,
    },
    /// A header that says one thing twice, or errors and values at once.
    #[error(
        "line {line}: column '{name}' is one too many (allowed: one step or n, one error or value, one floor)"
    )]
    ExtraColumn {
        /// Line of the header.
        line: usize,
        /// The name.
        name: String,
    },
    /// A header without a column that has to be there.
    #[error("line {line}: the header has no {missing} (allowed: {ALLOWED_NAMES})")]
    MissingColumn {
        /// Line of the header.
        line: usize,
        /// What is missing.
        missing: &'static str,
    },
    /// The header says errors, the reading says values.
    #[error(
        "line {line}: column '{name}' holds errors (allowed with an exact value or differences: value, v, q, result)"
    )]
    ErrorsForValues {
        /// Line of the header.
        line: usize,
        /// The name of the column.
        name: String,
    },
}

/// What the columns hold.
struct Columns {
    count: usize,
    x: usize,
    x_is_n: bool,
    y: usize,
    y_is_value: bool,
    floor: Option<usize>,
    names: Vec<String>,
}

/// One row of numbers.
struct Row {
    line: usize,
    n: Option<u64>,
    step: f64,
    step_text: String,
    y: Decimal,
    floor: Option<Float>,
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
    let mut rows = lines
        .map(|(line, text)| row(line, &fields(text, separator), &columns))
        .collect::<Result<Vec<Row>, TableError>>()?;
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
    field.parse::<f64>().is_ok() || Decimal::parse(field).is_some()
}

/// Two columns: step, and what the reading says.
fn without_header(line: usize, count: usize, reading: &Reading) -> Result<Columns, TableError> {
    if count != 2 {
        return Err(TableError::Fields {
            line,
            found: count,
            allowed: 2,
        });
    }
    let y_is_value = reading.exact.is_some() || reading.differences;
    let y = if y_is_value { "value" } else { "error" };
    Ok(Columns {
        count,
        x: 0,
        x_is_n: false,
        y: 1,
        y_is_value,
        floor: None,
        names: vec!["h".into(), y.into()],
    })
}

/// The columns that a header names.
fn header(line: usize, names: &[&str], reading: &Reading) -> Result<Columns, TableError> {
    let (mut x, mut y, mut floor) = (None, None, None);
    for (index, name) in names.iter().enumerate() {
        let lower = name.to_lowercase();
        let lower = lower.as_str();
        let slot = if lower == "n" || X_NAMES.contains(&lower) {
            x.replace((index, lower == "n")).map(drop)
        } else if ERROR_NAMES.contains(&lower) || VALUE_NAMES.contains(&lower) {
            y.replace((index, VALUE_NAMES.contains(&lower))).map(drop)
        } else if lower == "floor" {
            floor.replace(index).map(drop)
        } else {
            return Err(TableError::UnknownColumn {
                line,
                name: (*name).into(),
            });
        };
        if slot.is_some() {
            return Err(TableError::ExtraColumn {
                line,
                name: (*name).into(),
            });
        }
    }
    let missing = |missing| TableError::MissingColumn { line, missing };
    let (x, x_is_n) = x.ok_or(missing("step"))?;
    let (y, y_is_value) = y.ok_or(missing("error or value"))?;
    if !y_is_value && (reading.exact.is_some() || reading.differences) {
        return Err(TableError::ErrorsForValues {
            line,
            name: names[y].into(),
        });
    }
    Ok(Columns {
        count: names.len(),
        x,
        x_is_n,
        y,
        y_is_value,
        floor,
        names: names.iter().map(|n| (*n).into()).collect(),
    })
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
    Ok(Row {
        line,
        n,
        step,
        step_text,
        y: number(columns.y)?,
        floor,
    })
}

/// Samples from rows already in order.
fn levels(rows: Vec<Row>, columns: &Columns, reading: &Reading) -> Table {
    let (common, floor_source) = if columns.floor.is_some() {
        (Float::new(53), FloorSource::Column)
    } else if let Some(floor) = &reading.floor {
        (floor.clone(), FloorSource::Given)
    } else if columns.y_is_value {
        let last_place = rows.iter().map(|r| r.y.last_place).min().unwrap_or(0);
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
        Levels::Errors(rows.into_iter().map(sample).collect())
    };
    Table {
        levels,
        floor_source,
    }
}

//! Tables of Taylor remainders as text: steps h, |f(x + hv) − f(x) − h g·v|, and perhaps |f(x + hv) − f(x)|.
//!
//! Rows as of [tables](super) of errors, with an optional header, or JSON: `[[h, r], …]`, `[[h, r, c], …]` or
//! `{"h": […], "remainder": […], "change": […]}`.

use super::{MAX_ROWS, TableError, fields, is_number_like, not_finite, separator};
use crate::convergence::Decimal;
use rug::Float;
use serde::Deserialize;

const STEPS: [&str; 4] = ["h", "eps", "epsilon", "step"];
const REMAINDERS: [&str; 4] = ["remainder", "r", "error", "e"];
const CHANGES: [&str; 3] = ["change", "c", "difference"];

/// One row.
#[derive(Clone, Debug, PartialEq)]
pub struct Remainder {
    /// h > 0.
    pub step: f64,
    /// |f(x + hv) − f(x) − h g·v|, as given; its sign does not count.
    pub remainder: Float,
    /// |f(x + hv) − f(x)|, where there is a column for it.
    pub change: Option<Float>,
}

/// JSON in one of its forms. Numbers in JSON may have all their digits; binary64 keeps what remainders need.
#[derive(Deserialize)]
#[serde(untagged)]
enum Json {
    Rows(Vec<Vec<f64>>),
    Columns {
        h: Vec<f64>,
        remainder: Vec<f64>,
        change: Option<Vec<f64>>,
    },
}

/// Which field is what.
struct Columns {
    count: usize,
    step: usize,
    remainder: usize,
    change: Option<usize>,
}

/// Reads remainders: rows in any order, from the largest step to the smallest.
///
/// # Errors
/// [`TableError`], with line and column, the offending text and what is allowed.
pub fn remainders(text: &str) -> Result<Vec<Remainder>, TableError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut rows = if text.trim_start().starts_with(['[', '{']) {
        of_json(text)?
    } else {
        of_lines(text)?
    };
    rows.sort_by(|(_, a), (_, b)| b.step.total_cmp(&a.step));
    for pair in rows.windows(2) {
        if let [(first, a), (line, b)] = pair
            && a.step.total_cmp(&b.step).is_eq()
        {
            return Err(TableError::Duplicate {
                line: *line,
                first: *first,
                text: b.step.to_string(),
            });
        }
    }
    match rows.as_slice() {
        [] => Err(TableError::Empty),
        [(line, _)] => Err(TableError::SingleRow { line: *line }),
        _ => Ok(rows.into_iter().map(|(_, row)| row).collect()),
    }
}

fn of_lines(text: &str) -> Result<Vec<(usize, Remainder)>, TableError> {
    let lines = text.lines().enumerate();
    let lines = lines.map(|(i, line)| (i + 1, line.split('#').next().unwrap_or("").trim()));
    let mut lines = lines.filter(|(_, line)| !line.is_empty()).peekable();
    let Some(&(line, first)) = lines.peek() else {
        return Err(TableError::Empty);
    };
    let separator = separator(first);
    let names = fields(first, separator);
    let columns = if names.iter().any(|field| is_number_like(field)) {
        without_header(line, names.len())?
    } else {
        lines.next();
        header(line, &names)?
    };
    let mut rows = Vec::new();
    for (line, text) in lines {
        if rows.len() == MAX_ROWS {
            return Err(TableError::TooManyRows { line });
        }
        rows.push((line, row(line, &fields(text, separator), &columns)?));
    }
    Ok(rows)
}

fn without_header(line: usize, count: usize) -> Result<Columns, TableError> {
    if !(2..=3).contains(&count) {
        let (found, allowed) = (count, 2);
        return Err(TableError::Fields {
            line,
            found,
            allowed,
        });
    }
    Ok(Columns {
        count,
        step: 0,
        remainder: 1,
        change: (count == 3).then_some(2),
    })
}

fn header(line: usize, names: &[&str]) -> Result<Columns, TableError> {
    let (mut step, mut remainder, mut change) = (None, None, None);
    for (index, name) in names.iter().enumerate() {
        let lower = name.to_lowercase();
        let is = |known: &[&str]| known.contains(&lower.as_str());
        let slot = if is(&STEPS) {
            &mut step
        } else if is(&REMAINDERS) {
            &mut remainder
        } else if is(&CHANGES) {
            &mut change
        } else {
            return Err(TableError::UnknownRemainder {
                line,
                name: (*name).into(),
            });
        };
        if slot.replace(index).is_some() {
            return Err(TableError::ExtraRemainder {
                line,
                name: (*name).into(),
            });
        }
    }
    let missing = |missing| TableError::MissingRemainder { line, missing };
    Ok(Columns {
        count: names.len(),
        step: step.ok_or(missing("step h"))?,
        remainder: remainder.ok_or(missing("remainder"))?,
        change,
    })
}

fn row(line: usize, row: &[&str], columns: &Columns) -> Result<Remainder, TableError> {
    if row.len() != columns.count {
        return Err(TableError::Fields {
            line,
            found: row.len(),
            allowed: columns.count,
        });
    }
    let field = |index: usize| row.get(index).copied().unwrap_or_default();
    let number = |index: usize, column: &str| {
        let text = field(index);
        let value = not_finite(text).or_else(|| Decimal::parse(text));
        value
            .map(|value| value.value)
            .ok_or_else(|| TableError::NotANumber {
                line,
                column: column.into(),
                text: text.into(),
            })
    };
    let step = number(columns.step, "h")?.to_f64();
    check_step(line, step)?;
    let change = columns.change.map(|index| number(index, "change"));
    Ok(Remainder {
        step,
        remainder: number(columns.remainder, "remainder")?,
        change: change.transpose()?,
    })
}

fn check_step(line: usize, step: f64) -> Result<(), TableError> {
    if step.is_normal() && step > 0.0 {
        return Ok(());
    }
    Err(TableError::Step {
        line,
        column: "h".into(),
        text: step.to_string(),
    })
}

/// The line of a row of JSON is its number.
fn of_json(text: &str) -> Result<Vec<(usize, Remainder)>, TableError> {
    let wrong = |reason: String| TableError::Json { reason };
    let json: Json = serde_json::from_str(text).map_err(|error| wrong(error.to_string()))?;
    let rows = match json {
        Json::Rows(rows) => rows,
        Json::Columns {
            h,
            remainder,
            change,
        } => {
            let lengths = [Some(remainder.len()), change.as_ref().map(Vec::len)];
            if let Some(found) = lengths.into_iter().flatten().find(|len| *len != h.len()) {
                let count = h.len();
                return Err(wrong(format!("columns of {count} and {found} numbers")));
            }
            let mut rows: Vec<Vec<f64>> = h
                .into_iter()
                .zip(remainder)
                .map(|(h, r)| vec![h, r])
                .collect();
            for (row, change) in rows.iter_mut().zip(change.into_iter().flatten()) {
                row.push(change);
            }
            rows
        }
    };
    if rows.len() > MAX_ROWS {
        return Err(TableError::TooManyRows { line: MAX_ROWS + 1 });
    }
    let float = |x: f64| Float::with_val(f64::MANTISSA_DIGITS, x);
    let count = rows.first().map_or(0, Vec::len);
    let rows = rows.into_iter().enumerate().map(|(index, row)| {
        let line = index + 1;
        if row.len() != count || !(2..=3).contains(&count) {
            return Err(TableError::Fields {
                line,
                found: row.len(),
                allowed: count.clamp(2, 3),
            });
        }
        let mut numbers = row.into_iter();
        let step = numbers.next().unwrap_or(f64::NAN);
        check_step(line, step)?;
        let remainder = float(numbers.next().unwrap_or(f64::NAN));
        let change = numbers.next().map(float);
        Ok((
            line,
            Remainder {
                step,
                remainder,
                change,
            },
        ))
    });
    rows.collect()
}

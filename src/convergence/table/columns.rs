//! What the columns of a table hold, by its header or without one.

use super::{Reading, TableError};

const X_NAMES: [&str; 4] = ["h", "d", "dx", "step"];
const ERROR_NAMES: [&str; 3] = ["error", "err", "e"];
const STANDARD_ERROR_NAMES: [&str; 2] = ["stderr", "se"];
const VALUE_NAMES: [&str; 4] = ["value", "v", "q", "result"];

/// What the columns hold.
pub(super) struct Columns {
    pub(super) count: usize,
    pub(super) x: usize,
    pub(super) x_is_n: bool,
    pub(super) y: usize,
    pub(super) y_is_value: bool,
    pub(super) floor: Option<usize>,
    pub(super) standard_error: Option<usize>,
    pub(super) names: Vec<String>,
}

/// Two columns: step, and what the reading says.
pub(super) fn without_header(
    line: usize,
    count: usize,
    reading: &Reading,
) -> Result<Columns, TableError> {
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
        standard_error: None,
        names: vec!["h".into(), y.into()],
    })
}

/// The columns that a header names.
pub(super) fn header(
    line: usize,
    names: &[&str],
    reading: &Reading,
) -> Result<Columns, TableError> {
    let (mut x, mut y, mut floor, mut standard_error) = (None, None, None, None);
    for (index, name) in names.iter().enumerate() {
        let lower = name.to_lowercase();
        let lower = lower.as_str();
        let slot = if lower == "n" || X_NAMES.contains(&lower) {
            x.replace((index, lower == "n")).map(drop)
        } else if ERROR_NAMES.contains(&lower) || VALUE_NAMES.contains(&lower) {
            y.replace((index, VALUE_NAMES.contains(&lower))).map(drop)
        } else if lower == "floor" {
            floor.replace(index).map(drop)
        } else if STANDARD_ERROR_NAMES.contains(&lower) {
            standard_error.replace(index).map(drop)
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
    if let Some(index) = standard_error
        && y_is_value
        && reading.exact.is_none()
    {
        return Err(TableError::StandardErrorOfDifferences {
            line,
            name: names[index].into(),
        });
    }
    if let (Some(index), Some(_)) = (floor, &reading.floor) {
        return Err(TableError::TwoFloors {
            line,
            name: names[index].into(),
        });
    }
    Ok(Columns {
        count: names.len(),
        x,
        x_is_n,
        y,
        y_is_value,
        floor,
        standard_error,
        names: names.iter().map(|n| (*n).into()).collect(),
    })
}

//! Rows of numbers.

/// The values in a row. `collect` would be compiled into four times as many functions, for every number and use.
pub(crate) fn row<R>(values: impl Iterator<Item = R>) -> Vec<R> {
    let mut row = Vec::with_capacity(values.size_hint().0);
    for value in values {
        row.push(value);
    }
    row
}

/// The same of values that may not be had.
pub(crate) fn try_row<R, E>(values: impl Iterator<Item = Result<R, E>>) -> Result<Vec<R>, E> {
    let mut row = Vec::with_capacity(values.size_hint().1.unwrap_or(0));
    for value in values {
        row.push(value?);
    }
    Ok(row)
}

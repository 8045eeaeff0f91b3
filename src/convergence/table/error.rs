//! What can be wrong with a table.

use super::MAX_ROWS;

/// The column names a header may have.
const ALLOWED_NAMES: &str =
    "h, d, dx, step or n; error, err, e, value, v, q or result; floor; stderr or se";

/// The column names a header of remainders may have.
const REMAINDER_NAMES: &str =
    "h, eps, epsilon or step; remainder, r, error or e; change, c or difference";

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
    /// More rows than any ladder has.
    #[error("line {line}: a row too many (allowed: up to {MAX_ROWS} rows)")]
    TooManyRows {
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
        "line {line}: column '{name}' is one too many (allowed: one step or n, one error or value, one floor, one standard error)"
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
    /// A header of remainders with an unknown name.
    #[error("line {line}: unknown column '{name}' (allowed: {REMAINDER_NAMES})")]
    UnknownRemainder {
        /// Line of the header.
        line: usize,
        /// The name.
        name: String,
    },
    /// A header of remainders that says one thing twice.
    #[error(
        "line {line}: column '{name}' is one too many (allowed: one of each of {REMAINDER_NAMES})"
    )]
    ExtraRemainder {
        /// Line of the header.
        line: usize,
        /// The name.
        name: String,
    },
    /// A header of remainders without a column that has to be there.
    #[error("line {line}: the header has no {missing} (allowed: {REMAINDER_NAMES})")]
    MissingRemainder {
        /// Line of the header.
        line: usize,
        /// What is missing.
        missing: &'static str,
    },
    /// JSON that holds no table.
    #[error(
        "{reason} (allowed: [[h, remainder], …], [[h, remainder, change], …] or an object with h, remainder and change)"
    )]
    Json {
        /// What is wrong.
        reason: String,
    },
    /// A standard error that is 0 or less.
    #[error("line {line}, {column}: '{text}' is not allowed (allowed: standard errors above 0)")]
    StandardError {
        /// Line of the field.
        line: usize,
        /// Column of the field.
        column: String,
        /// The field.
        text: String,
    },
    /// Standard errors of values whose differences are to be fitted.
    #[error(
        "line {line}: column '{name}' needs errors (allowed: a column of errors, or values with an exact value)"
    )]
    StandardErrorOfDifferences {
        /// Line of the header.
        line: usize,
        /// The name of the column.
        name: String,
    },
    /// A floor column, and a floor for every level beside it.
    #[error(
        "line {line}: column '{name}' and a common floor exclude each other (allowed: one of them)"
    )]
    TwoFloors {
        /// Line of the header.
        line: usize,
        /// The name of the column.
        name: String,
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

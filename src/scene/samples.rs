//! Samples of a field in files: CSV of one column, or `.npy` of one dimension.

use super::SceneProblem;
use crate::input;
use npyz::{DType, Endianness, NpyFile, TypeChar};
use rug::Rational;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;

/// More samples are no ray of a scene.
const MAX_SAMPLES: usize = 1 << 16;

/// How values between samples, or between the entries of a table, come about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// The value of the nearest one.
    Nearest,
    /// On a line between the two neighbours.
    #[default]
    Linear,
}

/// The samples of a file.
pub(super) fn read(path: &Path) -> Result<Vec<Rational>, SceneProblem> {
    let file = |problem: String| SceneProblem::File {
        path: path.display().to_string(),
        problem,
    };
    let is_npy = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("npy"));
    let values = if is_npy {
        let bytes = input::file(path, input::DATA).map_err(|error| file(error.to_string()))?;
        npy(&bytes).map_err(file)?
    } else {
        let text = input::text(path, input::DATA).map_err(|error| file(error.to_string()))?;
        csv(&text).map_err(file)?
    };
    check(&values).map_err(file)?;
    Ok(values)
}

/// Two samples or more, not too many.
fn check(values: &[Rational]) -> Result<(), String> {
    if (2..=MAX_SAMPLES).contains(&values.len()) {
        return Ok(());
    }
    Err(format!(
        "{} samples (allowed: 2 to {MAX_SAMPLES})",
        values.len()
    ))
}

/// One number a line; a first line that is none is a heading.
fn csv(text: &str) -> Result<Vec<Rational>, String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let mut values = Vec::new();
    for (i, record) in reader.records().enumerate() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let cell = match (record.len(), record.get(0)) {
            (1, Some(cell)) => cell,
            (count, _) => {
                return Err(format!(
                    "line {line}: {count} columns (allowed: one, of numbers)"
                ));
            }
        };
        match super::table::number(cell) {
            Some(value) => values.push(value),
            None if i == 0 => {}
            None => {
                let shown = cell.escape_debug();
                return Err(format!(
                    "line {line}: '{shown}' is no number (allowed: finite numbers)"
                ));
            }
        }
    }
    Ok(values)
}

/// One dimension of little-endian floats or integers.
fn npy(bytes: &[u8]) -> Result<Vec<Rational>, String> {
    const ALLOWED: &str = "allowed: one dimension of <f4, <f8, |u1, |i1, <u2 or <i2";
    let array = NpyFile::new(bytes).map_err(|error| format!("no .npy: {error} ({ALLOWED})"))?;
    let &[count] = array.shape() else {
        return Err(format!("{} dimensions ({ALLOWED})", array.shape().len()));
    };
    let DType::Plain(kind) = array.dtype() else {
        return Err(format!("records of several fields ({ALLOWED})"));
    };
    if kind.endianness() == Endianness::Big {
        return Err(format!("big-endian numbers, {kind} ({ALLOWED})"));
    }
    if usize::try_from(count).map_or(true, |count| count > MAX_SAMPLES) {
        return Err(format!("{count} samples (allowed: 2 to {MAX_SAMPLES})"));
    }
    let short = |error: std::io::Error| {
        if error.kind() == std::io::ErrorKind::UnexpectedEof {
            format!("ends before its {count} numbers do (allowed: a whole file)")
        } else {
            error.to_string()
        }
    };
    let all = |values: Vec<f64>| -> Result<Vec<Rational>, String> {
        let exact = values.iter().enumerate().map(|(i, &x)| {
            Rational::from_f64(x)
                .ok_or_else(|| format!("sample {i} is {x} (allowed: finite numbers)"))
        });
        exact.collect()
    };
    match (kind.type_char(), kind.size_field()) {
        (TypeChar::Float, 8) => all(array.into_vec::<f64>().map_err(short)?),
        (TypeChar::Float, 4) => all(widened(array.into_vec::<f32>().map_err(short)?)),
        (TypeChar::Uint, 1) => all(widened(array.into_vec::<u8>().map_err(short)?)),
        (TypeChar::Int, 1) => all(widened(array.into_vec::<i8>().map_err(short)?)),
        (TypeChar::Uint, 2) => all(widened(array.into_vec::<u16>().map_err(short)?)),
        (TypeChar::Int, 2) => all(widened(array.into_vec::<i16>().map_err(short)?)),
        _ => Err(format!("numbers of type {kind} ({ALLOWED})")),
    }
}

fn widened<T: Into<f64>>(values: Vec<T>) -> Vec<f64> {
    values.into_iter().map(Into::into).collect()
}

//! `study.toml`: what to run, as text.

use super::Errors;
use crate::case::file::{MAX_DOTS, deepest_dot, said};
use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use serde_json::Value;
use std::ops::Range;
use toml::Spanned;

/// The largest file that is read, in bytes.
const MAX_FILE: usize = 1 << 20;

/// A study as a file describes it: names only, which mean nothing yet.
///
/// ```toml
/// cases = ["sine-squared", "rgb-transfer/red", "@jump", "mine.toml"]
/// methods = ["trapezoid/trapezoid", "simpson/boole"]
/// formats = ["f32", "f64", "mpfr:128"]
/// levels = "8..4096"
/// sweep-bits = "4..53"
/// errors = "split"
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[schemars(title = "A study of volver", transform = without_defaults)]
pub struct StudyFile {
    /// Cases: names of the catalogue, one channel of a case (NAME/CHANNEL), all with a tag (@TAG), or paths to
    /// case files, relative to this file.
    #[serde(default)]
    #[schemars(with = "Vec<String>", length(min = 1))]
    pub cases: Option<Spanned<Vec<Spanned<String>>>>,
    /// Methods by name, such as trapezoid/simpson.
    #[serde(default)]
    #[schemars(with = "Vec<String>", length(min = 1))]
    pub methods: Option<Spanned<Vec<Spanned<String>>>>,
    /// Formats by name, such as f32 or mpfr:128.
    #[serde(default)]
    #[schemars(with = "Vec<String>", length(min = 1))]
    pub formats: Option<Spanned<Vec<Spanned<String>>>>,
    /// Numbers of segments: a ladder such as 8..4096, or a list.
    #[serde(default)]
    #[schemars(with = "FileLevels")]
    pub levels: Option<Spanned<FileLevels>>,
    /// Formats mpfr:A to mpfr:B besides, for a map of correct digits: A..B.
    #[serde(default)]
    #[schemars(with = "String")]
    pub sweep_bits: Option<Spanned<String>>,
    /// Whether errors are split into parts, or known as a whole alone at a small part of the cost: split or total.
    #[serde(default)]
    #[schemars(with = "Errors")]
    pub errors: Option<Spanned<String>>,
}

/// Numbers of segments, as a ladder's text or as a list.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "levels are neither text nor a list of numbers (allowed: \"8..4096\", or [8, 16, 32])"
)]
pub enum FileLevels {
    /// A ladder such as `8..4096`.
    Ladder(String),
    /// These.
    List(Vec<u64>),
}

/// What is wrong with a study's file, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct StudyFileError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub problem: StudyFileProblem,
}

/// What can be wrong with a study's file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StudyFileProblem {
    /// Too many bytes.
    #[error("{bytes} bytes are too long a file (allowed: up to {MAX_FILE})")]
    TooLong {
        /// How many.
        bytes: usize,
    },
    /// Dotted keys of too many parts.
    #[error("too many parts of a key (allowed: up to {})", MAX_DOTS + 1)]
    TooDeep,
    /// No TOML, a key that means nothing, or a value of another type.
    #[error("{message}")]
    Content {
        /// What the reader said, and what is allowed.
        message: String,
    },
}

/// A key that is left out has no value in TOML: not even null.
fn without_defaults(schema: &mut Schema) {
    let properties = schema.get_mut("properties").and_then(Value::as_object_mut);
    for property in properties.into_iter().flat_map(|all| all.values_mut()) {
        if let Some(property) = property.as_object_mut() {
            property.remove("default");
        }
    }
}

impl StudyFile {
    /// The JSON Schema of the file.
    #[must_use]
    pub fn schema() -> Value {
        schemars::schema_for!(StudyFile).to_value()
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`StudyFileError`] with the line, the problem and what is allowed.
    pub fn read(text: &str) -> Result<StudyFile, StudyFileError> {
        let at = |at: usize, problem| StudyFileError {
            line: line(text, at),
            problem,
        };
        if text.len() > MAX_FILE {
            let bytes = text.len();
            return Err(at(0, StudyFileProblem::TooLong { bytes }));
        }
        if let Some(dot) = deepest_dot(text) {
            return Err(at(dot, StudyFileProblem::TooDeep));
        }
        toml::from_str(text).map_err(|error| {
            let span = error.span().unwrap_or_default();
            let message = said(
                error.message(),
                "TOML with the keys of 'volver schema study'",
            );
            at(span.start, StudyFileProblem::Content { message })
        })
    }

    /// The line in `text`, counted from 1, where a span starts.
    #[must_use]
    pub fn line(text: &str, span: &Range<usize>) -> usize {
        line(text, span.start)
    }
}

fn line(text: &str, at: usize) -> usize {
    let before = text.get(..at).unwrap_or_default();
    before.matches('\n').count() + 1
}

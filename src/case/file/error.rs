//! A problem of a case file at its place.

use super::excerpt::{Excerpt, Place};
use super::problem::FileProblem;

/// What is wrong with a case file, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {problem}")]
pub struct FileError {
    /// The line it is about, counted from 1; 1 where it is about no place.
    pub line: usize,
    /// The character of the line, counted from 1; 1 where it is about no place.
    pub column: usize,
    /// What is wrong.
    pub problem: FileProblem,
    excerpt: Option<Box<Excerpt>>,
}

impl FileError {
    /// `at` is the byte the problem starts at.
    pub(super) fn new(text: &str, at: usize, problem: FileProblem) -> FileError {
        let place = Place::new(text, at);
        FileError {
            line: place.line,
            column: place.column,
            problem,
            excerpt: Some(Box::new(place.excerpt)),
        }
    }

    pub(super) fn without_place(problem: FileProblem) -> FileError {
        FileError {
            line: 1,
            column: 1,
            problem,
            excerpt: None,
        }
    }

    /// Two lines: part of the file's line, and a caret under the place; none where it is about no place.
    #[must_use]
    pub fn caret(&self) -> Option<String> {
        self.excerpt.as_deref().map(Excerpt::caret)
    }
}

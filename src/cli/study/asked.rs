//! What is asked for, by options or in a file, and where.

use crate::cli::Failure;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use toml::Spanned;
use volver::input::{self, WRITTEN};
use volver::study::sweep::StudyFile;

/// A list of names as a file has it.
pub(in crate::cli) type Names = Spanned<Vec<Spanned<String>>>;

/// The file, if there is one.
pub(in crate::cli) struct Asking {
    path: PathBuf,
    text: String,
    pub(in crate::cli) file: StudyFile,
}

/// A name that is asked for.
#[derive(Clone, Debug)]
pub(in crate::cli) struct Asked {
    pub(in crate::cli) text: String,
    /// The option, or the file and its line.
    pub(in crate::cli) at: String,
    /// Paths in a file are relative to it.
    pub(in crate::cli) directory: Option<PathBuf>,
}

impl Asked {
    /// Why it cannot be had, in one line.
    pub(in crate::cli) fn refused(&self, why: impl Display) -> Failure {
        Failure::Usage(format!("{}: {why}", self.at))
    }

    /// The text, safe for a message.
    pub(in crate::cli) fn shown(&self) -> String {
        self.text.escape_debug().to_string()
    }
}

impl Asking {
    pub(in crate::cli) fn new(path: Option<&Path>) -> Result<Asking, Failure> {
        let Some(path) = path else {
            return Ok(Asking {
                path: PathBuf::new(),
                text: String::new(),
                file: StudyFile::default(),
            });
        };
        let shown = || path.display().to_string();
        let text = input::text(path, WRITTEN).map_err(|error| Failure::Input {
            path: shown(),
            error,
        })?;
        let file = StudyFile::read(&text).map_err(|error| Failure::Content {
            path: shown(),
            error: error.into(),
        })?;
        Ok(Asking {
            path: path.into(),
            text,
            file,
        })
    }

    /// Where in the file something stands.
    pub(in crate::cli) fn place<T>(&self, of: &Spanned<T>) -> String {
        let line = StudyFile::line(&self.text, &of.span());
        format!("{}, line {line}", self.path.display())
    }

    /// The names that an option has or else the file; none where neither says. `what` they are, for a message.
    pub(in crate::cli) fn names(
        &self,
        option: &'static str,
        given: &[String],
        in_file: Option<&Names>,
        what: &str,
        split: fn(&str) -> Vec<String>,
    ) -> Result<Option<Vec<Asked>>, Failure> {
        let empty = |at: String| Failure::Usage(format!("{at}: no {what} (allowed: one or more)"));
        if !given.is_empty() {
            let names = given.iter().flat_map(|text| split(text));
            let names: Vec<Asked> = names
                .map(|text| Asked {
                    text,
                    at: option.into(),
                    directory: None,
                })
                .collect();
            return if names.is_empty() {
                Err(empty(option.into()))
            } else {
                Ok(Some(names))
            };
        }
        let Some(list) = in_file else {
            return Ok(None);
        };
        let names: Vec<Asked> = list
            .get_ref()
            .iter()
            .map(|name| Asked {
                text: name.get_ref().clone(),
                at: self.place(name),
                directory: self.path.parent().map(Into::into),
            })
            .collect();
        if names.is_empty() {
            return Err(empty(self.place(list)));
        }
        Ok(Some(names))
    }
}

/// The parts between commas, blanks and semicolons.
pub(in crate::cli) fn split(text: &str) -> Vec<String> {
    let parts = text.split(|c: char| c == ',' || c == ';' || c.is_whitespace());
    parts
        .filter(|part| !part.is_empty())
        .map(Into::into)
        .collect()
}

//! The rule that a method of volver's own states: it is read, and not probed.

use super::formula;
use super::json::Rule as Written;
use crate::document::{About, Conclusion, Document, Fact, Section};
use crate::identify::Rule;
use crate::render::{ReportError, write_document};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// A method, and its rule.
#[derive(Clone, Debug)]
pub struct Stated {
    /// The method's name.
    pub name: String,
    /// What it states.
    pub rule: Rule,
}

#[derive(Serialize)]
struct Json<'a> {
    volver: &'static str,
    kernel: &'a str,
    verdict: &'static str,
    rule: Written<'a>,
}

impl Stated {
    /// The rule.
    #[must_use]
    pub fn document(&self, about: &About) -> Document {
        let mut document = Document::new("identify", &self.name, about.clone());
        document.summary = vec![Fact::new("the rule is", "stated, not probed")];
        document.conclusion = Some(Conclusion::new("The rule is stated, and was not probed"));
        document.sections = vec![Section::of("rule", "What it computes", formula(&self.rule))];
        document
    }

    /// `{"volver": version, "kernel": …, "verdict": "stated", "rule": …}`, indented, with a newline at the end.
    ///
    /// # Errors
    /// [`ReportError::Json`] where a parameter is not finite.
    pub fn json(&self) -> Result<String, ReportError> {
        let document = Json {
            volver: env!("CARGO_PKG_VERSION"),
            kernel: &self.name,
            verdict: "stated",
            rule: Written::of(&self.rule),
        };
        Ok(serde_json::to_string_pretty(&document)? + "\n")
    }

    /// Writes `identify.md`, `identify.json` and a page into `dir`; returns the paths written.
    ///
    /// # Errors
    /// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
    pub fn write(&self, dir: &Path, about: &About) -> Result<Vec<PathBuf>, ReportError> {
        let data = [("identify.json".to_string(), self.json()?)];
        write_document(dir, &self.document(about), "identify", data)
    }
}

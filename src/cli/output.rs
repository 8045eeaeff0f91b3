//! Where output goes: text to standard output, files to a directory, and each other form to its place, `-` for standard output.

use super::{Color, Failure, width, write_out};
use std::fmt::{Display, Write};
use std::path::{Path, PathBuf};
use volver::document::Document;
use volver::render::{self, ReportError};

/// Where what came out goes.
pub(super) struct Output<'a> {
    /// The directory for all forms.
    pub(super) out: Option<&'a Path>,
    /// Options with the file for one form each.
    pub(super) files: Vec<(&'static str, Option<&'a Path>)>,
    pub(super) quiet: bool,
    pub(super) color: Color,
}

impl Output<'_> {
    /// Whether all will find its place, asked before the work is done; standard output is for one thing at a time.
    pub(super) fn check(&self) -> Result<(), Failure> {
        let dashes = self.files.iter().filter(|(_, file)| is_dash(*file));
        let dashes: Vec<&str> = dashes.map(|(option, _)| *option).collect();
        if let [first, second, ..] = dashes[..] {
            return Err(Failure::Usage(format!(
                "'{first} -' and '{second} -' both go to standard output (allowed: one of them with a file)"
            )));
        }
        if let Some(directory) = self.out {
            render::check_directory(directory)?;
        }
        let files = self.files.iter().filter_map(|(_, file)| *file);
        for file in files.filter(|file| !is_dash(Some(file))) {
            render::check_file(file)?;
        }
        Ok(())
    }

    /// Whether standard output is for the text.
    pub(super) fn prints_text(&self) -> bool {
        !self.quiet && !self.files.iter().any(|(_, file)| is_dash(*file))
    }

    /// The document as text, and of each option the form that `form` makes.
    pub(super) fn show(
        &self,
        document: &Document,
        form: impl Fn(&str) -> Result<String, ReportError>,
    ) -> Result<(), Failure> {
        self.hand_out(document, |_| Ok(Vec::new()), form)
    }

    /// The document as text, `write`'s files into the directory, and of each option the form that `form` makes.
    pub(super) fn hand_out(
        &self,
        document: &Document,
        write: impl FnOnce(&Path) -> Result<Vec<PathBuf>, ReportError>,
        form: impl Fn(&str) -> Result<String, ReportError>,
    ) -> Result<(), Failure> {
        let mut printed = String::new();
        if self.prints_text() {
            printed = render::terminal(document, width(), self.color.is_on());
        }
        if let Some(directory) = self.out {
            render::make_directory(directory)?;
            let files = write(directory)?;
            if self.prints_text() {
                // Writing to a String does not fail.
                let _ = writeln!(printed, "{} files in {}", files.len(), directory.display());
            }
        }
        self.print(printed, form)
    }

    /// This text, and of each option the form that `form` makes.
    pub(super) fn print(
        &self,
        text: String,
        form: impl Fn(&str) -> Result<String, ReportError>,
    ) -> Result<(), Failure> {
        let mut printed = text;
        for (option, file) in &self.files {
            if let Some(file) = file {
                put(file, &form(option)?, &mut printed)?;
            }
        }
        write_out(&printed)
    }
}

/// The tables of a document for programs, one below the other.
pub(super) fn csv(document: &Document) -> Result<String, ReportError> {
    let tables = render::csv(document)?.into_iter();
    Ok(tables.map(|(_, table)| table).collect())
}

/// Into a file, or to what is printed.
pub(super) fn put(file: &Path, text: &str, printed: &mut String) -> Result<(), Failure> {
    if is_dash(Some(file)) {
        printed.push_str(text);
        return Ok(());
    }
    Ok(render::write_file(file, text)?)
}

/// Whether standard output is meant.
pub(super) fn is_dash(file: Option<&Path>) -> bool {
    file == Some(Path::new("-"))
}

/// "1 unit", "2 units".
pub(super) fn noun(count: usize, one: &str, many: &str) -> String {
    match count {
        1 => format!("1 {one}"),
        count => format!("{count} {many}"),
    }
}

/// What a library's error says.
pub(super) fn said(error: impl Display) -> Failure {
    Failure::Usage(error.to_string())
}

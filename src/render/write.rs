//! Documents as files: each is complete or not there at all.

use super::html::place;
use super::{ReportError, csv, latex, markdown, svg};
use crate::document::{Block, Document, Medium};
use crate::output;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Writes a document into `dir`, which is made where it does not exist: its figures and maps as SVG, `data` (names of files
/// and what is in them), its tables for programs as CSV and for papers as `stem.tex` if it has any, `stem.md`, and a page,
/// `index.html`. Returns the paths written.
///
/// Each file appears whole (see [`write_file`]), the text behind its figures, so that it never links to one that is
/// missing, and the page last. Other files in `dir` stay; [`place`] says what the page is called beside other pages.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write_document(
    dir: &Path,
    document: &Document,
    stem: &str,
    data: impl IntoIterator<Item = (String, String)>,
) -> Result<Vec<PathBuf>, ReportError> {
    let has = |medium| {
        let mut blocks = document.blocks();
        blocks.any(|block| matches!(block, Block::For(own, _) if *own == medium))
    };
    let mut files: Vec<(String, String)> = svg::files(document);
    files.extend(data);
    if has(Medium::Csv) {
        let tables = csv(document)?.into_iter();
        files.extend(tables.map(|(stem, table)| (format!("{stem}.csv"), table)));
    }
    if has(Medium::Latex) {
        files.push((format!("{stem}.tex"), latex(document)));
    }
    files.push((format!("{stem}.md"), markdown(document)));
    let files = files
        .into_iter()
        .map(|(name, contents)| (dir.join(name), contents));
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, document)?);
    Ok(paths)
}

/// Writes contents, made before, into `dir` in their order; `dir` is made where it does not exist. Returns the
/// paths written.
fn write_files(
    dir: &Path,
    files: impl IntoIterator<Item = (PathBuf, String)>,
) -> Result<Vec<PathBuf>, ReportError> {
    fs::create_dir_all(dir).map_err(|reason| ReportError::Directory {
        path: dir.into(),
        reason,
    })?;
    let written = files.into_iter().map(|(path, contents)| {
        write_file(&path, &contents)?;
        Ok(path)
    });
    written.collect()
}

/// Writes a file whole, in place of the old one: a reader sees the old contents or the new ones, and after a failure
/// the old ones stay.
///
/// # Errors
///
/// [`ReportError::File`] with the path and the system's reason.
pub fn write_file(path: &Path, contents: impl AsRef<[u8]>) -> Result<(), ReportError> {
    output::replace(path, |file| file.write_all(contents.as_ref())).map_err(|reason: io::Error| {
        ReportError::File {
            path: path.into(),
            reason,
        }
    })
}

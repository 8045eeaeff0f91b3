//! Documents as files: each is complete or not there at all.

use super::html::place;
use super::{ReportError, csv, latex, markdown, svg};
use crate::document::{Block, Document, Medium};
use std::fs;
use std::io::{self, Write};
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

/// Writes a file whole: into a temporary file beside it, which then takes its name.
///
/// A reader sees the old contents or the new ones; after a failure the old ones stay and nothing
/// else is left behind. A new file is readable by everybody that the directory lets in, an old one
/// keeps its permissions. Special files (`/dev/stdout`, a pipe) cannot be replaced: they are
/// written to directly.
///
/// # Errors
///
/// [`ReportError::File`] with the path and the system's reason.
pub fn write_file(path: &Path, contents: impl AsRef<[u8]>) -> Result<(), ReportError> {
    replace(path, contents.as_ref()).map_err(|reason| ReportError::File {
        path: path.into(),
        reason,
    })
}

fn replace(path: &Path, contents: &[u8]) -> io::Result<()> {
    // A link stays a link: what it leads to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let old = fs::metadata(&target).ok();
    if old.as_ref().is_some_and(|m| !m.is_file() && !m.is_dir()) {
        return fs::write(&target, contents);
    }
    let parent = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".volver-");
    // Temporary files are private otherwise; the process's mask still applies.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(parent)?;
    file.write_all(contents)?;
    if let Some(old) = old {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(&target)?;
    Ok(())
}

//! The reports of a directory, by their pages.

use super::KIND;
use crate::document::Document;
use crate::input::{self, InputError};
use crate::render::html::{INDEX, PageError, read};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A report with the name that tells it from the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The directory as it was given, and the kind of report where the directory has several.
    pub name: String,
    /// The report.
    pub page: Document,
}

/// Why reports cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum ComparisonError {
    /// A directory cannot be read.
    #[error("'{}': {reason} (allowed: directories that 'volver … --out DIR' wrote)", path.display())]
    Unreadable {
        /// The directory.
        path: PathBuf,
        /// What the operating system says.
        #[source]
        reason: io::Error,
    },
    /// A page cannot be read, or is too long.
    #[error("'{}': {reason}", path.display())]
    Page {
        /// The page.
        path: PathBuf,
        /// Why.
        #[source]
        reason: InputError,
    },
    /// A directory has no page.
    #[error("'{}': no page (allowed: directories that 'volver … --out DIR' wrote)", path.display())]
    NoPage {
        /// The directory.
        path: PathBuf,
    },
    /// A page cannot be read back.
    #[error("'{}': {reason}", path.display())]
    Document {
        /// The page.
        path: PathBuf,
        /// Why.
        #[source]
        reason: PageError,
    },
    /// A directory was given twice.
    #[error("'{}': the same directory as '{}' (allowed: each once)", path.display(), first.display())]
    Twice {
        /// The directory as it was given the second time.
        path: PathBuf,
        /// And the first time.
        first: PathBuf,
    },
}

/// The reports of all these directories, in their order; earlier comparisons are none.
///
/// # Errors
/// [`ComparisonError`] for the first directory or page that cannot be read, or comes twice.
pub fn read_all(dirs: &[impl AsRef<Path>]) -> Result<Vec<Part>, ComparisonError> {
    let mut seen: Vec<(PathBuf, &Path)> = Vec::new();
    let mut parts = Vec::new();
    for dir in dirs {
        let dir = dir.as_ref();
        let place = fs::canonicalize(dir).map_err(|reason| unreadable(dir, reason))?;
        if let Some((_, first)) = seen.iter().find(|(known, _)| *known == place) {
            return Err(ComparisonError::Twice {
                path: dir.into(),
                first: (*first).into(),
            });
        }
        seen.push((place, dir));
        parts.extend(of_directory(dir)?);
    }
    Ok(parts)
}

fn of_directory(dir: &Path) -> Result<Vec<Part>, ComparisonError> {
    let mut pages = Vec::new();
    let mut foreign = None;
    for name in names(dir)? {
        let path = dir.join(&name);
        let bytes = match input::file(&path, input::COMPUTED) {
            Ok(bytes) => bytes,
            // Another program's, as below: none of ours is as long.
            Err(InputError::TooLong { .. }) if name != INDEX => continue,
            Err(reason) => return Err(ComparisonError::Page { path, reason }),
        };
        match read(&String::from_utf8_lossy(&bytes)) {
            Ok(page) if page.kind == KIND => {}
            Ok(page) => pages.push(page),
            // Another program's pages may lie beside ours.
            Err(PageError::Foreign) if name != INDEX => {}
            Err(PageError::Foreign) => foreign = Some(path),
            Err(reason) => return Err(ComparisonError::Document { path, reason }),
        }
    }
    if pages.is_empty() {
        return Err(match foreign {
            Some(path) => ComparisonError::Document {
                path,
                reason: PageError::Foreign,
            },
            None => ComparisonError::NoPage { path: dir.into() },
        });
    }
    let shown = dir.display();
    let is_alone = pages.len() == 1;
    let part = |page: Document| Part {
        name: if is_alone {
            shown.to_string()
        } else {
            format!("{shown}: {}", page.kind)
        },
        page,
    };
    Ok(pages.into_iter().map(part).collect())
}

/// The files that may be pages, the index first, then by name.
fn names(dir: &Path) -> Result<Vec<String>, ComparisonError> {
    let mut names = Vec::new();
    for entry in fs::read_dir(dir).map_err(|reason| unreadable(dir, reason))? {
        let entry = entry.map_err(|reason| unreadable(dir, reason))?;
        let is_directory = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let name = entry.file_name().into_string().ok();
        let is_page = |name: &String| !is_directory && name.strip_suffix(".html").is_some();
        names.extend(name.filter(is_page));
    }
    names.sort_by_key(|name| (name != INDEX, name.clone()));
    Ok(names)
}

fn unreadable(path: &Path, reason: io::Error) -> ComparisonError {
    ComparisonError::Unreadable {
        path: path.into(),
        reason,
    }
}

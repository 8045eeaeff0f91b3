//! Which file of a directory a page becomes.

use super::{PageError, read, render};
use crate::document::{Document, Link};
use crate::input::{self, InputError};
use crate::render::{ReportError, write_file};
use std::fs;
use std::path::{Path, PathBuf};

/// The page that a directory opens with.
pub const INDEX: &str = "index.html";

/// Writes a page into a directory of reports, which is there already; returns its path.
///
/// The first page of a directory is its `index.html`. A page of another kind beside it is named after its kind
/// (`nonsmooth.html`), so that none overwrites another, and all of them link to each other. An `index.html` that another
/// program wrote stays as it is.
///
/// # Errors
/// [`ReportError::File`] with the path and the system's reason.
pub fn place(dir: &Path, page: &Document) -> Result<PathBuf, ReportError> {
    let own = format!("{}.html", page.kind);
    let others: Vec<(String, Document)> = pages(dir)
        .into_iter()
        .filter(|(_, other)| other.kind != page.kind)
        .collect();
    let is_taken = others.iter().any(|(file, _)| file == INDEX) || is_foreign(&dir.join(INDEX));
    let file = if is_taken { own } else { INDEX.into() };
    let mut linked = page.clone();
    linked.links = others
        .iter()
        .map(|(file, other)| link(file, other))
        .collect();
    let path = dir.join(&file);
    write_file(&path, &render(&linked)?)?;
    for (name, mut other) in others {
        let known: Vec<Link> = other.links.clone();
        other.links.retain(|link| link.file != file);
        other.links.push(link(&file, page));
        other.links.sort_by(|a, b| a.file.cmp(&b.file));
        if other.links != known {
            write_file(&dir.join(&name), &render(&other)?)?;
        }
    }
    Ok(path)
}

fn link(file: &str, page: &Document) -> Link {
    Link {
        file: file.into(),
        title: page.title.clone(),
    }
}

/// The reports of a directory with the names of their files, the index first, then by name; comparisons are none.
fn pages(dir: &Path) -> Vec<(String, Document)> {
    let entries = fs::read_dir(dir).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut names: Vec<String> = names
        .filter(|name| name.strip_suffix(".html").is_some())
        .collect();
    names.sort_by_key(|name| (name != INDEX, name.clone()));
    let page = |name: String| {
        let text = input::text(&dir.join(&name), input::COMPUTED).ok()?;
        Some((name, read(&text).ok()?))
    };
    names.into_iter().filter_map(page).collect()
}

/// Whether there is a file that this program did not write.
fn is_foreign(path: &Path) -> bool {
    match input::file(path, input::COMPUTED) {
        Ok(bytes) => matches!(
            read(&String::from_utf8_lossy(&bytes)),
            Err(PageError::Foreign)
        ),
        Err(InputError::TooLong { .. }) => true,
        Err(_) => false,
    }
}

//! Names, titles and tags.

use super::table::{Entry, Table};
use super::{FileError, FileProblem};
use super::{MAX_NAME, MAX_TITLE};

/// Refuses what is not kebab-case.
pub(super) fn check_name(text: &str) -> Result<(), FileProblem> {
    let of_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    let good = text.len() <= MAX_NAME
        && text.starts_with(|c: char| c.is_ascii_lowercase())
        && text.chars().all(of_name);
    if good {
        return Ok(());
    }
    Err(FileProblem::Name { text: text.into() })
}

impl<'f> Entry<'f> {
    /// The value as a name in kebab-case.
    pub(super) fn name(&self) -> Result<&'f str, FileError> {
        let name = self.text()?;
        check_name(name).map_err(|problem| self.value_error(problem))?;
        Ok(name)
    }
}

/// The title, empty without one.
pub(super) fn title(top: &Table<'_>) -> Result<String, FileError> {
    let Some(entry) = top.entry("title") else {
        return Ok(String::new());
    };
    let title = entry.text()?;
    if title.chars().count() > MAX_TITLE || title.chars().any(char::is_control) {
        return Err(entry.value_error(FileProblem::Title));
    }
    Ok(title.to_string())
}

/// The tags, none without any.
pub(super) fn tags(top: &Table<'_>) -> Result<Vec<String>, FileError> {
    let Some(entry) = top.entry("tags") else {
        return Ok(Vec::new());
    };
    let tags = entry.elements("an array of names in quotes")?;
    tags.iter().map(|tag| Ok(tag.name()?.to_string())).collect()
}

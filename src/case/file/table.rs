//! Tables of a file whose entries know their places.

use super::excerpt::Place;
use super::{FileError, FileProblem};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A table of the file.
#[derive(Clone)]
pub(super) struct Table<'f> {
    text: &'f str,
    entries: &'f DeTable<'f>,
    /// What stands before the names of its keys in messages.
    prefix: String,
    /// Its own key and the byte where it stands; none for the file itself.
    own_key: Option<(&'f str, usize)>,
}

/// A key of the file and its value.
pub(super) struct Entry<'f> {
    text: &'f str,
    name: &'f str,
    path: String,
    at: usize,
    value: &'f Spanned<DeValue<'f>>,
}

impl<'f> Table<'f> {
    pub(super) fn top(text: &'f str, entries: &'f DeTable<'f>) -> Table<'f> {
        Table {
            text,
            entries,
            prefix: String::new(),
            own_key: None,
        }
    }

    /// All entries, in the order of the file.
    pub(super) fn entries(&self) -> Vec<Entry<'f>> {
        let mut entries: Vec<Entry<'f>> = self
            .entries
            .iter()
            .map(|(key, value)| Entry {
                text: self.text,
                name: key.get_ref(),
                path: self.path(key.get_ref()),
                at: key.span().start,
                value,
            })
            .collect();
        entries.sort_by_key(|entry| entry.at);
        entries
    }

    /// Its own key and the byte where it stands; none for the file itself.
    pub(super) fn own_key(&self) -> Option<(&'f str, usize)> {
        self.own_key
    }

    /// A problem at a byte of the file.
    pub(super) fn error(&self, at: usize, problem: FileProblem) -> FileError {
        FileError::new(self.text, at, problem)
    }

    /// A key of this table as messages name it.
    pub(super) fn path(&self, key: &str) -> String {
        format!("{}{key}", self.prefix)
    }

    pub(super) fn entry(&self, key: &str) -> Option<Entry<'f>> {
        self.entries().into_iter().find(|entry| entry.name == key)
    }

    pub(super) fn required(&self, key: &'static str) -> Result<Entry<'f>, FileError> {
        self.entry(key)
            .ok_or_else(|| FileError::without_place(FileProblem::Missing { key }))
    }

    /// Refuses keys other than `allowed`.
    pub(super) fn allow(&self, allowed: &[&'static str]) -> Result<(), FileError> {
        let entries = self.entries();
        let unknown = entries.iter().find(|entry| !allowed.contains(&entry.name));
        unknown.map_or(Ok(()), |entry| {
            Err(entry.error(FileProblem::UnknownKey {
                key: entry.path.clone(),
                allowed: allowed.to_vec(),
            }))
        })
    }
}

impl<'f> Entry<'f> {
    /// The key alone.
    pub(super) fn name_of_key(&self) -> &'f str {
        self.name
    }

    /// The key with those of the tables it stands in.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// Where the key stands.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn value(&self) -> &'f DeValue<'f> {
        self.value.get_ref()
    }

    /// A problem with the key.
    pub(super) fn error(&self, problem: FileProblem) -> FileError {
        FileError::new(self.text, self.at, problem)
    }

    /// A problem with the value.
    pub(super) fn value_error(&self, problem: FileProblem) -> FileError {
        FileError::new(self.text, self.value.span().start, problem)
    }

    /// A problem with the text that the value is, at the byte `at` of it.
    pub(super) fn text_error(&self, at: usize, problem: FileProblem) -> FileError {
        let start = match self.start_of_text() {
            Some(start) => start + at,
            None => self.value.span().start,
        };
        FileError::new(self.text, start, problem)
    }

    /// The column of the file of the first character of the text that the value is, as far as it is known.
    pub(super) fn column_of_text(&self) -> Option<usize> {
        let start = self.start_of_text()?;
        Some(Place::new(self.text, start).column)
    }

    /// The byte of the file where the text that the value is starts; none where it is not written as it is:
    /// with escapes or in several lines.
    fn start_of_text(&self) -> Option<usize> {
        let span = self.value.span();
        let (start, end) = (span.start.checked_add(1)?, span.end.checked_sub(1)?);
        let written = self.text.get(start..end)?;
        (Some(written) == self.value().as_str()).then_some(start)
    }

    pub(super) fn type_error(&self, allowed: &'static str) -> FileError {
        let key = self.path.clone();
        self.value_error(FileProblem::Type {
            key,
            found: type_name(self.value()),
            allowed,
        })
    }

    pub(super) fn text(&self) -> Result<&'f str, FileError> {
        let text = self.value().as_str();
        text.ok_or_else(|| self.type_error("a text in quotes"))
    }

    pub(super) fn table(&self) -> Result<Table<'f>, FileError> {
        let DeValue::Table(entries) = self.value() else {
            return Err(self.type_error("a table"));
        };
        Ok(Table {
            text: self.text,
            entries,
            prefix: format!("{}.", self.path),
            own_key: Some((self.name, self.at)),
        })
    }

    /// An entry for each element of an array.
    pub(super) fn elements(&self, allowed: &'static str) -> Result<Vec<Entry<'f>>, FileError> {
        let DeValue::Array(elements) = self.value() else {
            return Err(self.type_error(allowed));
        };
        let entry = |value: &'f Spanned<DeValue<'f>>| Entry {
            text: self.text,
            name: self.name,
            path: self.path.clone(),
            at: value.span().start,
            value,
        };
        Ok(elements.iter().map(entry).collect())
    }
}

fn type_name(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) => "an integer",
        DeValue::Float(_) => "a float",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    }
}

//! The figures and maps of a document as SVG files that stand alone.
//!
//! A figure has a panel a plot, under one title; a map is a table whose cells are coloured. The same document gives the same
//! bytes. Text is left to the reader's sans-serif font.

use crate::document::Document;

/// The figures and maps that have a name, each with the name of its file, `name.svg`.
#[must_use]
pub fn files(_document: &Document) -> Vec<(String, String)> {
    Vec::new()
}

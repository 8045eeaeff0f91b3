//! The figures and maps of a document as SVG files that stand alone.
//!
//! A figure has a panel a plot, under its caption; a map is a table whose cells are coloured, and tables with the same file
//! name share one. The same document gives the same bytes. Text is left to the reader's sans-serif font.

mod figure;
mod flow;
mod map;
mod sheet;

pub use figure::figure;

use crate::document::{Block, Document, Medium, Table};

/// Who sees figures as files.
const MEDIA: [Medium; 3] = [Medium::Written, Medium::Markdown, Medium::Page];

/// The figures and maps that have a name, each with the name of its file, `name.svg`, in the order of the document.
///
/// Only letters, digits, dashes and underscores make a name: a document that was read may say anything.
#[must_use]
pub fn files(document: &Document) -> Vec<(String, String)> {
    let blocks: Vec<&Block> = document
        .blocks()
        .filter_map(|block| block.shown_in(&MEDIA))
        .collect();
    let mut files: Vec<(String, String)> = Vec::new();
    for block in &blocks {
        let (name, draw): (&str, Box<dyn Fn() -> String>) = match block {
            Block::Figure(drawn) => (&drawn.file, Box::new(|| figure(drawn))),
            Block::Table(table) if table.is_shaded() => (
                &table.file,
                Box::new(|| map::map(&tables(&blocks, &table.file))),
            ),
            _ => continue,
        };
        let file = format!("{name}.svg");
        if is_plain(name) && files.iter().all(|(taken, _)| *taken != file) {
            files.push((file, draw()));
        }
    }
    files
}

fn is_plain(name: &str) -> bool {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    !name.is_empty() && name.chars().all(is_plain)
}

/// All tables of a file.
fn tables<'d>(blocks: &[&'d Block], file: &str) -> Vec<&'d Table> {
    let tables = blocks.iter().filter_map(|block| match block {
        Block::Table(table) if table.file == file => Some(table),
        _ => None,
    });
    tables.collect()
}

//! The tables of a document as CSV.

use super::ReportError;
use crate::document::{Block, Document, Medium, Table};
use std::io;

/// The tables of a document, each with the stem of its file: those for CSV if the document has such, otherwise all.
///
/// Every table has a line of names, then its rows, as RFC 4180 has it but with line feeds. A table without a name of its own is
/// called after the document and its place.
///
/// # Errors
/// [`ReportError::Csv`], which no document is known to cause.
pub fn csv(document: &Document) -> Result<Vec<(String, String)>, ReportError> {
    let tables = tables(document, Medium::Csv).into_iter().enumerate();
    let named = tables.map(|(index, table)| {
        let stem = match (table.file.is_empty(), index) {
            (false, _) => table.file.clone(),
            (true, 0) => document.kind.clone(),
            (true, place) => format!("{}-{}", document.kind, place + 1),
        };
        Ok((stem, of_table(table)?))
    });
    named.collect()
}

/// The tables for a medium, if there are such, otherwise those that everybody sees.
pub(super) fn tables(document: &Document, medium: Medium) -> Vec<&Table> {
    let own = document
        .blocks()
        .filter(|block| matches!(block, Block::For(m, _) if *m == medium));
    let own: Vec<&Table> = own
        .filter_map(|block| table(block.shown_in(&[medium])?))
        .collect();
    if !own.is_empty() {
        return own;
    }
    let all = document.blocks();
    all.filter_map(|block| table(block.shown_in(&[Medium::Written])?))
        .collect()
}

fn table(block: &Block) -> Option<&Table> {
    match block {
        Block::Table(table) => Some(table),
        _ => None,
    }
}

fn of_table(table: &Table) -> Result<String, ReportError> {
    let mut writer = csv::WriterBuilder::new()
        .flexible(true)
        .from_writer(Vec::new());
    let broken = |error: csv::Error| ReportError::Csv(error.into());
    writer
        .write_record(table.columns.iter().map(|c| &c.title))
        .map_err(broken)?;
    for row in &table.rows {
        let cells = (0..table.columns.len()).map(|i| row.get(i).map_or("", |cell| &cell.text));
        writer.write_record(cells).map_err(broken)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| ReportError::Csv(error.into_error()))?;
    String::from_utf8(bytes).map_err(|error| ReportError::Csv(io::Error::other(error)))
}

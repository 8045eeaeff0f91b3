//! A document inside its own page, and out of it again.

use crate::document::{Block, Document, Medium};
use crate::render::ReportError;
use serde::{Deserialize, Serialize};

/// The version of the pages that this version writes and reads.
pub const SCHEMA: u32 = 2;

const OPENING: &str = "<script type=\"application/json\" id=\"volver-page\">";
const CLOSING: &str = "</script>";

/// Why a document gives no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// Another program made it.
    #[error("not a page of volver (allowed: pages that 'volver … --out DIR' writes)")]
    Foreign,
    /// It was changed or cut off.
    #[error("a damaged page: {0} (allowed: pages as 'volver … --out DIR' writes them)")]
    Damaged(#[from] serde_json::Error),
    /// Another version made it.
    #[error("a page of schema {found} (allowed: {SCHEMA})")]
    Schema {
        /// The version in the document.
        found: u64,
    },
}

#[derive(Serialize)]
struct Written<'a> {
    schema: u32,
    page: &'a Document,
}

#[derive(Deserialize)]
struct Envelope {
    schema: u64,
    page: serde_json::Value,
}

/// The element that holds the page, which a browser does not show.
pub(super) fn element(page: &Document) -> Result<String, ReportError> {
    let schema = SCHEMA;
    let page = &shown(page);
    let json = serde_json::to_string(&Written { schema, page })?;
    // In JSON `<` occurs in strings alone, where it may be escaped: no text can end the element.
    Ok(format!(
        "{OPENING}{}{CLOSING}",
        json.replace('<', "\\u003c")
    ))
}

/// What the page shows: tables for programs and papers have files of their own, and are not compared.
fn shown(page: &Document) -> Document {
    let mut page = page.clone();
    for section in &mut page.sections {
        let blocks = section.blocks.iter();
        let blocks = blocks.filter_map(|block| block.shown_in(&[Medium::Written, Medium::Page]));
        section.blocks = blocks.cloned().collect::<Vec<Block>>();
    }
    page
}

/// The page that a document was made of.
///
/// # Errors
/// [`PageError`] where it is no page, damaged, or of an unknown schema.
pub fn read(html: &str) -> Result<Document, PageError> {
    let (_, rest) = html.split_once(OPENING).ok_or(PageError::Foreign)?;
    let json = rest.split_once(CLOSING).map_or(rest, |(json, _)| json);
    let envelope: Envelope = serde_json::from_str(json)?;
    if envelope.schema != u64::from(SCHEMA) {
        return Err(PageError::Schema {
            found: envelope.schema,
        });
    }
    Ok(serde_json::from_value(envelope.page)?)
}

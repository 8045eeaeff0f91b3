//! What was measured, as documents, and what the back ends make of them.

#![allow(clippy::unwrap_used, clippy::panic, clippy::float_cmp)] // A test may stop, and may know a number exactly.

mod cases;
mod comparison;
mod csv;
mod entries;
mod files;
mod fixture;
mod html;
mod latex;
mod markdown;
mod nonsmooth;
mod plan;
mod plots;
mod reproduce;
mod stress;
mod study;
mod svg;
mod terminal;
mod tradeoff;
mod verify;

use volver::document::{About, Block, Document, Section};

/// What a test runs.
fn about() -> About {
    About::new(["volver"])
}

/// A document of one section.
fn document(blocks: impl IntoIterator<Item = Block>) -> Document {
    let mut document = Document::new("trial", "A trial", about());
    document.sections = vec![Section::of("s", "S", blocks)];
    document
}

/// Text without its colours, of which there must be some.
fn without_color(text: &str) -> String {
    assert!(text.contains('\u{1b}'), "{text}");
    [0, 1, 2, 31, 32, 33]
        .iter()
        .fold(text.into(), |text: String, code| {
            text.replace(&format!("\u{1b}[{code}m"), "")
        })
}

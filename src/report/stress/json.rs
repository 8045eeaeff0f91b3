//! Everything, for programs.

use crate::report::ReportError;
use crate::study::stress::{Cell, ORACLE_BITS};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    oracle_bits: u32,
    silently_wrong: usize,
    cells: &'a [Cell],
}

/// `{"volver": version, "oracle_bits": …, "silently_wrong": …, "cells": […]}`, indented, with a newline at the
/// end. Digits are `"exact"`, `{"of": 6.9}` or null.
///
/// # Errors
/// [`ReportError::Json`], which no cell is known to cause.
pub fn json(cells: &[Cell]) -> Result<String, ReportError> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        oracle_bits: ORACLE_BITS,
        silently_wrong: cells.iter().filter(|cell| cell.is_silently_wrong()).count(),
        cells,
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

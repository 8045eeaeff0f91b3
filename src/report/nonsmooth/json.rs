//! Everything, for programs.

use crate::render::ReportError;
use crate::study::nonsmooth::{BITS, Cell, LADDER, Place, STARTS, numbers};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    settings: Settings,
    cells: &'a [Cell],
}

#[derive(Serialize)]
struct Settings {
    format: String,
    starts: [u64; STARTS.len()],
    numbers: BTreeMap<&'static str, Vec<Vec<u64>>>,
    ladder: [u64; LADDER.len()],
}

/// `{"volver": version, "settings": {…}, "cells": […]}`, indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no cell is known to cause.
pub fn json(cells: &[Cell]) -> Result<String, ReportError> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        settings: Settings {
            format: format!("mpfr:{BITS}"),
            starts: STARTS,
            numbers: Place::ALL.map(|place| (place.name(), levels(place))).into(),
            ladder: LADDER,
        },
        cells,
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

/// The numbers of segments, level by level.
fn levels(place: Place) -> Vec<Vec<u64>> {
    STARTS.iter().map(|&start| numbers(place, start)).collect()
}

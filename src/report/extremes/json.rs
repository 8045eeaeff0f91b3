//! Everything, for programs.

use crate::report::ReportError;
use crate::study::extremes::{Answer, Cell, Extremes};
use crate::study::stress::Digits;
use rug::Float;
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    kernel: &'a str,
    method: Option<String>,
    format: String,
    exact_in_even_media: bool,
    wrong: usize,
    cells: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    scenario: &'a str,
    quantity: &'static str,
    n: u64,
    value: Option<f64>,
    truth: Option<f64>,
    digits: Option<Digits>,
    against_truth: Option<Digits>,
    promised: Option<f64>,
    answer: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    wrong: bool,
}

/// `{"volver": version, "kernel": …, "wrong": …, "cells": […]}`, indented, with a newline at the end. Digits are
/// `"exact"`, `{"of": 6.9}` or null; so are values that are no numbers.
///
/// # Errors
/// [`ReportError::Json`], which no cell is known to cause.
pub fn json(extremes: &Extremes) -> Result<String, ReportError> {
    let declaration = &extremes.declaration;
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        kernel: &declaration.name,
        method: declaration.method.map(|method| method.name()),
        format: declaration.format.to_string(),
        exact_in_even_media: extremes.is_exact,
        wrong: extremes.faults().count(),
        cells: extremes.cells.iter().map(row).collect(),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn row(cell: &Cell) -> Row<'_> {
    let number = |value: &Option<Float>| {
        let value = value.as_ref().map(Float::to_f64);
        value.filter(|value| value.is_finite())
    };
    Row {
        scenario: &cell.scenario,
        quantity: cell.quantity.name(),
        n: cell.n,
        value: number(&cell.value),
        truth: number(&cell.truth),
        digits: cell.digits,
        against_truth: cell.against_truth,
        promised: cell.promised,
        answer: cell.answer.map(Answer::name),
        reason: cell.reason.as_deref(),
        wrong: cell.is_fault,
    }
}

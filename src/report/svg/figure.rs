//! Panels side by side under a title, with one key for all.

use super::area::Area;
use super::canvas::{self, Canvas};
use super::curve::{Curve, Panel};
use super::key::{self, Entry};
use super::panel;
use super::style::{WHITE, letters};
use crate::report::ReportError;
use plotters::style::text_anchor::HPos;

const WIDTH: f64 = 900.0;
const PANEL_HEIGHT: f64 = 300.0;
const LONE_WIDTH: f64 = 640.0;
const LONE_HEIGHT: f64 = 420.0;
const TITLE_HEIGHT: f64 = 38.0;
const MARGIN: f64 = 14.0;

/// Draws the panels that have something to show; a line of text names the others.
pub(super) fn figure(title: &str, panels: &[Panel]) -> Result<String, ReportError> {
    let (empty, full): (Vec<&Panel>, Vec<&Panel>) = panels.iter().partition(|p| p.is_empty());
    let columns = if full.len() > 1 { 2 } else { 1 };
    let (width, panel_height) = if columns == 1 {
        (LONE_WIDTH, LONE_HEIGHT)
    } else {
        (WIDTH, PANEL_HEIGHT)
    };
    let rows = full.len().div_ceil(columns);
    let key = key_of(&full);
    let inner = width - 2.0 * MARGIN;
    let end = TITLE_HEIGHT + rows as f64 * panel_height;
    // An odd number of panels leaves room for the key, one entry a line.
    let (key_at, key_width, notes_top) = if full.len() % columns == 1 {
        let beside = (width / 2.0 + 66.0, end - panel_height + 40.0);
        (beside, 0.0, end)
    } else {
        let below = end + key::lines(&key, inner) as f64 * key::LINE_HEIGHT;
        ((MARGIN, end), inner, below)
    };
    let notes: Vec<String> = empty.iter().map(|panel| nothing_to_draw(panel)).collect();
    let height = (notes_top + notes.len() as f64 * key::LINE_HEIGHT + MARGIN).ceil();
    let cell_width = width / columns as f64;
    let legend_lines: Vec<usize> = full
        .chunks(columns)
        .map(|row| {
            let lines = row.iter().map(|p| panel::legend_lines(p, cell_width));
            lines.max().unwrap_or(0)
        })
        .collect();
    canvas::draw(title, (width, height), |canvas| {
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        canvas.polygon(&corners, WHITE);
        write(canvas, title, TITLE_HEIGHT / 2.0, 15.0, true);
        for (index, panel) in full.iter().enumerate() {
            let left = (index % columns) as f64 * cell_width;
            let top = TITLE_HEIGHT + (index / columns) as f64 * panel_height;
            let cell = Area {
                left,
                top,
                right: left + cell_width,
                bottom: top + panel_height,
            };
            panel::draw(canvas, panel, &cell, legend_lines[index / columns]);
        }
        key::draw(canvas, &key, key_at, key_width);
        for (line, note) in notes.iter().enumerate() {
            let y = notes_top + (line as f64 + 0.5) * key::LINE_HEIGHT;
            write(canvas, note, y, 11.0, false);
        }
    })
}

fn write(canvas: &mut Canvas<'_>, text: &str, y: f64, size: f64, bold: bool) {
    canvas.text(text, (MARGIN, y), letters(size, bold, HPos::Left));
}

/// "inner: simpson: nothing to draw (boole exact)".
fn nothing_to_draw(panel: &Panel) -> String {
    let legends: Vec<&str> = panel.curves.iter().map(|c| c.legend.as_str()).collect();
    let colon = if panel.title.is_empty() { "" } else { ": " };
    format!(
        "{}{colon}no finite, nonzero error to draw ({})",
        panel.title,
        legends.join(", ")
    )
}

/// Only what the panels show.
fn key_of(panels: &[&Panel]) -> Vec<Entry> {
    let curves = || panels.iter().flat_map(|p| &p.curves);
    let marks = || curves().flat_map(Curve::marks);
    let floor = panels.iter().any(|p| panel::shows_floor(p));
    [
        (Entry::Fitted, marks().any(|m| m.fitted)),
        (Entry::NotFitted, marks().any(|m| !m.fitted)),
        (Entry::Negative, marks().any(|m| m.negative)),
        (Entry::Bias, curves().any(|c| !c.bias.is_empty())),
        (Entry::Floor, floor),
        (Entry::Model, panels.iter().any(|p| !p.models.is_empty())),
    ]
    .into_iter()
    .filter_map(|(entry, shown)| shown.then_some(entry))
    .collect()
}

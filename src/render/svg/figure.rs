//! Plots side by side under a caption.

use super::flow::{Entry, flow};
use super::sheet::{BODY, CAPTION, HEAD, MARGIN, Sheet, at, written};
use crate::document::{Figure, Plot};
use crate::render::plot::{HEIGHT, Reader, Scales, WIDTH, drawing, key, legend, names};
use maud::html;

/// A plot that stands alone is drawn so many times as large.
const ALONE: f64 = 1.25;

/// A figure as a file: its plots as panels, two beside each other where there are several, with one key for all.
///
/// Plots that have nothing to draw are named below.
#[must_use]
pub fn figure(figure: &Figure) -> String {
    let drawn: Vec<(&Plot, Scales)> = figure
        .plots
        .iter()
        .filter_map(|plot| Some((plot, Scales::new(plot)?)))
        .collect();
    let (columns, scale) = if drawn.len() > 1 {
        (2, 1.0)
    } else {
        (1, ALONE)
    };
    let mut sheet = Sheet::new(MARGIN + columns as f64 * (WIDTH + MARGIN));
    sheet.write(&figure.caption, CAPTION);
    let mut last_row = sheet.y;
    for row in drawn.chunks(columns) {
        last_row = sheet.y;
        panels(&mut sheet, row, figure);
    }
    let scaled: Vec<(&Plot, &Scales)> =
        drawn.iter().map(|(plot, scales)| (*plot, scales)).collect();
    let entries: Vec<Entry> = key(&scaled)
        .into_iter()
        .map(|(sample, name)| Entry {
            class: "key".into(),
            sample,
            name,
        })
        .collect();
    if drawn.len() % columns == 1 {
        // Where a panel is missing there is room for a line each.
        let beside = (left(1) + WIDTH / 6.0, last_row + HEIGHT / 4.0);
        sheet.put(flow(&entries, beside, 0.0).0);
    } else {
        let width = columns as f64 * (WIDTH + MARGIN) - MARGIN;
        let (drawn, height) = flow(&entries, (MARGIN, sheet.y), width);
        sheet.put(drawn);
        sheet.y += height;
    }
    for plot in figure
        .plots
        .iter()
        .filter(|plot| Scales::new(plot).is_none())
    {
        sheet.write(&nothing(plot), BODY);
    }
    if figure.plots.is_empty() {
        sheet.write("nothing to draw", BODY);
    }
    sheet.file(&figure.caption, scale)
}

/// Where a column begins.
fn left(column: usize) -> f64 {
    MARGIN + column as f64 * (WIDTH + MARGIN)
}

/// Panels beside each other, their axes at the same height.
fn panels(sheet: &mut Sheet, row: &[(&Plot, Scales)], figure: &Figure) {
    let mut heads = Vec::new();
    let mut height: f64 = 0.0;
    for (column, (plot, _)) in row.iter().enumerate() {
        // What the caption says needs no second line.
        let title = if plot.title == figure.caption {
            ""
        } else {
            &plot.title
        };
        let lines = HEAD.lines(title, WIDTH);
        let below = sheet.y + 6.0 + lines.len() as f64 * HEAD.line_height();
        let entries: Vec<Entry> = legend(plot)
            .map(|entry| Entry {
                class: entry.class,
                sample: entry.sample,
                name: entry.name.into(),
            })
            .collect();
        let (legend, own) = flow(&entries, (left(column), below), WIDTH);
        heads.push(html! { (written(&lines, (left(column), sheet.y + 4.0), HEAD)) (legend) });
        height = height.max(below - sheet.y + own);
    }
    sheet.y += height;
    for (column, ((plot, scales), head)) in row.iter().zip(heads).enumerate() {
        sheet.put(head);
        sheet.put(at(
            (left(column), sheet.y),
            &drawing(plot, scales, Reader::Viewer),
        ));
    }
    sheet.y += HEIGHT + 6.0;
}

/// "inner: gauss-3: nothing to draw (boole Exact)".
fn nothing(plot: &Plot) -> String {
    let colon = if plot.title.is_empty() { "" } else { ": " };
    let which = match names(plot) {
        names if names.is_empty() => names,
        names => format!(" ({names})"),
    };
    format!("{}{colon}nothing to draw{which}", plot.title)
}

//! Plots side by side under a caption.

use super::flow::flow;
use super::sheet::{BODY, CAPTION, HEAD, MARGIN, Sheet, at, written};
use crate::document::{Figure, Plot};
use crate::render::plot::{Entry, HEIGHT, Reader, Scales, WIDTH, drawing, key, legend, names};
use maud::html;

/// A plot that stands alone is drawn so many times as large.
const ALONE: f64 = 1.25;

/// A plot that stands alone has its legend beside it from so many names on.
const LONG: usize = 9;

/// A figure as a file: its plots as panels, two beside each other where there are several, with one key for all.
///
/// Plots that have nothing to draw are named below.
#[must_use]
pub fn figure(figure: &Figure) -> String {
    let scaled = figure.plots.iter().map(|plot| (plot, Scales::new(plot)));
    let (drawn, empty): (Vec<_>, Vec<_>) = scaled.partition(|(_, scales)| scales.is_some());
    let drawn: Vec<Panel<'_>> = drawn
        .into_iter()
        .filter_map(|(plot, scales)| Some((plot, scales?)))
        .collect();
    let aside = match &drawn[..] {
        [(plot, _)] => Some(legend(plot)).filter(|names| names.len() >= LONG),
        _ => None,
    };
    let columns = if drawn.len() > 1 || aside.is_some() {
        2
    } else {
        1
    };
    let mut sheet = Sheet::new(left(columns));
    sheet.write(&figure.caption, CAPTION);
    let mut last_row = sheet.y;
    for row in drawn.chunks(columns) {
        last_row = sheet.y;
        panels(&mut sheet, row, &figure.caption, aside.is_none());
    }
    // Where a panel is missing there is room, a line for each.
    let (at, width) = if drawn.len() % columns == 1 {
        ((left(1), last_row + 6.0), 0.0)
    } else {
        ((MARGIN, sheet.y), left(columns) - 2.0 * MARGIN)
    };
    let entries: Vec<Entry> = aside.into_iter().flatten().chain(key(&drawn)).collect();
    let (key, height) = flow(&entries, at, width);
    sheet.put(key);
    sheet.y = sheet.y.max(at.1 + height);
    for (plot, _) in &empty {
        sheet.write(&nothing(plot), BODY);
    }
    if figure.plots.is_empty() {
        sheet.write("nothing to draw", BODY);
    }
    sheet.file(&figure.caption, if columns == 1 { ALONE } else { 1.0 })
}

/// A plot that there is something to draw of.
type Panel<'p> = (&'p Plot, Scales);

/// Where a column begins.
fn left(column: usize) -> f64 {
    MARGIN + column as f64 * (WIDTH + MARGIN)
}

/// Panels beside each other, their axes at the same height.
fn panels(sheet: &mut Sheet, row: &[Panel<'_>], caption: &str, has_legends: bool) {
    let mut heads = Vec::new();
    let mut height: f64 = 0.0;
    for (column, (plot, _)) in row.iter().enumerate() {
        // What the caption says needs no second line.
        let title = if plot.title == caption {
            ""
        } else {
            &plot.title
        };
        let lines = HEAD.lines(title, WIDTH);
        let below = sheet.y + 6.0 + lines.len() as f64 * HEAD.line_height();
        let names = if has_legends {
            legend(plot)
        } else {
            Vec::new()
        };
        let (legend, own) = flow(&names, (left(column), below), WIDTH);
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

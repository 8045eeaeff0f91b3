//! One pair of axes with its curves.

use super::area::Area;
use super::axes::{self, Axes};
use super::canvas::{Canvas, Stroke};
use super::curve::{Curve, Panel};
use super::key::{self, Entry};
use super::style::{BIAS_DASHES, FLOOR, FLOOR_DOTS, MODEL, color, letters};
use super::{guide, mark, slopes};
use plotters::style::text_anchor::HPos;

/// Room round the axes for ticks and labels.
const LEFT: f64 = 66.0;
/// Title and legend start left of the axes: they need the width.
const TITLE_LEFT: f64 = 14.0;
const RIGHT: f64 = 14.0;
const BOTTOM: f64 = 42.0;
const TITLE_HEIGHT: f64 = 20.0;

/// How many lines the legend takes in a panel so wide.
pub(super) fn legend_lines(panel: &Panel, width: f64) -> usize {
    key::lines(&legend(panel), width - TITLE_LEFT - RIGHT)
}

/// Draws a panel into `cell`, with `lines` lines for the legend.
pub(super) fn draw(canvas: &mut Canvas<'_>, panel: &Panel, cell: &Area, lines: usize) {
    let mut top = cell.top;
    if !panel.title.is_empty() {
        let at = (cell.left + TITLE_LEFT, top + TITLE_HEIGHT / 2.0);
        canvas.text(&panel.title, at, letters(12.5, true, HPos::Left));
        top += TITLE_HEIGHT;
    }
    key::draw(
        canvas,
        &legend(panel),
        (cell.left + TITLE_LEFT, top),
        cell.right - cell.left - TITLE_LEFT - RIGHT,
    );
    let plot = Area {
        left: cell.left + LEFT,
        right: cell.right - RIGHT,
        top: top + lines as f64 * key::LINE_HEIGHT + 4.0,
        bottom: cell.bottom - BOTTOM,
    };
    let Some(axes) = axes::axes(panel, plot) else {
        return;
    };
    axes::draw(canvas, panel, &axes);
    for curve in &panel.curves {
        let floor = axes.path(&curve.floor);
        for (from, to) in axes.inside(&floor) {
            canvas.dashes(&[from, to], FLOOR, FLOOR_DOTS);
        }
    }
    for model in &panel.models {
        let stroke = Stroke {
            color: color(model.color),
            ..MODEL
        };
        for (from, to) in axes.inside(&axes.path(&model.path)) {
            canvas.path(&[from, to], stroke);
        }
    }
    for (index, curve) in panel.curves.iter().enumerate() {
        draw_curve(canvas, curve, index, &axes);
    }
    let words = panel
        .guide
        .as_ref()
        .map(|guide| (guide, guide::place(guide, panel, &axes)));
    let taken = words
        .as_ref()
        .map_or(Vec::new(), |(_, words)| words.points());
    slopes::draw(canvas, panel, &axes, taken);
    if let Some((guide, words)) = &words {
        guide::draw(canvas, guide, words, &axes);
    }
}

/// Whether some of a roundoff floor lies within the axes.
pub(super) fn shows_floor(panel: &Panel) -> bool {
    let unit = Area {
        left: 0.0,
        top: 0.0,
        right: 1.0,
        bottom: 1.0,
    };
    axes::axes(panel, unit).is_some_and(|axes| {
        let visible = |c: &Curve| !axes.inside(&axes.path(&c.floor)).is_empty();
        panel.curves.iter().any(visible)
    })
}

fn legend(panel: &Panel) -> Vec<Entry> {
    let entry = |(index, curve): (usize, &Curve)| Entry::Curve {
        color: color(curve.color),
        index,
        text: curve.legend.clone(),
    };
    panel.curves.iter().enumerate().map(entry).collect()
}

fn draw_curve(canvas: &mut Canvas<'_>, curve: &Curve, index: usize, axes: &Axes) {
    let stroke = Stroke {
        color: color(curve.color),
        width: mark::line_width(index),
    };
    let thin = Stroke {
        width: 1.2,
        ..stroke
    };
    let bias = axes.path(&curve.bias);
    for (from, to) in axes.inside(&bias) {
        canvas.dashes(&[from, to], thin, BIAS_DASHES);
    }
    for path in axes.unbroken(curve) {
        canvas.path(&path, stroke);
    }
    for mark in curve.marks() {
        mark::draw(
            canvas,
            axes.at((mark.x, mark.y)),
            &mark,
            index,
            stroke.color,
        );
    }
}

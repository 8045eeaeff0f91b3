//! A vertical line at an n of interest, with words beside it.

use super::area::Area;
use super::axes::Axes;
use super::canvas::{Canvas, Point, Stroke, text_width};
use super::curve::{Guide, Panel};
use super::place::points_along;
use super::style::{GUIDE_DASHES, MUTED, letters};
use plotters::style::text_anchor::HPos;

const SIZE: f64 = 10.5;
const LINE_HEIGHT: f64 = 14.0;
/// Between the words and what stands beside them.
const GAP: f64 = 5.0;

/// Where the words stand.
pub(super) struct Words {
    area: Area,
    anchor: HPos,
}

/// The place beside the line, or in a corner without one, where words cover the least of the curves.
pub(super) fn place(guide: &Guide, panel: &Panel, axes: &Axes) -> Words {
    let plot = axes.plot;
    let widths = guide.lines.iter().map(|line| text_width(line, SIZE));
    let width = widths.fold(0.0, f64::max);
    let height = LINE_HEIGHT * guide.lines.len() as f64;
    let sides = match guide.x.map(|x| axes.at((x, 0.0)).0) {
        Some(x) => [(x + GAP, HPos::Left), (x - GAP - width, HPos::Right)],
        None => [
            (plot.right - GAP - width, HPos::Right),
            (plot.left + GAP, HPos::Left),
        ],
    };
    let tops = [plot.top + 1.0, plot.bottom - height - 1.0];
    let curves: Vec<Point> = panel
        .curves
        .iter()
        .flat_map(|curve| axes.unbroken(curve))
        .chain(panel.models.iter().map(|model| axes.path(&model.path)))
        .flat_map(|path| points_along(&path))
        .collect();
    let covered = |area: &Area| {
        let outside = if area.lies_in(&plot) { 0 } else { 1000 };
        outside
            + curves
                .iter()
                .filter(|point| area.contains(**point, 3.0))
                .count()
    };
    let words = tops.into_iter().flat_map(|top| {
        sides.map(|(left, anchor)| {
            let (right, bottom) = (left + width, top + height);
            let area = Area {
                left,
                top,
                right,
                bottom,
            };
            (covered(&area), Words { area, anchor })
        })
    });
    // There are four; the first of the best.
    let best = words.reduce(|a, b| if b.0 < a.0 { b } else { a });
    best.map_or(
        Words {
            area: plot,
            anchor: HPos::Left,
        },
        |(_, words)| words,
    )
}

impl Words {
    /// What nothing else may cover, as points some pixels apart.
    pub(super) fn points(&self) -> Vec<Point> {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.area;
        let rows = (0_u32..)
            .map(|i| top + 3.0 * f64::from(i))
            .take_while(|y| *y <= bottom);
        rows.flat_map(|y| points_along(&[(left, y), (right, y)]))
            .collect()
    }
}

pub(super) fn draw(canvas: &mut Canvas<'_>, guide: &Guide, words: &Words, axes: &Axes) {
    let plot = axes.plot;
    if let Some(x) = guide.x {
        let at = axes.at((x, 0.0)).0;
        let stroke = Stroke {
            color: MUTED,
            width: 1.0,
        };
        canvas.dashes(&[(at, plot.top), (at, plot.bottom)], stroke, GUIDE_DASHES);
    }
    let x = match words.anchor {
        HPos::Right => words.area.right,
        _ => words.area.left,
    };
    for (index, line) in guide.lines.iter().enumerate() {
        let y = words.area.top + (index as f64 + 0.5) * LINE_HEIGHT;
        canvas.text(line, (x, y), letters(SIZE, false, words.anchor));
    }
}

//! A vertical line at an n of interest, with words beside it.

use super::axes::Axes;
use super::canvas::{Canvas, Stroke, text_width};
use super::curve::Guide;
use super::style::{GUIDE_DASHES, MUTED, letters};
use plotters::style::text_anchor::HPos;

const SIZE: f64 = 10.5;
const LINE_HEIGHT: f64 = 14.0;
/// Between the line and its words.
const GAP: f64 = 5.0;

/// Words stand at the top, to the right where there is room: errors of converging methods are smaller there.
pub(super) fn draw(canvas: &mut Canvas<'_>, guide: &Guide, axes: &Axes) {
    let plot = axes.plot;
    let widest = guide.lines.iter().map(|line| text_width(line, SIZE));
    let width = widest.fold(0.0, f64::max);
    let (x, anchor) = match guide.x {
        Some(x) => {
            let at = axes.at((x, 0.0)).0;
            let stroke = Stroke {
                color: MUTED,
                width: 1.0,
            };
            canvas.dashes(&[(at, plot.top), (at, plot.bottom)], stroke, GUIDE_DASHES);
            if at + GAP + width <= plot.right {
                (at + GAP, HPos::Left)
            } else {
                (at - GAP, HPos::Right)
            }
        }
        None => (plot.right - GAP, HPos::Right),
    };
    for (index, line) in guide.lines.iter().enumerate() {
        let y = plot.top + (index as f64 + 0.6) * LINE_HEIGHT;
        canvas.text(line, (x, y), letters(SIZE, false, anchor));
    }
}

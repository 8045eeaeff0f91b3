//! What a plot looks like, as elements of SVG: pages and files of their own show the same.
//!
//! The look stands in `plot.css`, in which the colours of the light theme have their names.

mod axes;
mod curve;
mod key;
mod mark;
mod scale;
mod ticks;

pub(super) use axes::{HEIGHT, Scales, WIDTH};
pub(super) use curve::{Reader, drawing};
pub(super) use key::{Entry, SAMPLE, key, legend, names};
pub(super) use scale::Scale;
pub(super) use ticks::ticks;

pub(super) const STYLE: &str = include_str!("plot.css");

/// From this share on the text on a shade changes its colour: with the style sheet's, black and white have a contrast of
/// 4.5 there in both themes.
const FLIP: f64 = 0.69;

/// Whether a shade of a map takes light letters on white paper.
pub(super) fn is_dark(share: f64) -> bool {
    share > FLIP
}

//! Legends: samples of lines and marks with their text, in lines that wrap.

use super::canvas::{Canvas, Point, Stroke, text_width};
use super::curve::Mark;
use super::mark;
use super::style::{BIAS_DASHES, FLOOR, FLOOR_DOTS, MODEL, MUTED, letters};
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::HPos;

pub(super) const LINE_HEIGHT: f64 = 16.0;
const SIZE: f64 = 10.5;
const SAMPLE: f64 = 16.0;
const GAP: f64 = 10.0;

/// One thing that a legend explains.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Entry {
    /// A curve by its place in the panel.
    Curve {
        color: RGBColor,
        index: usize,
        text: String,
    },
    Fitted,
    NotFitted,
    Negative,
    Bias,
    Floor,
    Model,
}

impl Entry {
    fn text(&self) -> &str {
        match self {
            Entry::Curve { text, .. } => text,
            Entry::Fitted => "level in the fit",
            Entry::NotFitted => "other level",
            Entry::Negative => "error below 0",
            Entry::Bias => "|bias|",
            Entry::Floor => "roundoff floor",
            Entry::Model => "fitted model",
        }
    }

    fn width(&self) -> f64 {
        SAMPLE + 5.0 + text_width(self.text(), SIZE)
    }

    fn draw_sample(&self, canvas: &mut Canvas<'_>, (x, y): Point) {
        let ends = [(x, y), (x + SAMPLE, y)];
        let middle = (x + SAMPLE / 2.0, y);
        let sign = |negative, fitted| Mark {
            x: 0.0,
            y: 0.0,
            negative,
            fitted,
        };
        match self {
            Entry::Curve { color, index, .. } => {
                let (color, width) = (*color, mark::line_width(*index));
                canvas.path(&ends, Stroke { color, width });
                mark::draw(canvas, middle, &sign(false, true), *index, color);
            }
            Entry::Fitted => mark::draw(canvas, middle, &sign(false, true), 0, MUTED),
            Entry::NotFitted => mark::draw(canvas, middle, &sign(false, false), 0, MUTED),
            Entry::Negative => mark::draw(canvas, middle, &sign(true, true), 0, MUTED),
            Entry::Bias => {
                let (color, width) = (MUTED, 1.2);
                canvas.dashes(&ends, Stroke { color, width }, BIAS_DASHES);
            }
            Entry::Floor => canvas.dashes(&ends, FLOOR, FLOOR_DOTS),
            Entry::Model => canvas.path(&ends, MODEL),
        }
    }
}

/// Where each entry starts: (line, distance from the left).
fn places(entries: &[Entry], width: f64) -> Vec<(usize, f64)> {
    let greedy = wrapped(entries, width, entries.len());
    let lines = greedy.last().map_or(1, |(line, _)| line + 1);
    // As many on every line, if that takes no more lines: 2 + 2 reads better than 3 + 1.
    let even = wrapped(entries, width, entries.len().div_ceil(lines));
    if even.last().is_some_and(|(line, _)| *line < lines) {
        even
    } else {
        greedy
    }
}

/// Lines with at most `most` entries each.
fn wrapped(entries: &[Entry], width: f64, most: usize) -> Vec<(usize, f64)> {
    let (mut line, mut on_line, mut x) = (0, 0, 0.0);
    let mut places = Vec::new();
    for entry in entries {
        if on_line > 0 && (on_line == most || x + entry.width() > width) {
            line += 1;
            on_line = 0;
            x = 0.0;
        }
        places.push((line, x));
        on_line += 1;
        x += entry.width() + GAP;
    }
    places
}

/// How many lines the entries take.
pub(super) fn lines(entries: &[Entry], width: f64) -> usize {
    places(entries, width)
        .last()
        .map_or(0, |(line, _)| line + 1)
}

/// Draws the entries below and to the right of `at`.
pub(super) fn draw(canvas: &mut Canvas<'_>, entries: &[Entry], at: Point, width: f64) {
    for (entry, (line, x)) in entries.iter().zip(places(entries, width)) {
        let x = at.0 + x;
        let y = at.1 + (line as f64 + 0.5) * LINE_HEIGHT;
        entry.draw_sample(canvas, (x, y));
        canvas.text(
            entry.text(),
            (x + SAMPLE + 5.0, y),
            letters(SIZE, false, HPos::Left),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_wrap() {
        let entries = [Entry::Fitted, Entry::NotFitted, Entry::Floor];
        let all = entries.iter().map(Entry::width).sum::<f64>() + 2.0 * GAP;
        assert_eq!(lines(&entries, all + 1.0), 1);
        assert_eq!(lines(&entries, all - 1.0), 2);
        assert_eq!(lines(&entries, 1.0), 3);
        let four = [Entry::Floor, Entry::Floor, Entry::Floor, Entry::Floor];
        let three = 3.0 * Entry::Floor.width() + 2.0 * GAP + 1.0;
        let on: Vec<usize> = places(&four, three).iter().map(|p| p.0).collect();
        assert_eq!(on, [0, 0, 1, 1]);
        assert_eq!(lines(&[], 100.0), 0);
        assert_eq!(places(&entries, 1.0)[2], (2, 0.0));
    }
}

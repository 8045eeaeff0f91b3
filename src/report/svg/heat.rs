//! A map of correct digits over n and bits.

mod color;

use super::area::Area;
use super::canvas::{self, Canvas, Letters, text_width};
use super::scale::{Scale, apart, whole_ticks};
use super::style::{AXIS, TEXT, TICK_SIZE, WHITE, letters};
use crate::report::ReportError;
use crate::study::sweep::Line;
use color::{MISSING, is_dark, of_share};
use plotters::style::text_anchor::HPos;

const TITLE_HEIGHT: f64 = 38.0;
const LEFT: f64 = 62.0;
const BOTTOM: f64 = 48.0;
/// Room for the bar of colours with its labels.
const RIGHT: f64 = 104.0;
const BAR_GAP: f64 = 22.0;
const BAR_WIDTH: f64 = 16.0;
const BAR_STEPS: u32 = 64;
/// Cells are as large as these allow.
const MAP_WIDTH: f64 = 640.0;
const MAP_HEIGHT: f64 = 560.0;
const CELL_WIDTHS: (f64, f64) = (12.0, 56.0);
const CELL_HEIGHTS: (f64, f64) = (12.0, 30.0);
const SEAM: f64 = 1.0;
const FIGURE_SIZE: f64 = 9.0;
/// Fewest pixels for the title.
const LEAST_WIDTH: f64 = 420.0;

/// The figure of lines that differ in bits, few to many.
pub(super) fn figure(title: &str, lines: &[&Line]) -> Result<String, ReportError> {
    let levels: Vec<u64> = lines.first().map_or(Vec::new(), |line| {
        line.row.levels.iter().map(|level| level.n).collect()
    });
    let size = |room: f64, count: usize, (least, most): (f64, f64)| {
        (room / count.max(1) as f64).clamp(least, most)
    };
    let map = Map {
        lines,
        levels: &levels,
        cell: (
            size(MAP_WIDTH, levels.len(), CELL_WIDTHS),
            size(MAP_HEIGHT, lines.len(), CELL_HEIGHTS),
        ),
        most: most_digits(lines),
    };
    let plot = Area {
        left: LEFT,
        top: TITLE_HEIGHT,
        right: LEFT + map.cell.0 * levels.len() as f64,
        bottom: TITLE_HEIGHT + map.cell.1 * lines.len() as f64,
    };
    let title_width = 14.0 + text_width(title, 15.0);
    let width = (plot.right + RIGHT)
        .max(LEAST_WIDTH)
        .max(title_width)
        .ceil();
    let height = (plot.bottom + BOTTOM).ceil();
    canvas::draw(title, (width, height), |canvas| {
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        canvas.polygon(&corners, WHITE);
        canvas.text(
            title,
            (14.0, TITLE_HEIGHT / 2.0),
            letters(15.0, true, HPos::Left),
        );
        map.cells(canvas, plot);
        map.axes(canvas, plot);
        map.bar(canvas, plot);
    })
}

/// The largest number of digits, and at least one.
fn most_digits(lines: &[&Line]) -> f64 {
    let digits = lines.iter().flat_map(|line| {
        line.row
            .levels
            .iter()
            .filter_map(|level| line.digits(level))
    });
    digits.fold(1.0, f64::max).ceil()
}

struct Map<'a> {
    lines: &'a [&'a Line],
    levels: &'a [u64],
    /// Width and height of a cell.
    cell: (f64, f64),
    most: f64,
}

impl Map<'_> {
    fn cells(&self, canvas: &mut Canvas<'_>, plot: Area) {
        let (width, height) = self.cell;
        for (row, line) in self.lines.iter().enumerate() {
            let bottom = plot.bottom - row as f64 * height;
            for (column, level) in line.row.levels.iter().enumerate() {
                let left = plot.left + column as f64 * width;
                let digits = line.digits(level);
                let color = digits.map_or(MISSING, |digits| of_share(digits / self.most));
                // A little too large: viewers leave seams between neighbours otherwise.
                let right = (left + width + SEAM).min(plot.right);
                let top = (bottom - height - SEAM).max(plot.top);
                canvas.polygon(
                    &[(left, bottom), (right, bottom), (right, top), (left, top)],
                    color,
                );
                let figure = digits.map_or("–".to_string(), |digits| format!("{digits:.1}"));
                if text_width(&figure, FIGURE_SIZE) + 2.0 <= width && FIGURE_SIZE + 2.0 <= height {
                    let at = (left + width / 2.0, bottom - height / 2.0);
                    let color = if is_dark(color) { WHITE } else { TEXT };
                    let letters = letters(FIGURE_SIZE, false, HPos::Center);
                    canvas.text(&figure, at, Letters { color, ..letters });
                }
            }
        }
    }

    fn axes(&self, canvas: &mut Canvas<'_>, plot: Area) {
        let names: Vec<String> = self.levels.iter().map(ToString::to_string).collect();
        let centers: Vec<(f64, f64)> = names
            .iter()
            .enumerate()
            .map(|(i, name)| {
                (
                    plot.left + (i as f64 + 0.5) * self.cell.0,
                    text_width(name, TICK_SIZE),
                )
            })
            .collect();
        for index in apart(&centers, 4.0) {
            let at = (centers[index].0, plot.bottom + 12.0);
            canvas.text(&names[index], at, letters(TICK_SIZE, false, HPos::Center));
        }
        let rows: Vec<(f64, f64)> = (0..self.lines.len())
            .map(|row| (plot.bottom - (row as f64 + 0.5) * self.cell.1, TICK_SIZE))
            .collect();
        for index in apart(&rows, 1.5) {
            let at = (plot.left - 6.0, rows[index].0);
            let bits = self.lines[index].bits.to_string();
            canvas.text(&bits, at, letters(TICK_SIZE, false, HPos::Right));
        }
        let below = (f64::midpoint(plot.left, plot.right), plot.bottom + 32.0);
        canvas.text("segments n", below, letters(11.5, false, HPos::Center));
        let beside = (plot.left - 42.0, f64::midpoint(plot.top, plot.bottom));
        let upwards = Letters {
            upwards: true,
            ..letters(11.5, false, HPos::Center)
        };
        canvas.text("significant bits", beside, upwards);
    }

    /// The bar of colours.
    fn bar(&self, canvas: &mut Canvas<'_>, plot: Area) {
        let (left, right) = (plot.right + BAR_GAP, plot.right + BAR_GAP + BAR_WIDTH);
        let scale = Scale::new((0.0, self.most), (plot.bottom, plot.top));
        let steps = f64::from(BAR_STEPS);
        for step in 0..BAR_STEPS {
            let share = (f64::from(step) + 0.5) / steps;
            let bottom = scale.pixel(self.most * f64::from(step) / steps);
            let top = scale.pixel(self.most * f64::from(step + 1) / steps) - SEAM;
            let top = top.max(plot.top);
            canvas.polygon(
                &[(left, bottom), (right, bottom), (right, top), (left, top)],
                of_share(share),
            );
        }
        let room = (plot.bottom - plot.top) / (TICK_SIZE + 4.0);
        let mut most = 2;
        while f64::from(most + 1) < room && most < 12 {
            most += 1;
        }
        for digits in whole_ticks((0.0, self.most), usize::try_from(most).unwrap_or(2)) {
            let y = scale.pixel(digits);
            canvas.path(&[(right, y), (right + 4.0, y)], AXIS);
            canvas.text(
                &format!("{digits:.0}"),
                (right + 7.0, y),
                letters(TICK_SIZE, false, HPos::Left),
            );
        }
        let beside = (right + 34.0, f64::midpoint(plot.top, plot.bottom));
        let upwards = Letters {
            upwards: true,
            ..letters(11.5, false, HPos::Center)
        };
        canvas.text("correct decimal digits", beside, upwards);
    }
}

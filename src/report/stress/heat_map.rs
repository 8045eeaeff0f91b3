//! Digits as colours, verdicts as hatched fields: scenarios against methods and formats.

use super::Grid;
use super::words::{occurring, summary};
use crate::report::ReportError;
use crate::report::svg::canvas::{Canvas, Letters, Point, Stroke, draw};
use crate::report::svg::style::{MUTED, TEXT, WHITE, letters};
use crate::study::stress::{Cell, Digits, Verdict};
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::HPos;

const FIELD: f64 = 15.0;
const GAP: f64 = 8.0;
const LEFT: f64 = 140.0;
const TOP: f64 = 132.0;
const LINE: f64 = 15.0;
/// Digits of the darkest colour.
pub(super) const MOST: f64 = 16.0;
const LIGHT: RGBColor = RGBColor(0xFD, 0xF0, 0xC8);
const MIDDLE: RGBColor = RGBColor(0x35, 0xA0, 0x8C);
const DARK: RGBColor = RGBColor(0x1B, 0x2A, 0x6B);
const PALE: RGBColor = RGBColor(0xEC, 0xEC, 0xEC);
const WRONG: RGBColor = RGBColor(0xD5, 0x00, 0x00);

/// The cells as an SVG. A verdict's field has its code's first letters in the key below.
///
/// # Errors
/// [`ReportError::Draw`], which no cell is known to cause.
pub fn heat_map(cells: &[Cell]) -> Result<String, ReportError> {
    let grid = Grid::new(cells);
    let group = grid.formats.len() as f64 * FIELD + GAP;
    let bottom = TOP + grid.scenarios.len() as f64 * FIELD + 14.0;
    let verdicts: Vec<Verdict> = occurring(cells).collect();
    let width = (LEFT + grid.methods.len() as f64 * group + 10.0).max(720.0);
    let height = bottom + 50.0 + verdicts.len() as f64 * LINE;
    draw(
        "Digits and verdicts at the extremes",
        (width, height),
        |canvas| {
            let frame = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
            canvas.polygon(&frame, WHITE);
            canvas.text(
                &summary(cells),
                (10.0, 14.0),
                letters(12.0, true, HPos::Left),
            );
            for (row, scenario) in grid.scenarios.iter().enumerate() {
                let y = TOP + row as f64 * FIELD;
                let at = (LEFT - 6.0, y + FIELD / 2.0);
                canvas.text(scenario, at, letters(9.5, false, HPos::Right));
            }
            for (place, method) in grid.methods.iter().enumerate() {
                let x = LEFT + place as f64 * group;
                method_name(canvas, method, (x, 34.0), group - GAP);
                for (column, format) in grid.formats.iter().enumerate() {
                    let x = x + column as f64 * FIELD;
                    let upwards = Letters {
                        upwards: true,
                        ..letters(9.0, false, HPos::Left)
                    };
                    canvas.text(format, (x + FIELD / 2.0, TOP - 5.0), upwards);
                    for (row, scenario) in grid.scenarios.iter().enumerate() {
                        if let Some(cell) = grid.cell(scenario, method, format) {
                            field(canvas, cell, (x, TOP + row as f64 * FIELD));
                        }
                    }
                }
            }
            key(canvas, bottom, &verdicts);
        },
    )
}

/// A long name on several lines, broken behind slashes.
fn method_name(canvas: &mut Canvas<'_>, name: &str, (x, mut y): Point, width: f64) {
    let fits = |line: &str| line.chars().count() as f64 * 4.9 <= width;
    let mut line = String::new();
    let mut lines = Vec::new();
    for part in name.split_inclusive('/') {
        if !line.is_empty() && !fits(&format!("{line}{part}")) {
            lines.push(std::mem::take(&mut line));
        }
        line.push_str(part);
    }
    lines.push(line);
    for line in lines {
        canvas.text(&line, (x, y), letters(9.0, true, HPos::Left));
        y += 11.0;
    }
}

fn square((x, y): Point, size: f64) -> [Point; 4] {
    [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
}

fn field(canvas: &mut Canvas<'_>, cell: &Cell, at: Point) {
    let inner = (at.0 + 0.5, at.1 + 0.5);
    let size = FIELD - 1.0;
    match (cell.verdict, cell.digits) {
        (Some(verdict), _) => verdict_field(canvas, verdict, inner, size),
        (None, digits) => {
            let digits = match digits {
                Some(Digits::Exact) => MOST,
                Some(Digits::Of(digits)) => digits,
                None => 0.0,
            };
            canvas.polygon(&square(inner, size), color(digits));
        }
    }
    if cell.is_silently_wrong() {
        let stroke = Stroke {
            color: WRONG,
            width: 2.0,
        };
        let [a, b, c, d] = square(inner, size);
        canvas.path(&[a, b, c, d, a], stroke);
    }
}

/// Hatched, with a letter; white where nothing was run.
fn verdict_field(canvas: &mut Canvas<'_>, verdict: Verdict, (x, y): Point, size: f64) {
    if verdict == Verdict::LeftOut {
        return;
    }
    canvas.polygon(&square((x, y), size), PALE);
    let hatch = Stroke {
        color: RGBColor(0xC4, 0xC4, 0xC4),
        width: 0.8,
    };
    for part in [1.0 / 3.0, 2.0 / 3.0, 1.0] {
        let reach = size * part;
        canvas.path(&[(x, y + reach), (x + reach, y)], hatch);
        if part < 1.0 {
            canvas.path(&[(x + reach, y + size), (x + size, y + reach)], hatch);
        }
    }
    let at = (x + size / 2.0, y + size / 2.0);
    canvas.text(letter(verdict), at, letters(9.0, true, HPos::Center));
}

/// One letter a verdict.
fn letter(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::NotANumber => "N",
        Verdict::Infinite => "I",
        Verdict::Overflow => "O",
        Verdict::Saturated => "F",
        Verdict::Oscillating => "~",
        Verdict::NegativeTransmittance => "T",
        Verdict::NegativeRadiance => "L",
        Verdict::NegativeMedium => "C",
        Verdict::OracleUnderflow => "M",
        Verdict::BranchDiverged => "B",
        Verdict::Absorbed => "A",
        Verdict::Underflow => "U",
        Verdict::Stalled => "S",
        Verdict::Refused => "R",
        Verdict::LeftOut => "",
    }
}

/// From few digits to many.
fn color(digits: f64) -> RGBColor {
    let share = (digits / MOST).clamp(0.0, 1.0) * 2.0;
    if share < 1.0 {
        between(LIGHT, MIDDLE, share)
    } else {
        between(MIDDLE, DARK, share - 1.0)
    }
}

fn between(from: RGBColor, to: RGBColor, share: f64) -> RGBColor {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Between two bytes.
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
    RGBColor(mix(from.0, to.0), mix(from.1, to.1), mix(from.2, to.2))
}

fn key(canvas: &mut Canvas<'_>, top: f64, verdicts: &[Verdict]) {
    let y = top + 8.0;
    canvas.text("digits", (10.0, y), letters(10.0, true, HPos::Left));
    for digit in 0..=16_u8 {
        let x = 60.0 + f64::from(digit) * 22.0;
        canvas.polygon(&square((x, y - 7.0), 14.0), color(f64::from(digit)));
        let number = Letters {
            color: if digit < 7 { TEXT } else { WHITE },
            ..letters(8.0, false, HPos::Center)
        };
        canvas.text(&digit.to_string(), (x + 7.0, y), number);
    }
    let named = verdicts.iter().filter(|v| **v != Verdict::LeftOut);
    for (line, verdict) in (0_u8..).zip(named) {
        let y = top + 32.0 + f64::from(line) * LINE;
        verdict_field(canvas, *verdict, (10.0, y - 6.0), 12.0);
        let meaning = format!("{verdict}: {}", verdict.meaning());
        canvas.text(&meaning, (30.0, y), letters(9.5, false, HPos::Left));
    }
    if verdicts.contains(&Verdict::LeftOut) {
        let muted = Letters {
            color: MUTED,
            ..letters(9.5, false, HPos::Left)
        };
        let text = "white: left out; a red frame: fewer digits than promised, and no verdict";
        canvas.text(text, (450.0, y), muted);
    }
}

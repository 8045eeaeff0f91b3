//! A case along its ray: one panel a function, the same λ below each other.

mod linear;
mod panel;
mod samples;
mod thin;

use super::canvas::{self, Canvas, Stroke, text_width};
use super::style::{TEXT, TICK_SIZE, WHITE, color, letters};
use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::report::ReportError;
use linear::Axis;
use panel::Frame;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::HPos;
use samples::Quantity;

const WIDTH: f64 = 640.0;
const MARGIN: f64 = 14.0;
const TITLE_HEIGHT: f64 = 34.0;
const TITLE_SIZE: f64 = 15.0;
const SMALLEST_TITLE: f64 = 10.0;
const KEY_HEIGHT: f64 = 18.0;
const KEY_SIZE: f64 = 11.5;
const KEY_SAMPLE: f64 = 18.0;
/// Below the last panel: tick labels and the name of the axis.
const BOTTOM: f64 = 40.0;

/// Draws all functions of all channels.
pub(super) fn figure(title: &str, channels: &[Manufactured]) -> Result<String, ReportError> {
    let quantities = samples::quantities(channels);
    let length = channels.first().map_or(1.0, |c| c.case.length().to_f64());
    let lambda = linear::ticks_between((0.0, length), 8);
    let mut places: Vec<f64> = channels
        .iter()
        .flat_map(Manufactured::break_places)
        .flatten()
        .filter(|place| *place > 0.0 && *place < length)
        .collect();
    places.sort_by(f64::total_cmp);
    places.dedup();

    let colors: Vec<RGBColor> = channels
        .iter()
        .enumerate()
        .map(|(index, case)| of_channel(case.channel.as_deref(), index))
        .collect();
    let key = if channels.len() > 1 { KEY_HEIGHT } else { 0.0 };
    let top = TITLE_HEIGHT + key;
    let height = (top + quantities.len() as f64 * panel::HEIGHT + BOTTOM).ceil();
    canvas::draw(title, (WIDTH, height), |canvas| {
        let corners = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, height), (0.0, height)];
        canvas.polygon(&corners, WHITE);
        write_title(canvas, title);
        if key > 0.0 {
            let names = channels.iter().map(|c| c.channel.as_deref().unwrap_or("-"));
            draw_key(canvas, names.zip(&colors));
        }
        let mut frame = Frame::new(WIDTH, top, length);
        for quantity in &quantities {
            frame.draw(canvas, quantity, &lambda, &places, &|channel| {
                curve_stroke(quantity, channel, &colors)
            });
            frame.next();
        }
        frame.draw_lambda(canvas, &lambda);
    })
}

/// What all channels share is drawn in the colour of text; later curves are thinner, so that they do not
/// hide those that they coincide with.
fn curve_stroke(quantity: &Quantity, channel: usize, colors: &[RGBColor]) -> Stroke {
    let color = if quantity.curves.len() == 1 && colors.len() > 1 {
        TEXT
    } else {
        colors.get(channel).copied().unwrap_or(TEXT)
    };
    let width = [2.2, 1.7, 1.2].get(channel).copied().unwrap_or(1.0);
    Stroke { color, width }
}

/// A channel named after a colour has it.
fn of_channel(name: Option<&str>, index: usize) -> RGBColor {
    match name {
        Some("red") => RGBColor(0xC8, 0x1E, 0x1E),
        Some("green") => RGBColor(0x00, 0x8F, 0x5A),
        Some("blue") => RGBColor(0x1F, 0x5F, 0xD0),
        _ => color(index),
    }
}

/// The title as large as there is room for, cut where even small letters do not fit.
fn write_title(canvas: &mut Canvas<'_>, title: &str) {
    let room = WIDTH - 2.0 * MARGIN;
    let size = (TITLE_SIZE * room / text_width(title, TITLE_SIZE).max(room)).max(SMALLEST_TITLE);
    let mut shown = title.to_string();
    while text_width(&shown, size) > room {
        shown.pop();
        shown.pop();
        shown.push('…');
    }
    let at = (MARGIN, TITLE_HEIGHT / 2.0);
    canvas.text(&shown, at, letters(size, true, HPos::Left));
}

fn draw_key<'n>(canvas: &mut Canvas<'_>, channels: impl Iterator<Item = (&'n str, &'n RGBColor)>) {
    let y = TITLE_HEIGHT + KEY_HEIGHT / 2.0 - 3.0;
    let mut x = MARGIN;
    for (name, color) in channels {
        let stroke = Stroke {
            color: *color,
            width: 2.4,
        };
        canvas.path(&[(x, y), (x + KEY_SAMPLE, y)], stroke);
        x += KEY_SAMPLE + 5.0;
        canvas.text(name, (x, y), letters(KEY_SIZE, false, HPos::Left));
        x += text_width(name, KEY_SIZE) + 14.0;
    }
}

/// The widest label that stands left of an axis.
fn widest(axis: &Axis) -> f64 {
    let widths = axis
        .ticks
        .iter()
        .map(|(_, text)| text_width(text, TICK_SIZE));
    widths.fold(0.0, f64::max)
}

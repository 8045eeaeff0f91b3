//! One function of a case: heading, axes and curves.

use super::super::area::Area;
use super::super::canvas::{Canvas, Stroke, text_width};
use super::super::scale::{Scale, apart, power_of_ten};
use super::super::style::{AXIS, GRID, MUTED, TICK_SIZE, letters};
use super::linear::{self, Axis};
use super::samples::Quantity;
use super::thin::thin;
use super::widest;
use plotters::style::text_anchor::HPos;
use rug::Float;

/// What a panel takes, heading included.
pub(super) const HEIGHT: f64 = 118.0;
const HEADING: f64 = 18.0;
const GAP: f64 = 10.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 20.0;
const HEADING_LEFT: f64 = 14.0;
const HEADING_SIZE: f64 = 11.5;
const MOST_TICKS: usize = 5;
/// Digits of a value at the far end.
const DIGITS: usize = 5;

const BREAK: Stroke = Stroke {
    color: MUTED,
    width: 0.9,
};
const BREAK_DASHES: (f64, f64) = (3.0, 3.0);

/// Where the next panel goes.
pub(super) struct Frame {
    plot: Area,
    x: Scale,
}

impl Frame {
    /// The first panel, below `top`, for λ from 0 to `length`.
    pub(super) fn new(width: f64, top: f64, length: f64) -> Frame {
        let plot = Area {
            left: LEFT,
            right: width - RIGHT,
            top: top + HEADING,
            bottom: top + HEIGHT - GAP,
        };
        let x = Scale::new((0.0, length), (plot.left, plot.right));
        Frame { plot, x }
    }

    pub(super) fn next(&mut self) {
        self.plot.top += HEIGHT;
        self.plot.bottom += HEIGHT;
    }

    /// Draws a function; `lambda` is the common axis, `places` those of breaks.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas<'_>,
        quantity: &Quantity,
        lambda: &Axis,
        places: &[f64],
        stroke: &dyn Fn(usize) -> Stroke,
    ) {
        let plot = self.plot;
        let values = quantity.curves.iter().flatten().flatten().map(|p| p.1);
        let axis = if quantity.is_logarithm {
            linear::logarithmic(values, MOST_TICKS)
        } else {
            linear::axis(values, MOST_TICKS)
        };
        heading(canvas, quantity, axis.as_ref(), &plot);
        for (place, _) in &lambda.ticks {
            let x = self.x.pixel(*place);
            canvas.path(&[(x, plot.top), (x, plot.bottom)], GRID);
        }
        if let Some(axis) = &axis {
            let y = Scale::new(axis.range, (plot.bottom, plot.top));
            self.draw_ticks(canvas, axis, &y);
            for place in places {
                let x = self.x.pixel(*place);
                canvas.dashes(&[(x, plot.top), (x, plot.bottom)], BREAK, BREAK_DASHES);
            }
            for (channel, curve) in quantity.curves.iter().enumerate() {
                for run in curve {
                    let path = run.iter().map(|p| (self.x.pixel(p.0), y.pixel(p.1)));
                    let path: Vec<_> = path.collect();
                    canvas.path(&thin(&path), stroke(channel));
                }
            }
        } else {
            let middle = (
                f64::midpoint(plot.left, plot.right),
                f64::midpoint(plot.top, plot.bottom),
            );
            canvas.text("no value", middle, letters(TICK_SIZE, false, HPos::Center));
        }
        let corners = [
            (plot.left, plot.top),
            (plot.left, plot.bottom),
            (plot.right, plot.bottom),
        ];
        canvas.path(&corners, AXIS);
    }

    fn draw_ticks(&self, canvas: &mut Canvas<'_>, axis: &Axis, y: &Scale) {
        let plot = self.plot;
        // Wider labels than there is room for would be cut: smaller letters then.
        let size = TICK_SIZE * (1.0_f64).min((LEFT - 7.0) / widest(axis));
        for (value, label) in &axis.ticks {
            let y = y.pixel(*value);
            canvas.path(&[(plot.left, y), (plot.right, y)], GRID);
            let at = (plot.left - 5.0, y);
            canvas.text(label, at, letters(size, false, HPos::Right));
        }
    }

    /// The labels of λ, below the last panel: the frame is already one further.
    pub(super) fn draw_lambda(&self, canvas: &mut Canvas<'_>, lambda: &Axis) {
        let bottom = self.plot.bottom - HEIGHT;
        let places: Vec<(f64, f64)> = lambda
            .ticks
            .iter()
            .map(|(place, text)| (self.x.pixel(*place), text_width(text, TICK_SIZE)))
            .collect();
        for index in apart(&places, 5.0) {
            if let (Some((x, _)), Some((_, text))) = (places.get(index), lambda.ticks.get(index)) {
                let at = (*x, bottom + 11.0);
                canvas.text(text, at, letters(TICK_SIZE, false, HPos::Center));
            }
        }
        let middle = f64::midpoint(self.plot.left, self.plot.right);
        let label = format!("λ along the ray{}", times(lambda.exponent));
        let at = (middle, bottom + 28.0);
        canvas.text(&label, at, letters(HEADING_SIZE, false, HPos::Center));
    }
}

/// The function's name to the left, its value at the far end to the right.
fn heading(canvas: &mut Canvas<'_>, quantity: &Quantity, axis: Option<&Axis>, plot: &Area) {
    let y = plot.top - HEADING / 2.0;
    let exponent = axis.and_then(|axis| axis.exponent);
    let scale = if quantity.is_logarithm {
        ", logarithmic".into()
    } else {
        times(exponent)
    };
    let text = format!("{}{scale}", quantity.name);
    let at = (HEADING_LEFT, y);
    canvas.text(&text, at, letters(HEADING_SIZE, true, HPos::Left));
    if let Some((name, value)) = &quantity.at_end {
        let text = format!("{name} = {}", written(value));
        let at = (plot.right, y);
        canvas.text(&text, at, letters(TICK_SIZE, false, HPos::Right));
    }
}

fn times(exponent: Option<i32>) -> String {
    exponent.map_or(String::new(), |e| {
        format!(", in {}", power_of_ten(f64::from(e)))
    })
}

/// "0.65656", "1.9287 · 10⁻²²".
fn written(value: &Float) -> String {
    let (negative, digits, exponent) = value.to_sign_string_exp(10, Some(DIGITS));
    let sign = if negative { "−" } else { "" };
    match exponent {
        None => digits,
        Some(e) if (-2..=4).contains(&e) => {
            let decimals = usize::try_from(5 - e).unwrap_or(0);
            format!("{:.decimals$}", value.to_f64())
        }
        Some(e) => {
            let (first, rest) = digits.split_at_checked(1).unwrap_or((&digits, ""));
            format!("{sign}{first}.{rest} · {}", power_of_ten(f64::from(e - 1)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_written_short() {
        for (text, expected) in [
            ("0.656565656", "0.65657"),
            ("1.5", "1.5000"),
            ("50", "50.000"),
            ("1.92874984796e-22", "1.9287 · 10⁻²²"),
            ("0", "0"),
        ] {
            let value = Float::with_val(128, Float::parse(text).unwrap());
            assert_eq!(written(&value), expected);
        }
    }
}

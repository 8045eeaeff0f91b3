//! A case along its ray as plots.

use super::sample::{Curve, Quantity, quantities};
use super::thin::thin;
use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::document::{Axis, Guide, Plot, Series, Stroke, Trace};
use rug::Float;

/// Digits of a value at the far end.
const DIGITS: usize = 5;
/// About the pixels that a plot has: what they cannot show is left out.
const PIXELS: (f64, f64) = (400.0, 280.0);
/// The colour of what all channels share.
const SHARED: usize = 6;

/// The channels of one case along its ray, a plot a function: field, emission, extinction, transmittance and radiance.
///
/// Places where the case is not analytic are dashed; curves break at jumps and where there is no value.
#[must_use]
pub fn of_case(channels: &[Manufactured]) -> Vec<Plot> {
    let length = channels.first().map_or(1.0, |c| c.case.length().to_f64());
    let mut breaks: Vec<f64> = channels
        .iter()
        .flat_map(Manufactured::break_places)
        .flatten()
        .filter(|place| *place > 0.0 && *place < length)
        .collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    let quantities = quantities(channels);
    let plots = quantities.iter();
    plots
        .map(|quantity| plot(quantity, channels, length, &breaks))
        .collect()
}

fn plot(quantity: &Quantity, channels: &[Manufactured], length: f64, breaks: &[f64]) -> Plot {
    let symbol = quantity.symbol;
    let (scale_is, y) = if quantity.is_logarithm {
        (", logarithmic", Axis::log(symbol))
    } else {
        ("", Axis::linear(symbol))
    };
    let at_end = quantity.at_end.as_ref();
    let at_end = at_end.map(|value| format!("; {symbol}(D) = {}", written(value)));
    let title = format!("{}{scale_is}{}", quantity.name, at_end.unwrap_or_default());
    let mut plot = Plot::new(title, Axis::linear("λ along the ray"), y);
    let scale = scale(quantity, length);
    let is_shared = quantity.curves.len() == 1 && channels.len() > 1;
    let curves = quantity.curves.iter().zip(channels).enumerate();
    plot.series = curves
        .map(|(index, (curve, case))| {
            let (name, color) = look(is_shared, case.channel.as_deref(), index);
            let mut series = Series::marks(name, []).colored(color);
            series.traces.push(trace(curve, length, scale));
            series
        })
        .collect();
    plot.guides = breaks
        .iter()
        .map(|at| Guide {
            upright: true,
            at: *at,
            label: String::new(),
        })
        .collect();
    plot
}

/// The name and the colour of a channel: one named after a colour has it, and a single one needs no name beside the title.
fn look(is_shared: bool, channel: Option<&str>, index: usize) -> (&str, usize) {
    let color = match channel {
        _ if is_shared => return ("all channels", SHARED),
        Some("red") => 4,
        Some("green") => 2,
        Some("blue") => 0,
        _ => index,
    };
    (channel.unwrap_or_default(), color)
}

/// Pixels a unit of both axes.
fn scale(quantity: &Quantity, length: f64) -> (f64, f64) {
    let values = quantity
        .curves
        .iter()
        .flatten()
        .flatten()
        .map(|point| point.1);
    let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let size = (ends.1 - ends.0).max(f64::MIN_POSITIVE);
    (PIXELS.0 / length, PIXELS.1 / size)
}

/// All runs in one line that breaks between them; it spans the ray, whatever part of it has values.
fn trace(curve: &Curve, length: f64, (across, upwards): (f64, f64)) -> Trace {
    let mut points = vec![(0.0, f64::NAN)];
    for run in curve {
        let pixels: Vec<(f64, f64)> = run.iter().map(|(x, y)| (x * across, y * upwards)).collect();
        let kept = thin(&pixels).into_iter();
        points.extend(kept.map(|index| run[index]));
        points.push((run.last().map_or(length, |last| last.0), f64::NAN));
    }
    points.push((length, f64::NAN));
    Trace {
        stroke: Stroke::Solid,
        points,
    }
}

/// "0.65656", "1.9287e-22".
fn written(value: &Float) -> String {
    let (negative, digits, exponent) = value.to_sign_string_exp(10, Some(DIGITS));
    let sign = if negative { "-" } else { "" };
    match exponent {
        None => digits,
        Some(e) if (-2..=4).contains(&e) => {
            let decimals = usize::try_from(5 - e).unwrap_or(0);
            format!("{:.decimals$}", value.to_f64())
        }
        Some(e) => {
            let (first, rest) = digits.split_at_checked(1).unwrap_or((&digits, ""));
            format!("{sign}{first}.{rest}e{}", e - 1)
        }
    }
}

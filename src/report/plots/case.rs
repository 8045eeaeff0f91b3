//! A case along its ray as plots.

use super::sample::{Curve, Sampled, sample};
use super::thin::thin;
use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::document::{Axis, Guide, Plot, Series, Stroke};
use rug::Float;
use std::f64::consts::LN_10;

/// An optical depth from which on the transmittance is drawn by its logarithm: T = 10⁻⁴.
const LOGARITHMIC_FROM: f64 = 4.0 * LN_10;
/// Digits of a value at the far end.
const DIGITS: usize = 5;
/// About the pixels that a plot has: what they cannot show is left out.
const PIXELS: (f64, f64) = (400.0, 280.0);
/// The colour of what all channels share.
const SHARED: usize = 6;

/// The channels of one case along its ray, a plot a function: field, emission, extinction, transmittance and radiance.
///
/// Places where the case is not analytic are dashed; curves break at jumps and where there is no value. What has no closed
/// form is not drawn.
#[must_use]
pub fn of_case(channels: &[Manufactured]) -> Vec<Plot> {
    let sampled: Vec<Sampled> = channels.iter().map(sample).collect();
    let Some(Sampled {
        curves: [field, _, extinction, depth, _],
        ends,
    }) = sampled.first()
    else {
        return Vec::new();
    };
    let of_all = |index: usize| {
        sampled
            .iter()
            .map(|channel| &channel.curves[index])
            .collect::<Vec<_>>()
    };
    let depth_at_end = ends[3].as_ref();
    let is_thick = depth_at_end.is_some_and(|t| *t >= LOGARITHMIC_FROM);
    let (scale, axis): (_, fn(&'static str) -> Axis) = if is_thick {
        (", logarithmic", Axis::log)
    } else {
        ("", Axis::linear)
    };
    let through = |t: f64| if is_thick { -t / LN_10 } else { (-t).exp() };
    let transmittance = depth.iter().map(|(x, t)| (*x, through(*t))).collect();
    let through = depth_at_end.map(|depth| Float::with_val(depth.prec(), -depth).exp());
    let light = ends[4].as_ref().filter(|_| channels.len() == 1);
    let [t_end, i_end] = [("T", through.as_ref()), ("I", light)].map(|(name, value)| {
        value.map_or(String::new(), |value| {
            format!("; {name}(D) = {}", written(value))
        })
    });
    let ray = Ray::new(channels);
    let plots = [
        ray.plot("field s", Axis::linear("s"), &[field]),
        ray.plot("emission C", Axis::linear("C"), &of_all(1)),
        ray.plot("extinction τ", Axis::linear("τ"), &[extinction]),
        ray.plot(
            format!("transmittance T = exp(−t){scale}{t_end}"),
            axis("T"),
            &[&transmittance],
        ),
        ray.plot(
            format!("radiance I of the ray up to λ{i_end}"),
            Axis::linear("I"),
            &of_all(4),
        ),
    ];
    plots.into_iter().flatten().collect()
}

/// What all plots of a case share.
struct Ray<'c> {
    channels: &'c [Manufactured],
    length: f64,
    breaks: Vec<Guide>,
}

impl<'c> Ray<'c> {
    fn new(channels: &'c [Manufactured]) -> Self {
        let length = channels.first().map_or(1.0, |c| c.case.length().to_f64());
        let places = channels
            .iter()
            .flat_map(Manufactured::break_places)
            .flatten();
        let mut places: Vec<f64> = places
            .filter(|place| *place > 0.0 && *place < length)
            .collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let guide = |at| Guide {
            upright: true,
            at,
            label: String::new(),
        };
        Ray {
            channels,
            length,
            breaks: places.into_iter().map(guide).collect(),
        }
    }

    /// A function, of each channel or the same for all; none where it has no value anywhere.
    fn plot(&self, title: impl Into<String>, y: Axis, curves: &[&Curve]) -> Option<Plot> {
        let values = curves.iter().copied().flatten().map(|point| point.1);
        let ends = values.filter(|value| value.is_finite()).fold(
            None,
            |ends: Option<(f64, f64)>, value| {
                let (low, high) = ends.unwrap_or((value, value));
                Some((low.min(value), high.max(value)))
            },
        )?;
        let scale = (
            PIXELS.0 / self.length,
            PIXELS.1 / (ends.1 - ends.0).max(f64::MIN_POSITIVE),
        );
        let is_shared = curves.len() == 1 && self.channels.len() > 1;
        let mut plot = Plot::new(title, Axis::linear("λ along the ray"), y);
        for (index, (curve, case)) in curves.iter().zip(self.channels).enumerate() {
            let (name, color) = look(is_shared, case.channel.as_deref(), index);
            let mut series = Series::marks(name, []).colored(color);
            series
                .traces
                .extend(super::trace(Stroke::Solid, self.line(curve, scale)));
            plot.series.push(series);
        }
        plot.guides.clone_from(&self.breaks);
        Some(plot)
    }

    /// All runs in one line that breaks between them; it spans the ray, whatever part of it has values.
    fn line(&self, curve: &Curve, (across, upwards): (f64, f64)) -> Vec<(f64, f64)> {
        let mut points = vec![(0.0, f64::NAN)];
        for run in curve
            .split(|(_, value)| !value.is_finite())
            .filter(|run| run.len() > 1)
        {
            let pixels: Vec<(f64, f64)> =
                run.iter().map(|(x, y)| (x * across, y * upwards)).collect();
            points.extend(thin(&pixels).into_iter().map(|index| run[index]));
            points.push((self.length, f64::NAN));
        }
        points
    }
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

//! ParaView's colour maps: opacities 0 … 1 of a length, and colours.
//!
//! Between two points opacity is linear in s, and so extinction, −ln(1 − α)/length, is not: it is cut into pieces on each of
//! which the chord is near enough. For α of slope a' on a piece of width h, |τ''| = (a'/(1 − α))²/length, largest where α is,
//! and the chord is off by at most h²/8 of that.

use super::text::json;
use crate::binary::{Trouble, refused};
use crate::volume::{ControlPoint, TransferFunction};
use serde::Deserialize;
use serde_json::Value;

/// VTK takes less for 0.
const STRAIGHT: f64 = 0.01;
/// More points are no transfer function.
const MOST: usize = 1 << 16;

/// How a colour map of ParaView becomes a transfer function: its colours are C, and its opacity α is that of a length,
/// so that τ = −ln(1 − α)/length.
///
/// Points with a midpoint are two straight pieces that meet at half the rise. A sharpness above 0 is refused, because
/// VTK and vtk.js draw different curves of it, and so is an opacity of 1, which no extinction has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorMap {
    /// The length of which the opacities are: ParaView's and VTK's `ScalarOpacityUnitDistance`.
    pub unit_length: f64,
    /// How far the extinction between control points may be from −ln(1 − α)/length, relative to the largest.
    pub tolerance: f64,
}

impl Default for ColorMap {
    /// A length of 1, as VTK has it, and a millionth.
    fn default() -> ColorMap {
        ColorMap {
            unit_length: 1.0,
            tolerance: 1e-6,
        }
    }
}

/// What is read of it; it has more.
#[derive(Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Map {
    color_space: Option<String>,
    #[serde(rename = "RGBPoints")]
    rgb_points: Option<Vec<f64>>,
    points: Option<Vec<f64>>,
}

/// α at a place, up to the next.
#[derive(Clone, Copy)]
struct Knot {
    s: f64,
    opacity: f64,
}

pub(super) fn read(value: &Value, map: &ColorMap) -> Result<(TransferFunction, f64), Trouble> {
    let right = |number: f64| number > 0.0 && number.is_finite();
    if !right(map.unit_length) || !right(map.tolerance) {
        return Err(refused(
            format!(
                "a unit length of {} and a tolerance of {}",
                map.unit_length, map.tolerance
            ),
            "finite numbers above 0",
        ));
    }
    let mut maps: Vec<Map> = Vec::deserialize(value).map_err(json)?;
    let (Some(one), true) = (maps.pop(), maps.is_empty()) else {
        return Err(refused(
            "a list of several colour maps, or of none",
            "one colour map",
        ));
    };
    if let Some(space) = one.color_space.filter(|space| space != "RGB") {
        return Err(refused(
            format!("ColorSpace '{}'", space.escape_debug()),
            "RGB, in which colours are linear between points",
        ));
    }
    let colors = colors(&one.rgb_points.unwrap_or_default())?;
    let knots = knots(&one.points.unwrap_or_default())?;
    converted(&colors, &knots, map)
}

/// Groups of four numbers, by rising first.
fn fours(numbers: &[f64], name: &str) -> Result<Vec<[f64; 4]>, Trouble> {
    let wanted = "four numbers a point, finite, the first of them rising";
    let fours: Vec<[f64; 4]> = numbers
        .chunks(4)
        .filter_map(|four| four.try_into().ok())
        .collect();
    if fours.is_empty() || !numbers.len().is_multiple_of(4) {
        return Err(refused(
            format!("{name} with {} numbers", numbers.len()),
            wanted,
        ));
    }
    let rising = fours.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if !rising || !numbers.iter().all(|number| number.is_finite()) {
        return Err(refused(format!("{name} that do not rise"), wanted));
    }
    Ok(fours)
}

fn colors(numbers: &[f64]) -> Result<Vec<[f64; 4]>, Trouble> {
    fours(numbers, "RGBPoints")
}

/// The places between which opacity is linear.
fn knots(numbers: &[f64]) -> Result<Vec<Knot>, Trouble> {
    let points = fours(numbers, "Points")?;
    let mut knots = Vec::with_capacity(2 * points.len());
    for (i, &[s, opacity, midpoint, sharpness]) in points.iter().enumerate() {
        if !(0.0..1.0).contains(&opacity) {
            return Err(refused(
                format!("Points: an opacity of {opacity} at {s}"),
                "0 up to below 1; 1 is an infinite extinction",
            ));
        }
        knots.push(Knot { s, opacity });
        // Those of the last point say nothing.
        let Some(&[next, after, ..]) = points.get(i + 1) else {
            continue;
        };
        if !(0.0..STRAIGHT).contains(&sharpness) {
            return Err(refused(
                format!("Points: a sharpness of {sharpness} at {s}"),
                "0: VTK and vtk.js draw different curves of others",
            ));
        }
        if !(midpoint > 0.0 && midpoint < 1.0) {
            return Err(refused(
                format!("Points: a midpoint of {midpoint} at {s}"),
                "above 0, below 1",
            ));
        }
        let middle = s + midpoint * (next - s);
        if s < middle && middle < next {
            knots.push(Knot {
                s: middle,
                opacity: 0.5 * (opacity + after),
            });
        }
    }
    Ok(knots)
}

/// Control points, and how far the extinction may be off between them, relative to the largest.
fn converted(
    colors: &[[f64; 4]],
    knots: &[Knot],
    map: &ColorMap,
) -> Result<(TransferFunction, f64), Trouble> {
    let depth = |opacity: f64| -(-opacity).ln_1p();
    let largest = knots
        .iter()
        .map(|knot| depth(knot.opacity))
        .fold(0.0, f64::max);
    let most = map.tolerance * largest;
    let mut places: Vec<Knot> = Vec::new();
    let mut error = 0.0_f64;
    for pair in knots.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        places.push(from);
        // By equal factors of 1 − α, whose logarithm is what bends: each piece is then off by the same.
        let ratio = depth(to.opacity) - depth(from.opacity);
        if ratio == 0.0 {
            continue;
        }
        let pieces = (ratio.abs() / (8.0 * most).sqrt().ln_1p()).ceil().max(1.0);
        if pieces.is_nan() || pieces >= MOST as f64 {
            return Err(refused(
                format!("a tolerance of {}", map.tolerance),
                format!("one that {MOST} points reach"),
            ));
        }
        error = error.max(piece(ratio, pieces));
        let mut part = 1.0;
        while part < pieces {
            let opacity = -(-(depth(from.opacity) + ratio * part / pieces)).exp_m1();
            let along = (opacity - from.opacity) / (to.opacity - from.opacity);
            places.push(Knot {
                s: from.s + along * (to.s - from.s),
                opacity,
            });
            part += 1.0;
        }
    }
    places.extend(knots.last());
    // Where colours bend, the extinction between two places is that of the chord: it is no further off.
    let mut all: Vec<f64> = places
        .iter()
        .map(|place| place.s)
        .chain(colors.iter().map(|color| color[0]))
        .collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let extinction = held(&places, |place| place.s, |place| depth(place.opacity));
    let points = all.iter().map(|&s| ControlPoint {
        s,
        extinction: extinction(s) / map.unit_length,
        emission: [1, 2, 3]
            .map(|part| held(colors, |color| color[0], |color| color[part])(s))
            .to_vec(),
    });
    let transfer = TransferFunction {
        channels: ["r", "g", "b"].map(str::to_owned).to_vec(),
        points: points.collect(),
    };
    Ok((transfer, if largest > 0.0 { error / largest } else { 0.0 }))
}

/// How far the chord of −ln(1 − α) is off at most on a piece on which it rises by `ratio`/`pieces`, α being linear: by
/// e = (α₁ − α₀)²/(8 (1 − α₁)²) = (e^r − 1)²/8 with r the rise.
fn piece(ratio: f64, pieces: f64) -> f64 {
    let rise = (ratio.abs() / pieces).exp_m1();
    rise * rise / 8.0
}

/// A function that is linear between entries, and held beyond them.
fn held<T>(
    entries: &[T],
    place: impl Fn(&T) -> f64,
    value: impl Fn(&T) -> f64,
) -> impl Fn(f64) -> f64 {
    move |s| {
        let above = entries.partition_point(|entry| place(entry) <= s);
        let from = entries.get(above.saturating_sub(1));
        let to = entries.get(above).or(entries.last());
        let (Some(from), Some(to)) = (from, to) else {
            return f64::NAN;
        };
        let width = place(to) - place(from);
        let part = if width > 0.0 {
            ((s - place(from)) / width).clamp(0.0, 1.0)
        } else {
            0.0
        };
        value(from) * (1.0 - part) + value(to) * part
    }
}

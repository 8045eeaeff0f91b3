//! Grid, ticks and labels of a plot.

use super::scale::Scale;
use super::ticks::{Tick, power, ticks};
use crate::document::{Axis, Guide, Plot, Scale as Kind};
use maud::{Markup, html};

/// The size of a drawing; browsers scale it.
pub(in crate::render) const WIDTH: f64 = 480.0;
pub(in crate::render) const HEIGHT: f64 = 340.0;
/// The frame within it.
pub(super) const LEFT: f64 = 74.0;
pub(super) const TOP: f64 = 10.0;
pub(super) const RIGHT: f64 = 470.0;
pub(super) const BOTTOM: f64 = 292.0;
/// The width of a letter of a label, about: fonts are the reader's.
pub(super) const LETTER: f64 = 7.0;
/// Traces so many decades from the points have room.
const NEAR: f64 = 1.0;

/// The two scales of a plot.
#[derive(Clone, Copy)]
pub(in crate::render) struct Scales {
    x: Scale,
    y: Scale,
}

impl Scales {
    /// Room for all points, for level lines, and for what traces have near them; for all of traces where there is no point.
    /// `None` where there is nothing to draw.
    pub(in crate::render) fn new(plot: &Plot) -> Option<Self> {
        let series = || plot.series.iter();
        let is_placed = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
        let points = series().flat_map(|series| &series.points);
        let points = points.map(|point| (point.x, point.y)).filter(is_placed);
        let mut places: Vec<(f64, f64)> = points.collect();
        let traces = series().flat_map(|series| &series.traces);
        let traces: Vec<(f64, f64)> = traces.flat_map(|trace| trace.points.clone()).collect();
        let guides = |upright: bool| {
            let all = plot.guides.iter();
            all.filter(move |guide| guide.upright == upright)
                .map(|guide| guide.at)
        };
        if places.is_empty() {
            places = traces;
        } else if plot.y.scale == Kind::Log {
            let heights = || places.iter().map(|(_, y)| *y);
            let low = heights().fold(f64::INFINITY, f64::min) - NEAR;
            let high = heights().fold(f64::NEG_INFINITY, f64::max) + NEAR;
            places.extend(traces.iter().filter(|(_, y)| (low..=high).contains(y)));
        }
        let xs = places.iter().map(|(x, _)| *x).chain(guides(true));
        let ys = places.iter().map(|(_, y)| *y).chain(guides(false));
        Some(Scales {
            x: Scale::around(xs, plot.x.scale, (LEFT, RIGHT)).filter(|_| !places.is_empty())?,
            y: Scale::around(ys, plot.y.scale, (BOTTOM, TOP))?,
        })
    }

    /// The place of a point, where it has one within reach of the frame: a page that was read may say anything.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        let place = (self.x.pixel(x), self.y.pixel(y));
        let is_near = |pixel: f64| pixel.abs() < 1e6;
        (is_near(place.0) && is_near(place.1)).then_some(place)
    }

    /// Whether a line can be seen.
    pub(super) fn meet(&self, line: &[(f64, f64)]) -> bool {
        line.windows(2).any(|ends| {
            let (from, to) = (ends[0], ends[1]);
            self.x.meets(from.0, to.0) && self.y.meets(from.1, to.1)
        })
    }
}

/// What lies below the curves.
pub(super) fn axes(plot: &Plot, scales: &Scales) -> Markup {
    let middle = f64::midpoint(LEFT, RIGHT);
    let height = f64::midpoint(TOP, BOTTOM);
    let (across, x_power) = ticks(&scales.x, plot.x.scale);
    let (upwards, y_power) = ticks(&scales.y, plot.y.scale);
    let stride = stride(&across, &scales.x);
    html! {
        g.grid {
            @for tick in &across {
                @let x = format!("{:.2}", scales.x.pixel(tick.at));
                line.minor[tick.label.is_none()] x1=(x) x2=(x) y1=(TOP) y2=(BOTTOM) {}
            }
            @for (tick, label) in labelled(&across).step_by(stride) {
                text.x x=(format!("{:.2}", scales.x.pixel(tick.at))) y=(BOTTOM + 16.0) { (label) }
            }
            @for tick in &upwards {
                @let y = format!("{:.2}", scales.y.pixel(tick.at));
                line.minor[tick.label.is_none()] y1=(y) y2=(y) x1=(LEFT) x2=(RIGHT) {}
                @if let Some(label) = &tick.label { text.y x=(LEFT - 7.0) y=(y) dy="0.35em" { (label) } }
            }
            rect.frame x=(LEFT) y=(TOP) width=(RIGHT - LEFT) height=(BOTTOM - TOP) {}
            text.title x=(middle) y=(HEIGHT - 8.0) { (title(&plot.x, x_power)) }
            text.title transform={ "translate(13 " (height) ") rotate(-90)" } { (title(&plot.y, y_power)) }
        }
    }
}

fn labelled(ticks: &[Tick]) -> impl Iterator<Item = (&Tick, &String)> {
    ticks
        .iter()
        .filter_map(|tick| Some((tick, tick.label.as_ref()?)))
}

/// Every second, third … label is written so that none touch; their distances stay even.
fn stride(ticks: &[Tick], scale: &Scale) -> usize {
    let places: Vec<(f64, f64)> = labelled(ticks)
        .map(|(tick, label)| (scale.pixel(tick.at), LETTER * label.chars().count() as f64))
        .collect();
    let touch = |a: &(f64, f64), b: &(f64, f64)| b.0 - a.0 < f64::midpoint(a.1, b.1) + LETTER;
    let fits = |stride: &usize| {
        let kept: Vec<_> = places.iter().step_by(*stride).collect();
        !kept.windows(2).any(|pair| touch(pair[0], pair[1]))
    };
    (1..places.len()).find(fits).unwrap_or(places.len().max(1))
}

fn title(axis: &Axis, power_of_ten: Option<i32>) -> String {
    match power_of_ten {
        Some(e) => format!("{}, in {}", axis.title, power(1, f64::from(e))),
        None => axis.title.clone(),
    }
}

/// Lines across, each with its words; the words of lines without a place stand in a corner.
pub(super) fn guides(plot: &Plot, scales: &Scales) -> Markup {
    html! {
        @for (index, guide) in plot.guides.iter().enumerate() {
            (line(guide, scales, index as f64))
        }
    }
}

fn line(guide: &Guide, scales: &Scales, index: f64) -> Markup {
    let below = TOP + 14.0 + 14.0 * index;
    let (path, x, y, anchor) = if !guide.at.is_finite() {
        (None, RIGHT - 6.0, below, "end")
    } else if guide.upright {
        let x = scales.x.pixel(guide.at);
        let is_left = x < f64::midpoint(LEFT, RIGHT);
        let (aside, anchor) = if is_left {
            (5.0, "start")
        } else {
            (-5.0, "end")
        };
        (
            Some(format!("M{x:.2} {TOP}V{BOTTOM}")),
            x + aside,
            below,
            anchor,
        )
    } else {
        let y = scales.y.pixel(guide.at);
        (
            Some(format!("M{LEFT} {y:.2}H{RIGHT}")),
            RIGHT - 6.0,
            y - 5.0,
            "end",
        )
    };
    html! {
        g.guide {
            @if let Some(path) = path { path d=(path) {} }
            @if !guide.label.is_empty() {
                text x=(format!("{x:.2}")) y=(format!("{y:.2}")) text-anchor=(anchor) { (guide.label) }
            }
        }
    }
}

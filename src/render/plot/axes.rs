//! Grid, ticks and labels of a plot.

use super::scale::Scale;
use super::ticks::ticks;
use crate::document::{Guide, Plot};
use maud::{Markup, html};

/// The size of a drawing; browsers scale it.
pub(super) const WIDTH: f64 = 480.0;
pub(super) const HEIGHT: f64 = 340.0;
/// The frame within it.
pub(super) const LEFT: f64 = 74.0;
pub(super) const TOP: f64 = 10.0;
pub(super) const RIGHT: f64 = 470.0;
pub(super) const BOTTOM: f64 = 292.0;

/// The two scales of a plot.
#[derive(Clone, Copy)]
pub(super) struct Scales {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Scales {
    /// Room for all points, and for level lines; for traces only where there is no point. `None` where there is
    /// nothing to draw.
    pub(super) fn new(plot: &Plot) -> Option<Self> {
        let points = plot.series.iter().flat_map(|series| &series.points);
        let mut places: Vec<(f64, f64)> = points.map(|point| (point.x, point.y)).collect();
        places.retain(|(x, y)| x.is_finite() && y.is_finite());
        if places.is_empty() {
            let traces = plot.series.iter().flat_map(|series| &series.traces);
            places = traces.flat_map(|trace| trace.points.clone()).collect();
        }
        let guides = |upright: bool| {
            let wanted = plot
                .guides
                .iter()
                .filter(move |guide| guide.upright == upright);
            wanted.map(|guide| guide.at)
        };
        let xs = places.iter().map(|(x, _)| *x).chain(guides(true));
        let ys = places.iter().map(|(_, y)| *y).chain(guides(false));
        Some(Scales {
            x: Scale::around(xs, (LEFT, RIGHT)).filter(|_| !places.is_empty())?,
            y: Scale::around(ys, (BOTTOM, TOP))?,
        })
    }

    /// The place of a point, where it has one within reach of the frame: a page that was read may say anything.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        let place = (self.x.pixel(x), self.y.pixel(y));
        let is_near = |pixel: f64| pixel.abs() < 1e6;
        (is_near(place.0) && is_near(place.1)).then_some(place)
    }
}

/// What lies below the curves.
pub(super) fn axes(plot: &Plot, scales: &Scales) -> Markup {
    let middle = f64::midpoint(LEFT, RIGHT);
    let height = f64::midpoint(TOP, BOTTOM);
    html! {
        g.grid {
            @for tick in ticks(&scales.x, plot.x.scale) {
                @let x = format!("{:.2}", scales.x.pixel(tick.at));
                line.minor[tick.label.is_none()] x1=(x) x2=(x) y1=(TOP) y2=(BOTTOM) {}
                @if let Some(label) = &tick.label { text.x x=(x) y=(BOTTOM + 16.0) { (label) } }
            }
            @for tick in ticks(&scales.y, plot.y.scale) {
                @let y = format!("{:.2}", scales.y.pixel(tick.at));
                line.minor[tick.label.is_none()] y1=(y) y2=(y) x1=(LEFT) x2=(RIGHT) {}
                @if let Some(label) = &tick.label { text.y x=(LEFT - 7.0) y=(y) dy="0.35em" { (label) } }
            }
            rect.frame x=(LEFT) y=(TOP) width=(RIGHT - LEFT) height=(BOTTOM - TOP) {}
            text.title x=(middle) y=(HEIGHT - 8.0) { (plot.x.title) }
            text.title transform={ "translate(13 " (height) ") rotate(-90)" } { (plot.y.title) }
        }
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
            text x={ (format!("{x:.2}")) } y={ (format!("{y:.2}")) } text-anchor=(anchor) { (guide.label) }
        }
    }
}

//! A set of samples with its fit as a plot.

use super::{Level, curve, key, legend, log10_abs, slope, trace};
use crate::convergence::{Fit, Sample};
use crate::document::{Axis, Plot, Point, Stroke};

const ERROR: &str = "|error|";

/// A set of samples, coarse to fine, with its fit: against segments n where every sample has n, otherwise against 1/d.
#[must_use]
pub fn of_convergence(samples: &[Sample], fit: &Fit, title: &str) -> Plot {
    let levels: Option<Vec<u64>> = samples.iter().map(|s| s.n.filter(|n| *n > 0)).collect();
    let level = |sample: &Sample| match (&levels, sample.n) {
        (Some(_), Some(n)) => Level::of_n(n),
        _ => Level::of_step(sample.step),
    };
    let in_window = |index: usize| {
        let window = fit.window.as_ref();
        window.is_some_and(|window| (window.first..=window.last).contains(&index))
    };
    let samples = || samples.iter().enumerate();
    let points: Vec<Point> = samples()
        .map(|(index, sample)| level(sample).mark(&sample.error, in_window(index), ERROR))
        .collect();
    let floor = samples().filter_map(|(_, s)| Some((level(s).x, log10_abs(&s.floor)?)));
    let traces = [slope(&points, fit.order), trace(Stroke::Dotted, floor)];
    let curve = curve(legend("order", fit.order, fit.verdict), points, traces);
    let x = match levels {
        Some(_) => "segments n",
        None => "1/d, finer to the right",
    };
    let mut plot = Plot::new(title, Axis::log(x), Axis::log(ERROR)).keyed(key("fitted order"));
    plot.series.push(curve);
    plot
}

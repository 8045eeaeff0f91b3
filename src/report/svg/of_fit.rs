//! The panel of one set of samples with its fit.

use super::curve::{Curve, Mark, Panel, is_slope, legend, log10_abs, ticks};
use crate::convergence::{Fit, Sample};

/// The one panel of a fit.
pub(super) fn of_fit(samples: &[Sample], fit: &Fit) -> Panel {
    let levels: Option<Vec<u64>> = samples.iter().map(|s| s.n.filter(|&n| n > 0)).collect();
    let x = |sample: &Sample| match (&levels, sample.n) {
        (Some(_), Some(n)) => (n as f64).log2(),
        _ => -sample.step.log2(),
    };
    let marks = samples.iter().enumerate().map(|(index, sample)| {
        Some(Mark {
            x: x(sample),
            y: log10_abs(&sample.error)?,
            negative: sample.error.is_sign_negative(),
            fitted: fit
                .window
                .as_ref()
                .is_some_and(|w| (w.first..=w.last).contains(&index)),
        })
    });
    let floor = samples
        .iter()
        .filter_map(|s| Some((x(s), log10_abs(&s.floor)?)));
    let curve = Curve {
        color: 0,
        legend: legend("order", fit.order, fit.verdict),
        marks: marks.collect(),
        bias: Vec::new(),
        floor: floor.collect(),
        slope: fit.order.filter(|p| fit.window.is_some() && is_slope(*p)),
    };
    Panel {
        title: String::new(),
        x_label: if levels.is_some() {
            "segments n"
        } else {
            "step d, finer to the right"
        },
        y_label: "|error|",
        ticks: levels.as_deref().map(ticks).unwrap_or_default(),
        curves: vec![curve],
        models: Vec::new(),
        guide: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convergence::fit;
    use rug::Float;

    #[test]
    fn steps_that_do_not_divide_the_ray_stand_by_themselves() {
        let samples: Vec<Sample> = (0..5)
            .map(|i| Sample {
                n: None,
                step: 0.5 / f64::from(1 << i),
                error: Float::with_val(53, 0.25) >> (2 * i),
                floor: Float::new(53),
            })
            .collect();
        let panel = of_fit(&samples, &fit(&samples, None).unwrap());
        assert!(panel.ticks.is_empty() && panel.x_label.starts_with("step"));
        let xs: Vec<f64> = panel.curves[0].marks().map(|m| m.x).collect();
        assert_eq!(xs, [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert!(panel.curves[0].marks().all(|m| m.fitted));
    }
}

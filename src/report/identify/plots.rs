//! Weights and transmittances over the ray, where it ends, and opacities over the depth of a segment.

use crate::document::{Axis, Guide, Plot, Point, Series, Stroke, Trace};
use crate::identify::right_of;
use crate::identify::rule::Rule;

/// A line without points.
fn curve(name: &str, points: Vec<(f64, f64)>) -> Series {
    Series {
        traces: vec![Trace {
            stroke: Stroke::Solid,
            points,
        }],
        ..Series::line(name, [])
    }
}

/// Filled marks, with their values where they are pointed at.
fn marks(points: Vec<(f64, f64)>, what: &str) -> Series {
    let points = points.into_iter();
    let point = |(x, y): (f64, f64)| Point::new(x, y, format!("λ = {x}\n{what} = {y:.6}")).filled();
    Series::marks("the kernel", points.map(point).collect::<Vec<_>>())
}

/// The weights of a rule, and of the rule of the same places without faults; the transmittances of its samples; where the
/// ray ends.
pub(super) fn along(rule: &Rule) -> Vec<Plot> {
    let right = right_of(rule);
    let depth = rule.telling_depth();
    let end = rule.ends_at(depth).map(|at| Guide {
        upright: true,
        at,
        label: "the ray ends".into(),
    });
    let plot = |title: &str, y: &str| Plot::new(title, Axis::linear("λ"), Axis::linear(y));
    let mut weights = plot("Weights over the ray", "weight of C");
    weights.series = vec![
        curve("without faults", right.weights_along(depth)),
        marks(rule.weights_along(depth), "weight"),
    ];
    weights.guides.extend(end.clone());
    let used = rule.transmittances_along(depth);
    if used.is_empty() {
        return vec![weights];
    }
    let mut transmittances = plot("Transmittance in front of samples", "T");
    transmittances.series = vec![
        curve("without faults", right.transmittances_along(depth)),
        marks(used, "T"),
    ];
    transmittances.guides.extend(end);
    vec![weights, transmittances]
}

/// The largest opacity that is drawn.
const MOST: f64 = 1.5;

/// α and 1 − e^(−τd), and by how much they differ where they do; none of rules without one law.
pub(super) fn opacities(rule: &Rule) -> Vec<Plot> {
    let rows = rule.opacities();
    let right = rows.iter().map(|row| (row[0].log10(), row[2])).collect();
    // Opacities without bounds would leave nothing to see of the others.
    let rows: Vec<_> = rows
        .into_iter()
        .filter(|row| row[1].abs() <= MOST)
        .collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let points = |of: &dyn Fn(&[f64; 3]) -> f64| {
        let points = rows.iter().map(|row| {
            let (x, y) = (row[0], of(row));
            Point::new(x.log10(), y, format!("τd = {x:.3e}\n{y:.6e}")).filled()
        });
        points.collect::<Vec<_>>()
    };
    let axes = |title: &str, y: &str| Plot::new(title, Axis::log("τd"), Axis::linear(y));
    let mut both = axes("Opacity of a segment of length 1", "α");
    both.series = vec![
        curve("1 − e^(−τd)", right),
        Series::marks("the kernel", points(&|row| row[1])),
    ];
    let differs = rows.iter().any(|row| (row[1] - row[2]).abs() > 0.0);
    if !differs {
        return vec![both];
    }
    let mut deviation = axes("Deviation", "α − (1 − e^(−τd))");
    // In the kernel's colour.
    deviation.series = vec![Series::line("the kernel", points(&|row| row[1] - row[2])).colored(1)];
    vec![both, deviation]
}

//! Weights over the ray, and opacities over the depth of a segment.

use crate::document::{Axis, Plot, Point, Series};
use crate::identify::right_of;
use crate::identify::rule::Rule;

/// The weights of a rule, and of the rule of the same places without faults.
pub(super) fn weights(rule: &Rule) -> Plot {
    let mut plot = Plot::new(
        "Weights over the ray",
        Axis::linear("λ"),
        Axis::linear("weight of C"),
    );
    let points = |rule: &Rule| {
        let points = rule.weights_along().into_iter();
        points.map(|(x, y)| Point::new(x, y, format!("λ = {x}\nweight = {y:.6}")))
    };
    plot.series = vec![
        Series::line(
            "without faults",
            points(&right_of(rule)).collect::<Vec<_>>(),
        ),
        Series::marks("the kernel", points(rule).map(Point::filled)),
    ];
    plot
}

/// α and 1 − e^(−τd), and by how much they differ; none of rules without one law.
pub(super) fn opacities(rule: &Rule) -> Vec<Plot> {
    let rows = rule.opacities();
    if rows.is_empty() {
        return Vec::new();
    }
    let line = |name: &str, of: &dyn Fn(&[f64; 3]) -> f64| {
        let points = rows.iter().map(|row| {
            let (x, y) = (row[0], of(row));
            Point::new(x.log10(), y, format!("τd = {x:.3e}\n{y:.6e}"))
        });
        Series::line(name, points.collect::<Vec<_>>())
    };
    let axes = |title: &str, y: &str| Plot::new(title, Axis::log("τd"), Axis::linear(y));
    let mut both = axes("Opacity of a segment of length 1", "α");
    both.series = vec![
        line("1 − e^(−τd)", &|row| row[2]),
        line("the kernel", &|row| row[1]),
    ];
    let mut deviation = axes("Deviation", "α − (1 − e^(−τd))");
    deviation.series = vec![line("deviation", &|row| row[1] - row[2])];
    vec![both, deviation]
}

//! Samples that do not cover the ray, or whose number does not follow the step.

use super::deviation::Deviation;
use super::rule::{Along, Lattice};

/// In what a lattice deviates from one that covers the ray.
pub(super) fn deviations(lattice: &Lattice) -> Vec<Deviation> {
    let Lattice::Even {
        start, end, count, ..
    } = *lattice
    else {
        return Vec::new();
    };
    let deviation = |name, does: String, exact, value, instead: &str| Deviation {
        name,
        value,
        bracket: None,
        exact,
        probe: "emission as narrow hats along the ray",
        validated: Vec::new(),
        does,
        instead_of: Some(instead.into()),
    };
    let is_at =
        |along: Along, part: f64| (along.part - part).abs() <= 0.0 && along.length.abs() <= 0.0;
    let begins = (!is_at(start, 0.0)).then(|| {
        let does = format!("the march begins at λ = {start}");
        deviation("march-start", does, false, None, "0")
    });
    let ends = (!is_at(end, 1.0)).then(|| {
        let does = format!("the march ends at λ = {end}");
        deviation("march-end", does, false, None, "D")
    });
    let fixed = (count.each == 0).then(|| {
        let samples = count.of(1);
        let does = format!("{samples} samples are taken whatever the step");
        deviation("fixed-samples", does, true, Some(samples as f64), "D/d")
    });
    [begins, ends, fixed].into_iter().flatten().collect()
}

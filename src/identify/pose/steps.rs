//! Segments of one length.

use crate::identify::ray::Ray;

/// How a ray is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::identify) struct Steps {
    /// D.
    pub(in crate::identify) length: f64,
    /// d.
    pub(in crate::identify) step: f64,
    /// n.
    pub(in crate::identify) segments: usize,
}

impl Steps {
    pub(in crate::identify) fn of(ray: &Ray) -> Self {
        Steps {
            length: ray.segments.edges.lambda.last().copied().unwrap_or(0.0),
            step: ray.step,
            segments: ray.segments.count(),
        }
    }
}

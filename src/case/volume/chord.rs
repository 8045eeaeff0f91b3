//! Where a ray enters and leaves a box.

use crate::volume::Ray;

/// A part of a ray, from λ₀ to λ₁.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord {
    /// λ₀ ≥ 0: a camera inside the box sees what is in front of it.
    pub from: f64,
    /// λ₁ > λ₀.
    pub to: f64,
}

/// The part of a ray in the closed box between two corners, faces and edges with it; `None` where it misses it, or touches
/// it in a point.
#[must_use]
pub fn chord([low, high]: [[f64; 3]; 2], ray: &Ray) -> Option<Chord> {
    let (mut from, mut to) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
        if direction == 0.0 {
            // Along this slab: within it, its faces too, or nowhere.
            if origin < low[axis] || origin > high[axis] {
                return None;
            }
            continue;
        }
        let near = (low[axis] - origin) / direction;
        let far = (high[axis] - origin) / direction;
        from = from.max(near.min(far));
        to = to.min(near.max(far));
    }
    (from < to && to.is_finite()).then_some(Chord { from, to })
}

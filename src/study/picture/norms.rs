//! How far two pictures are apart.

use crate::image::Image;
use serde::Serialize;

/// Norms of a difference over pixels and channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Norms {
    /// The largest.
    pub max: f64,
    /// The mean of magnitudes.
    pub l1: f64,
    /// The root of the mean of squares.
    pub l2: f64,
    /// Values that are no finite number, which are left out.
    pub not_finite: usize,
    /// Values that there are.
    pub values: usize,
}

/// Norms over the pixels that are chosen; both pictures have the same size and channels.
#[must_use]
pub fn norms(one: &Image, other: &Image, chosen: impl Fn(usize) -> bool) -> Norms {
    let channels = one.channels.len().max(1);
    let mut norms = Norms::default();
    for (k, (a, b)) in one.values.iter().zip(&other.values).enumerate() {
        if !chosen(k / channels) {
            continue;
        }
        let off = (a - b).abs();
        if !off.is_finite() {
            norms.not_finite += 1;
            continue;
        }
        norms.values += 1;
        norms.max = norms.max.max(off);
        norms.l1 += off;
        norms.l2 += off * off;
    }
    let count = norms.values.max(1) as f64;
    norms.l1 /= count;
    norms.l2 = (norms.l2 / count).sqrt();
    norms
}

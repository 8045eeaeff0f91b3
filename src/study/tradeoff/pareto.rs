//! What nothing else beats in both cost and error.

use rug::Float;
use std::cmp::Ordering;

/// The indices of the points that no other beats: none is both at most as costly and at most as wrong, and better
/// in one of the two. From cheap to exact; of equals the first stands for all. Points without a finite cost and
/// error take no part.
#[must_use]
pub fn front(points: &[Option<(f64, Float)>]) -> Vec<usize> {
    let known = |(index, point): (usize, &Option<(f64, Float)>)| {
        let (cost, error) = point.as_ref()?;
        (cost.is_finite() && error.is_finite()).then(|| (index, *cost, error.clone()))
    };
    let mut sorted: Vec<(usize, f64, Float)> =
        points.iter().enumerate().filter_map(known).collect();
    sorted.sort_by(|(i, cost, error), (j, other_cost, other_error)| {
        cost.total_cmp(other_cost)
            .then(error.partial_cmp(other_error).unwrap_or(Ordering::Equal))
            .then(i.cmp(j))
    });
    let mut least: Option<Float> = None;
    let mut front = Vec::new();
    for (index, _, error) in sorted {
        if least.as_ref().is_none_or(|least| error < *least) {
            least = Some(error);
            front.push(index);
        }
    }
    front
}

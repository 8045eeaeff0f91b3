//! Paths without points that nobody would miss.

/// In pixels.
type Point = (f64, f64);

/// How far, in pixels, a path may move.
const TOLERANCE: f64 = 0.06;

/// The indices of the points that keep the path where it is (Ramer, Douglas and Peucker).
pub(super) fn thin(points: &[Point]) -> Vec<usize> {
    let Some(last) = points.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut kept = vec![false; points.len()];
    kept[0] = true;
    kept[last] = true;
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let between = points.get(from + 1..to).unwrap_or_default();
        let distances = between
            .iter()
            .map(|p| distance(*p, points[from], points[to]));
        let farthest = distances
            .enumerate()
            .max_by(|a, b| f64::total_cmp(&a.1, &b.1));
        if let Some((index, far)) = farthest
            && far > TOLERANCE
        {
            let middle = from + 1 + index;
            kept[middle] = true;
            open.extend([(from, middle), (middle, to)]);
        }
    }
    (0..points.len()).filter(|index| kept[*index]).collect()
}

/// From a point to a segment's line; to its beginning where it has no length.
fn distance(point: Point, from: Point, to: Point) -> f64 {
    let (along, across) = (to.0 - from.0, to.1 - from.1);
    let (x, y) = (point.0 - from.0, point.1 - from.1);
    let length = along.hypot(across);
    if length > 0.0 {
        (along * y - across * x).abs() / length
    } else {
        x.hypot(y)
    }
}

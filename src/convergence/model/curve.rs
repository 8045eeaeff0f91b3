//! A discretization error over the number of segments, measured and carried on.

/// The mean of log₂ n, and log₂ of the root mean square of the errors carried there by their order.
fn root_mean_square(points: &[&(f64, f64)], order: f64) -> (f64, f64) {
    let count = points.len() as f64;
    let mean = points.iter().map(|p| p.0).sum::<f64>() / count;
    let there: Vec<f64> = points.iter().map(|p| p.1 + order * (p.0 - mean)).collect();
    // The largest taken out, so that nothing overflows.
    let largest = there.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let squares = there.iter().map(|y| (2.0 * (y - largest)).exp2());
    (mean, largest + 0.5 * (squares.sum::<f64>() / count).log2())
}

/// log₂|e| over log₂ n: straight between levels that were measured, a power law beyond the finest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    /// (log₂ n, log₂|e|), n ascending; at least one, all finite.
    points: Vec<(f64, f64)>,
    /// The order beyond the finest level.
    order: f64,
}

impl Curve {
    /// `None` without a level whose error is neither 0 nor infinite. Levels within half an octave of each
    /// other stand for one by their root mean square: where a break of the medium lies in its segment, the
    /// error of a single n is luck.
    pub(super) fn new(points: &[(f64, f64)], order: Option<f64>) -> Option<Curve> {
        let finite = points.iter().filter(|p| p.0.is_finite() && p.1.is_finite());
        let octaves = finite.collect::<Vec<_>>();
        let octaves = octaves.chunk_by(|a, b| a.0.round().total_cmp(&b.0.round()).is_eq());
        let slope = order.unwrap_or(0.0);
        let points: Vec<(f64, f64)> = octaves.map(|o| root_mean_square(o, slope)).collect();
        let last_pair = match points[..] {
            [.., a, b] => Some((a.1 - b.1) / (b.0 - a.0)),
            _ => None,
        };
        let order = order.or(last_pair)?;
        (!points.is_empty() && order.is_finite()).then_some(Curve { points, order })
    }

    /// log₂ of the coarsest level.
    pub(super) fn first(&self) -> f64 {
        self.points.first().map_or(0.0, |p| p.0)
    }

    /// log₂|e| at log₂ n; at the coarsest level and below, what it is there.
    pub(super) fn at(&self, log2_n: f64) -> f64 {
        let after = self.points.partition_point(|p| p.0 < log2_n);
        match (
            after.checked_sub(1).map(|i| self.points[i]),
            self.points.get(after),
        ) {
            (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (log2_n - a.0) / (b.0 - a.0),
            (Some(last), None) => last.1 - self.order * (log2_n - last.0),
            (None, Some(first)) => first.1,
            (None, None) => f64::NEG_INFINITY,
        }
    }
}

//! Weighted least squares of a straight line.

/// y ≈ intercept + slope·x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Slope.
    pub slope: f64,
    /// The value at x = 0.
    pub intercept: f64,
    /// Standard error of the slope from the residuals; 0 for two points.
    pub slope_error: f64,
}

/// Fits a line to (x, y, weight); `None` for fewer than two points, or where the x do not differ.
#[must_use]
pub fn least_squares(points: &[(f64, f64, f64)]) -> Option<Line> {
    let total: f64 = points.iter().map(|p| p.2).sum();
    let mean_x = points.iter().map(|p| p.2 * p.0).sum::<f64>() / total;
    let mean_y = points.iter().map(|p| p.2 * p.1).sum::<f64>() / total;
    let sxx: f64 = points.iter().map(|p| p.2 * (p.0 - mean_x).powi(2)).sum();
    let sxy: f64 = points
        .iter()
        .map(|p| p.2 * (p.0 - mean_x) * (p.1 - mean_y))
        .sum();
    let slope = sxy / sxx;
    if points.len() < 2 || !slope.is_finite() {
        return None;
    }
    let residuals: f64 = points
        .iter()
        .map(|p| p.2 * (p.1 - mean_y - slope * (p.0 - mean_x)).powi(2))
        .sum();
    let freedom = points.len() - 2;
    let slope_error = if freedom == 0 {
        0.0
    } else {
        (residuals / freedom as f64 / sxx).sqrt()
    };
    Some(Line {
        slope,
        intercept: mean_y - slope * mean_x,
        slope_error,
    })
}

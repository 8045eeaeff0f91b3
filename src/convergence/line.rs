//! Weighted least squares of a straight line.

/// y ≈ intercept + slope·x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) slope: f64,
    pub(crate) intercept: f64,
    /// Standard error of the slope from the residuals; 0 for two points.
    pub(crate) slope_error: f64,
}

/// Fits a line to (x, y, weight); `None` for fewer than two points, or where the x do not differ.
pub(crate) fn least_squares(points: &[(f64, f64, f64)]) -> Option<Line> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slope_intercept_and_standard_error_of_a_worked_example() {
        // By hand: x̄ = 1.5, ȳ = 2.5, Sxx = 5, Sxy = 7; residuals 0.6, −0.8, −0.2, 0.4 minus signs:
        // Σr² = Syy − Sxy²/Sxx = 11 − 9.8 = 1.2, se = √(1.2 / 2 / 5).
        let line = least_squares(&[
            (0.0, 1.0, 1.0),
            (1.0, 1.0, 1.0),
            (2.0, 3.0, 1.0),
            (3.0, 5.0, 1.0),
        ])
        .unwrap();
        assert!((line.slope - 1.4).abs() < 1e-14);
        assert!((line.intercept - 0.4).abs() < 1e-14);
        assert!((line.slope_error - 0.12_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn three_points_leave_one_degree_of_freedom() {
        // Slope 0, residuals −1, 2, −1: se = √(6 / 1 / 2).
        let line = least_squares(&[(0.0, 0.0, 1.0), (1.0, 3.0, 1.0), (2.0, 0.0, 1.0)]).unwrap();
        assert!(line.slope.abs() < 1e-15 && (line.intercept - 1.0).abs() < 1e-15);
        assert!((line.slope_error - 3_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn a_weight_of_two_is_a_point_twice() {
        let twice = [
            (0.0, 1.0, 1.0),
            (1.0, 1.5, 1.0),
            (1.0, 1.5, 1.0),
            (2.0, 4.0, 1.0),
        ];
        let weighted = [(0.0, 1.0, 1.0), (1.0, 1.5, 2.0), (2.0, 4.0, 1.0)];
        let (a, b) = (
            least_squares(&twice).unwrap(),
            least_squares(&weighted).unwrap(),
        );
        assert!((a.slope - b.slope).abs() < 1e-14);
        assert!((a.intercept - b.intercept).abs() < 1e-14);
    }

    #[test]
    fn a_line_needs_two_different_points() {
        assert_eq!(least_squares(&[]), None);
        assert_eq!(least_squares(&[(1.0, 2.0, 1.0)]), None);
        assert_eq!(least_squares(&[(1.0, 2.0, 1.0), (1.0, 3.0, 1.0)]), None);
        let two = least_squares(&[(1.0, 2.0, 1.0), (2.0, 5.0, 1.0)]).unwrap();
        assert_eq!(
            (two.slope, two.intercept, two.slope_error),
            (3.0, -1.0, 0.0)
        );
    }
}

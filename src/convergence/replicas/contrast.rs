//! Contrasts: what a straight line or a bent one through points has for coefficients, as weights of the points.

/// Σ wᵢ yᵢ.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contrast {
    weights: Vec<f64>,
}

impl Contrast {
    /// The coefficient of `own` in the least-squares fit of a constant, of `others` and of `own`: that part of `own` which is
    /// orthogonal to all others, r, as r/(r·r). `None` where the others leave nothing of it.
    pub(super) fn of(own: &[f64], others: &[Vec<f64>]) -> Option<Contrast> {
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let constant = vec![1.0; own.len()];
        for column in std::iter::once(&constant).chain(others) {
            let rest = without(column, &basis)?;
            let size = dot(&rest, &rest).sqrt();
            basis.push(rest.into_iter().map(|x| x / size).collect());
        }
        let rest = without(own, &basis)?;
        let size = dot(&rest, &rest);
        let weights = rest.into_iter().map(|x| x / size).collect();
        Some(Contrast { weights })
    }

    /// The contrast of the last points of many.
    pub(super) fn value(&self, points: &[f64]) -> f64 {
        let last = points.len().saturating_sub(self.weights.len());
        dot(&self.weights, points.get(last..).unwrap_or_default())
    }

    /// √Σ wᵢ²: its standard deviation where points have one of 1.
    pub(super) fn norm(&self) -> f64 {
        dot(&self.weights, &self.weights).sqrt()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// What orthonormal columns leave of a column; `None` where that is rounding.
fn without(column: &[f64], basis: &[Vec<f64>]) -> Option<Vec<f64>> {
    let mut rest = column.to_vec();
    // Twice is enough: what rounding left of the first pass goes with the second.
    for unit in basis.iter().chain(basis) {
        let part = dot(&rest, unit);
        for (x, unit) in rest.iter_mut().zip(unit) {
            *x -= part * unit;
        }
    }
    let size = |x: &[f64]| dot(x, x).sqrt();
    (size(&rest) > 1e-9 * size(column)).then_some(rest)
}

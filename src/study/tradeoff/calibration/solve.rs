//! Costs, none below 0, from measured runs.

/// How much a cost's distance from what is known of it beforehand weighs, against one run's misfit.
const RIDGE: f64 = 0.01;
/// Rounds of coordinate descent: the problem is convex and small.
const ROUNDS: usize = 2000;
/// Changes below this share of a cost end it.
const SETTLED: f64 = 1e-9;

/// The costs c ≥ 0 that minimise Σᵢ ((aᵢ·c − tᵢ)/tᵢ)² + ρ Σₖ (cₖ/pₖ − 1)² for rows (a, t) and prior costs p > 0,
/// by descent along one coordinate after the other.
#[must_use]
pub fn costs(rows: &[(Vec<f64>, f64)], prior: &[f64]) -> Vec<f64> {
    let count = prior.len();
    // In units of the prior costs and of the rows' times.
    let scaled: Vec<Vec<f64>> = rows
        .iter()
        .map(|(a, t)| a.iter().zip(prior).map(|(a, p)| a * p / t).collect())
        .collect();
    let product = |j: usize, k: usize| -> f64 { scaled.iter().map(|row| row[j] * row[k]).sum() };
    let normal: Vec<Vec<f64>> = (0..count)
        .map(|j| {
            let ridge = |k: usize| if j == k { RIDGE } else { 0.0 };
            (0..count).map(|k| product(j, k) + ridge(k)).collect()
        })
        .collect();
    let right: Vec<f64> = (0..count)
        .map(|j| RIDGE + scaled.iter().map(|row| row[j]).sum::<f64>())
        .collect();
    let mut solution = vec![1.0; count];
    for _ in 0..ROUNDS {
        let mut change = 0.0_f64;
        for j in 0..count {
            let others: f64 = normal[j].iter().zip(&solution).map(|(a, u)| a * u).sum();
            let residual = right[j] - others;
            let next = (solution[j] + residual / normal[j][j]).max(0.0);
            change = change.max((next - solution[j]).abs());
            solution[j] = next;
        }
        if change < SETTLED {
            break;
        }
    }
    solution.iter().zip(prior).map(|(u, p)| u * p).collect()
}

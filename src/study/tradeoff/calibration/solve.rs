//! Costs, none below 0, from measured runs.

/// How much a cost's distance from what is known of it beforehand weighs, against one run's misfit.
const RIDGE: f64 = 0.01;
/// Rounds of coordinate descent: the problem is convex and small.
const ROUNDS: usize = 2000;
/// Changes below this share of a cost end it.
const SETTLED: f64 = 1e-9;

/// The costs c ≥ 0 that minimise Σᵢ ((aᵢ·c − tᵢ)/tᵢ)² + ρ Σₖ (cₖ/pₖ − 1)² for rows (a, t) and prior costs p > 0,
/// by descent along one coordinate after the other.
pub(super) fn costs(rows: &[(Vec<f64>, f64)], prior: &[f64]) -> Vec<f64> {
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

#[cfg(test)]
mod tests {
    use super::costs;

    #[test]
    fn costs_that_explain_all_runs_are_found() {
        let truth = [30.0, 40.0, 50.0];
        let rows: Vec<(Vec<f64>, f64)> = (1..40)
            .map(|i| {
                let a = [f64::from(i * i % 17), f64::from(i * 7 % 11), 1.0];
                let t = a.iter().zip(truth).map(|(a, c)| a * c).sum();
                (a.to_vec(), t)
            })
            .collect();
        let found = costs(&rows, &[20.0, 60.0, 70.0]);
        for (found, truth) in found.iter().zip(truth) {
            assert!((found / truth - 1.0).abs() < 0.02, "{found} for {truth}");
        }
    }

    #[test]
    fn no_cost_is_below_0() {
        // The second kind seems to save time.
        let rows = vec![
            (vec![1.0, 0.0], 10.0),
            (vec![1.0, 1.0], 5.0),
            (vec![1.0, 3.0], 4.0),
        ];
        let found = costs(&rows, &[8.0, 1.0]);
        assert!(found[0] > 0.0 && found[1] >= 0.0, "{found:?}");
        assert!(found[1] < 0.5, "{found:?}");
    }

    #[test]
    fn what_no_run_shows_stays_as_it_was_known() {
        let found = costs(&[(vec![2.0, 0.0], 8.0)], &[3.0, 7.0]);
        assert!((found[1] - 7.0).abs() < 1e-6, "{found:?}");
        assert!((found[0] - 4.0).abs() < 0.1, "{found:?}");
        assert_eq!(costs(&[], &[3.0]), [3.0]);
    }
}

//! Costs from runs made up of known ones.

use volver::inside::study::costs;

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

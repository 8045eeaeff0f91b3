//! Windows of pairwise orders, by hand.

use rug::Float;
use volver::convergence::{Sample, fit};

/// How many of these pairwise orders are in the window of a fit, and how closely they agree.
fn find(orders: &[f64]) -> Option<(usize, f64)> {
    let mut error = Float::with_val(100, 1);
    let mut samples = Vec::new();
    for level in 0..=orders.len() {
        samples.push(Sample {
            n: None,
            step: 0.5_f64.powi(i32::try_from(level).unwrap()),
            error: error.clone(),
            floor: Float::new(53),
        });
        let order = orders.get(level).copied().unwrap_or_default();
        error *= Float::with_val(100, -order).exp2();
    }
    let fit = fit(&samples, None).unwrap();
    fit.window.map(|w| (w.last - w.first, w.tolerance))
}

#[test]
fn the_tightest_tolerance_that_gives_four_levels_wins() {
    assert_eq!(find(&[5.0, 2.015, 1.99, 2.0]), Some((3, 0.02)));
    assert_eq!(find(&[1.96, 2.04, 1.99, 2.0]), Some((4, 0.05)));
    assert_eq!(find(&[2.09, 1.95, 2.0, 1.93, 2.0]), Some((5, 0.1)));
}

#[test]
fn a_window_has_four_levels_and_touches_the_fine_end() {
    assert_eq!(find(&[]), None);
    assert_eq!(find(&[2.0, 2.0]), None);
    assert_eq!(find(&[2.0, 2.0, 2.0]), Some((3, 0.02)));
    assert_eq!(find(&[2.0, 2.0, 2.0, 2.0, 2.5]), None);
}

#[test]
fn a_tight_window_is_not_widened() {
    assert_eq!(find(&[2.04, 2.0, 2.0, 2.0]), Some((3, 0.02)));
}

#[test]
fn monotone_drift_at_the_loosest_tolerance_is_no_plateau() {
    // A transition from 4 to 2 passes slowly: 3.85 3.81 3.78 3.76 would be a false plateau.
    assert_eq!(find(&[3.85, 3.80, 3.76]), None);
    assert_eq!(find(&[3.76, 3.80, 3.85]), None);
    // The same spread without a direction is scatter around a plateau.
    assert_eq!(find(&[3.80, 3.85, 3.76]), Some((3, 0.1)));
    // A drift that does not shrink leads anywhere, however small; one that does is on its way to an order.
    assert_eq!(find(&[3.80, 3.78, 3.76]), None);
    assert_eq!(find(&[3.80, 3.78, 3.77]), Some((3, 0.05)));
    assert_eq!(find(&[3.94, 3.80, 3.75]), Some((3, 0.25)));
}

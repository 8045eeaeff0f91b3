//! Straight lines fitted by hand.

use volver::inside::convergence::least_squares;

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

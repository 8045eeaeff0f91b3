//! Collocation against powers and a printed matrix.

use volver::quadrature::collocation;
use volver::real::{Format, Mpfr, Native, Real};

/// ∫₀^x uᵏ du = x^(k+1)/(k+1), at every point and over the whole.
#[test]
fn powers_are_integrated_exactly_up_to_their_degree() {
    for points in [1, 2, 3, 5, 8, 20] {
        let format = Mpfr { bits: 300 };
        let table = collocation(points, format).unwrap();
        for degree in 0..2 * points {
            let power = |x: &volver::real::MpfrReal, k: u32| {
                (0..k).fold(format.int(1), |product, _| product * x)
            };
            let values: Vec<_> = table.nodes.iter().map(|x| power(x, degree)).collect();
            let integral = |row: &[volver::real::MpfrReal]| {
                let terms = row.iter().zip(&values);
                terms.fold(format.int(0), |sum, (a, f)| sum + &(a.clone() * f))
            };
            let error = |found: volver::real::MpfrReal, x: &volver::real::MpfrReal| {
                let exact = power(x, degree + 1) / &format.int(i64::from(degree) + 1);
                (found - &exact).log2_abs()
            };
            assert!(error(integral(&table.weights), &format.int(1)) < -280.0);
            for (row, x) in table.integrals.iter().zip(&table.nodes) {
                let log = error(integral(row), x);
                assert_eq!(log < -280.0, degree < points, "{points}, {degree}: {log}");
            }
        }
    }
}

/// Hairer, Nørsett and Wanner, table 7.3: Kuntzmann and Butcher's method of order 4.
#[test]
fn two_points_give_the_matrix_of_the_literature() {
    let table = collocation(2, Native::<f64>::new()).unwrap();
    let s = 3_f64.sqrt() / 6.0;
    let printed = [[0.25, 0.25 - s], [0.25 + s, 0.25]];
    for (row, printed) in table.integrals.iter().zip(&printed) {
        for (a, b) in row.iter().zip(printed) {
            assert!((a - b).abs() < 1e-16, "{a} {b}");
        }
    }
    assert!(table.reach >= 0.5 + s && table.reach < 0.51 + s);
    assert!(collocation(0, Native::<f64>::new()).is_err());
}

//! Bounds of collocation, where they are known.

use volver::inside::study::plan::{bounds, nearest_polynomial};
use volver::symbolic::{Range, Taylor};

/// τ = 1 + u, C = 2 on |u| ≤ 1.
fn linear() -> (Taylor, Taylor) {
    let panel = Range::new(-1.0, 1.0);
    let u = Taylor::variable(panel, 1.0);
    let one = Taylor::constant(Range::point(1.0));
    let tau = volver::symbolic::taylor(
        &volver::symbolic::Program::new(&["1 + u".parse().unwrap()], &["u"]).unwrap(),
        &u,
        6,
    );
    let two = one.coefficient(0).plus(Range::point(1.0));
    (Taylor::constant(two), tau[0].clone())
}

#[test]
fn a_polynomial_of_the_degree_is_interpolated_without_error() {
    let (emission, extinction) = linear();
    let found = bounds(&emission, &extinction, 1.0, 6, 1.0);
    assert!(found.depth < 1e-300, "{found:?}");
    assert!(found.radiance > 0.0);
}

#[test]
fn what_is_unknown_is_bounded_by_its_values() {
    let wild = Taylor::unknown(6);
    let (emission, _) = linear();
    let found = bounds(&emission, &wild, 1.0, 6, 1.0);
    assert!(found.depth.is_infinite() && !found.radiance.is_finite());
}

/// 0 times an unbounded derivative is no number in binary64: nothing may be taken for certain because of it.
#[test]
fn what_does_not_shine_still_has_to_be_resolved() {
    let dark = Taylor::constant(Range::ZERO);
    let found = bounds(&dark, &Taylor::unknown(6), 1.0, 6, 1.0);
    assert_eq!(found.radiance, 0.0);
    assert!(found.depth.is_infinite());
}

#[test]
fn chebyshevs_bound_halves_with_every_degree() {
    // B_k = 1 for all k: degree 5 leaves 2^(1-6).
    assert!((nearest_polynomial(&[1.0; 7]) - 1.0 / 32.0).abs() < 1e-10);
    // B_0 alone: the polynomial 0.
    let unbounded = [0.5, f64::INFINITY, f64::INFINITY];
    assert!((nearest_polynomial(&unbounded) - 0.5).abs() < 1e-10);
}

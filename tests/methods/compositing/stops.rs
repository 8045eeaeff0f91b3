//! Where rays end.

use super::{compositing, orders, until};
use rug::Rational;
use volver::case::{Case, Fresh, HomogeneousSlab};
use volver::method::{
    CompositingOrder, Method, MethodError, OpacityFormula, Position, Stop, Threshold, expected,
};
use volver::real::Native;

/// T is e^(−j/4) in front of segment j.
fn slab() -> HomogeneousSlab {
    HomogeneousSlab {
        length: 8.into(),
        extinction: 1.into(),
        emission: 3.into(),
    }
}

fn by(order: CompositingOrder) -> volver::method::Compositing {
    compositing(Position::Middle, OpacityFormula::Expm1, order)
}

#[test]
fn a_ray_stops_where_the_transmittance_first_falls_below_the_threshold() {
    let slab = slab();
    let nodes = Fresh::new(&slab, Native::<f64>::new());
    for (numerator, denominator) in [(1, 255), (1, 2), (1, 10), (254, 255)] {
        let method = by(until(numerator, denominator));
        let whole = method.composite(&nodes, 32, Stop::AsDeclared).unwrap();
        let threshold = f64::from(numerator) / f64::from(denominator);
        // e^(−k/4) < threshold for the first time.
        let segments = (-threshold.ln() * 4.0).ceil();
        let stopped = whole.stopped.map(|count| count as f64);
        assert_eq!(stopped, Some(segments), "{method}");
        assert!(whole.transmittances.iter().all(|t| *t >= threshold));
        let expected = 3.0 * (1.0 - (-segments / 4.0).exp());
        assert!((whole.radiance / expected - 1.0).abs() < 1e-13, "{method}");
        assert_eq!(whole.radiance, method.radiance(&nodes, 32).unwrap());
        // What is left out is T times what lies behind.
        let never = method.composite(&nodes, 32, Stop::Never).unwrap();
        assert_eq!((never.stopped, never.transmittances.len()), (None, 32));
        let left_out = never.radiance - whole.radiance;
        assert!(left_out > 0.0 && left_out < 3.0 * threshold, "{method}");
    }
    // Below the threshold at the far end alone: nothing is left out, and nothing said to be.
    let method = by(until(1, 255));
    let short = method.composite(&nodes, 1, Stop::AsDeclared).unwrap();
    assert_eq!(short.stopped, None);
    // T = 1/2 exactly is not below 1/2.
    let medium = HomogeneousSlab {
        length: 2.into(),
        extinction: (1, 2).into(),
        emission: 1.into(),
    };
    let nodes = Fresh::new(&medium, Native::<f64>::new());
    let linear = compositing(Position::Front, OpacityFormula::Linear, until(1, 2));
    assert_eq!(
        linear
            .composite(&nodes, 2, Stop::AsDeclared)
            .unwrap()
            .stopped,
        None
    );
    let above = compositing(Position::Front, OpacityFormula::Linear, until(129, 256));
    assert_eq!(
        above
            .composite(&nodes, 2, Stop::AsDeclared)
            .unwrap()
            .stopped,
        Some(1)
    );
}

#[test]
fn any_order_composites_as_many_segments_as_it_is_told() {
    let slab = slab();
    let nodes = Fresh::new(&slab, Native::<f64>::new());
    let mut all = orders();
    // The count given counts, not the threshold.
    all.push(until(254, 255));
    for order in all {
        let method = by(order);
        for (count, stopped) in [
            (0, Some(0)),
            (1, Some(1)),
            (13, Some(13)),
            (32, None),
            (99, None),
        ] {
            let part = method.composite(&nodes, 32, Stop::After(count)).unwrap();
            assert_eq!(part.stopped, stopped, "{method}");
            let depth = count.min(32) as f64 / 4.0;
            let expected = 3.0 * (1.0 - (-depth).exp());
            assert!(
                (part.radiance - expected).abs() < 1e-13,
                "{method}, {count}"
            );
        }
    }
}

#[test]
fn no_segments_are_refused() {
    let slab = slab();
    let nodes = Fresh::new(&slab, Native::<f64>::new());
    for order in orders() {
        let method = by(order);
        let refused = Err(MethodError::Segments {
            rule: method.to_string(),
            n: 0,
            multiple: 1,
        });
        assert_eq!(Method::Composited(method).radiance(&nodes, 0), refused);
        let check = Method::Composited(method).check_segments(0);
        assert_eq!(check, refused.map(|_: f64| ()));
        assert_eq!(Method::Composited(method).check_segments(7), Ok(()));
        if let Some(under) = method.radiance_under(&nodes, 0, &[]) {
            assert!(under.is_err());
        }
    }
}

#[test]
fn thresholds_lie_between_0_and_1_in_lowest_terms() {
    for (numerator, denominator) in [(0, 1), (1, 1), (2, 1), (0, 0), (1, 0)] {
        assert_eq!(Threshold::new(numerator, denominator), None);
    }
    assert_eq!(Threshold::new(2, 510), Threshold::new(1, 255));
    let third = Threshold::new(3, 9).unwrap();
    assert_eq!(
        (third.to_string().as_str(), third.value()),
        ("1:3", Rational::from((1, 3)))
    );
}

#[test]
fn a_threshold_changes_no_order() {
    let case = volver::case::SineSquared;
    for position in super::POSITIONS {
        let order = |stop| {
            expected(
                &Method::Composited(compositing(position, OpacityFormula::Relative, stop)),
                &case,
            )
        };
        assert_eq!(order(until(1, 255)), order(CompositingOrder::Tree));
    }
    assert!(case.structure().breaks.is_empty());
}

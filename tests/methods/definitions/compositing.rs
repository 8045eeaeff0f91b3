//! Compositing with linear opacities: + − × alone, so that every order gives the very same rational.

use super::exact::{Exact, Number};
use super::plain::{Ramp, q};
use rug::Rational;
use volver::case::{Case, Fresh};
use volver::method::{
    Accumulation, Compositing, CompositingOrder, OpacityFormula, Position, Stop, Summation,
    Threshold,
};

fn ramp() -> Ramp {
    Ramp {
        length: q(3, 2),
        extinction: [q(4, 3), q(1, 1), q(2, 5)],
    }
}

fn front_to_back(summation: Summation, stop: Option<Threshold>) -> CompositingOrder {
    CompositingOrder::FrontToBack {
        depth: Accumulation::Transmittances,
        summation,
        stop,
    }
}

fn linear(position: Position, order: CompositingOrder) -> Compositing {
    Compositing {
        position,
        opacity: OpacityFormula::Linear,
        order,
    }
}

/// Σ C τ d ∏ (1 − τ d), each product anew, over the first `count` of n segments.
fn by_definition(offset: &Rational, n: u64, count: u64) -> Rational {
    let step = Rational::from(&ramp().length / n);
    let sample = |j: u64| {
        let place = Number(Rational::from(offset + j) * &step);
        let transfer = ramp().transfer(&ramp().field(&place));
        (transfer.emission.0, transfer.extinction.0 * &step)
    };
    let mut sum = Rational::new();
    for j in 0..count {
        let mut term = Rational::from(1);
        for k in 0..j {
            term *= 1 - sample(k).1;
        }
        let (emission, alpha) = sample(j);
        sum += term * emission * alpha;
    }
    sum
}

#[test]
fn every_order_is_the_definition_exactly() {
    let ramp = ramp();
    let nodes = Fresh::new(&ramp, Exact);
    for (position, offset) in [
        (Position::Front, q(0, 1)),
        (Position::Middle, q(1, 2)),
        (Position::Back, q(1, 1)),
    ] {
        for n in [1, 2, 3, 4, 7, 8, 13] {
            for count in [n, n / 2] {
                let expected = by_definition(&offset, n, count);
                let mut orders = vec![CompositingOrder::BackToFront, CompositingOrder::Tree];
                orders.extend(
                    [Summation::Naive, Summation::Pairwise, Summation::Neumaier]
                        .map(|summation| front_to_back(summation, None)),
                );
                for order in orders {
                    let method = linear(position, order);
                    let part = method.composite(&nodes, n, Stop::After(count)).unwrap();
                    assert!(part.radiance.0 == expected, "{method}, {count} of {n}");
                }
            }
        }
    }
}

/// On two segments of depth ½ (τ = 1, D = 1), worked by hand with C = 2 and 3/2 at the fronts.
#[test]
fn values_worked_by_hand() {
    let ramp = Ramp {
        length: q(1, 1),
        extinction: [q(1, 1), q(0, 1), q(0, 1)],
    };
    let nodes = Fresh::new(&ramp, Exact);
    for (position, expected) in [
        // 2 · ½ + 3/2 · ½ · ½
        (Position::Front, q(11, 8)),
        // 7/4 · ½ + 5/4 · ½ · ½
        (Position::Middle, q(19, 16)),
        // 3/2 · ½ + 1 · ½ · ½
        (Position::Back, q(1, 1)),
    ] {
        let method = linear(position, CompositingOrder::Tree);
        assert_eq!(method.radiance(&nodes, 2).unwrap().0, expected);
    }
    let stopped = linear(
        Position::Back,
        front_to_back(Summation::Pairwise, Threshold::new(2, 3)),
    );
    let whole = stopped.composite(&nodes, 2, Stop::AsDeclared).unwrap();
    assert_eq!((whole.radiance.0, whole.stopped), (q(3, 4), Some(1)));
    let transmittances: Vec<_> = whole.transmittances.into_iter().map(|t| t.0).collect();
    assert_eq!(transmittances, [q(1, 1)]);
}

//! What is the same in exact arithmetic is the same to a hundred digits, and what is not is not.

use super::{
    EXACT_OPACITIES, POSITIONS, case, compositing, decimal, front_to_back, orders,
    orders_of_opacities, relative, slab,
};
use rug::Float;
use volver::case::{Case, Fresh, SineSquared};
use volver::method::{
    Accumulation, Compositing, CompositingOrder, OpacityFormula, Position, Stop, Summation,
};
use volver::real::{Format, Mpfr, Native};

fn at<C: Case>(method: Compositing, case: &C, n: u64, bits: u32) -> Float {
    let nodes = Fresh::new(case, Mpfr { bits });
    method.radiance(&nodes, n).unwrap().into()
}

const REFERENCE: CompositingOrder = CompositingOrder::BackToFront;

fn variants_agree<C: Case>(case: &C, n: u64) {
    for position in POSITIONS {
        let exact = at(
            compositing(position, OpacityFormula::Expm1, REFERENCE),
            case,
            n,
            400,
        );
        for opacity in EXACT_OPACITIES {
            for order in orders() {
                let method = compositing(position, opacity, order);
                let off = relative(&at(method, case, n, 400), &exact);
                assert!(off < decimal("1e-110"), "{method}: {off}");
            }
        }
        let linear = at(
            compositing(position, OpacityFormula::Linear, REFERENCE),
            case,
            n,
            400,
        );
        assert!(relative(&linear, &exact) > decimal("1e-4"), "{position}");
        for order in orders_of_opacities() {
            let method = compositing(position, OpacityFormula::Linear, order);
            let off = relative(&at(method, case, n, 400), &linear);
            assert!(off < decimal("1e-110"), "{method}: {off}");
        }
        let depths = front_to_back(Accumulation::Depths, Summation::Naive);
        let by_depths = at(
            compositing(position, OpacityFormula::Linear, depths),
            case,
            n,
            400,
        );
        assert!(
            relative(&by_depths, &linear) > decimal("1e-4"),
            "{position}"
        );
        assert!(relative(&by_depths, &exact) > decimal("1e-4"), "{position}");
    }
}

#[test]
fn variants_of_one_position_and_family_are_one_approximation() {
    // An odd number, so that the trees' halves differ.
    variants_agree(&SineSquared, 37);
    variants_agree(&case("atmosphere"), 64);
    variants_agree(&case("thick"), 101);
    for n in [3, 4, 5] {
        variants_agree(&SineSquared, n);
    }
}

/// Σ C (1 − e^(−τ d)) e^(−Σ τ d) by hand, in binary64.
#[test]
fn samples_lie_where_the_position_says() {
    let (n, format) = (10_u32, Native::<f64>::new());
    for (position, offset) in [
        (Position::Front, 0.0),
        (Position::Middle, 0.5),
        (Position::Back, 1.0),
    ] {
        let (mut depth, mut sum) = (0.0_f64, 0.0);
        for j in 0..n {
            let at = SineSquared.transfer(&SineSquared.field(&((f64::from(j) + offset) / 10.0)));
            let x = at.extinction / 10.0;
            sum += at.emission * (1.0 - (-x).exp()) * (-depth).exp();
            depth += x;
        }
        let nodes = Fresh::new(&SineSquared, format);
        for order in orders() {
            let method = compositing(position, OpacityFormula::Expm1, order);
            let radiance = method.radiance(&nodes, n.into()).unwrap();
            assert!((radiance / sum - 1.0).abs() < 1e-13, "{method}");
        }
    }
}

/// A constant medium is the same however it is cut.
#[test]
fn a_slab_is_exact_to_the_precision_given() {
    let length = |bits| Mpfr { bits }.ratio(&slab().length());
    let exact: Float = slab().radiance(&length(1000)).unwrap().into();
    for position in POSITIONS {
        for opacity in EXACT_OPACITIES {
            for order in orders() {
                let method = compositing(position, opacity, order);
                let error = |bits| relative(&at(method, &slab(), 100, bits), &exact);
                assert!(error(400) < decimal("1e-110"), "{method}");
                let bound = decimal("1e-60");
                assert!(
                    error(53) > bound && error(53) < decimal("1e-12"),
                    "{method}"
                );
            }
        }
        let linear = compositing(position, OpacityFormula::Linear, REFERENCE);
        assert!(relative(&at(linear, &slab(), 100, 400), &exact) > decimal("1e-4"));
    }
}

/// With its own transmittances from outside a method gives its own radiance; with others, another.
#[test]
fn transmittances_from_outside_take_the_place_of_a_method_s_own() {
    let nodes = Fresh::new(&SineSquared, Native::<f32>::new());
    for order in orders() {
        let method = compositing(Position::Middle, OpacityFormula::Expm1, order);
        let whole = method.composite(&nodes, 25, Stop::AsDeclared).unwrap();
        assert_eq!(
            whole.radiance,
            method.radiance(&nodes, 25).unwrap(),
            "{method}"
        );
        let under = |t: &[f32]| method.radiance_under(&nodes, 25, t).map(Result::unwrap);
        if !matches!(order, CompositingOrder::FrontToBack { .. }) {
            assert!(whole.transmittances.is_empty() && under(&[1.0]).is_none());
            continue;
        }
        assert_eq!(whole.transmittances.len(), 25);
        assert_eq!(whole.transmittances[0], 1.0);
        assert!(whole.transmittances.is_sorted_by(|a, b| a > b));
        assert_eq!(
            under(&whole.transmittances),
            Some(whole.radiance),
            "{method}"
        );
        let first = method.composite(&nodes, 25, Stop::After(7)).unwrap();
        assert_eq!(under(&whole.transmittances[..7]), Some(first.radiance));
        // Halving is exact in binary, whatever is summed how.
        let halves: Vec<f32> = whole.transmittances.iter().map(|t| t / 2.0).collect();
        assert_eq!(under(&halves), Some(whole.radiance / 2.0), "{method}");
    }
}

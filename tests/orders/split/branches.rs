//! Runs that go another way than the same code in MPFR.

use half::bf16;
use volver::case::manufacture::manufacture;
use volver::case::{Description, Shared, SymbolicCase};
use volver::convergence::{Cell, Oracle};
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::{Rule, Sampling};
use volver::real::{Mpfr, Native};

fn nested(inner: Inner, outer: Rule) -> Method {
    Method::Nested(Nested {
        inner,
        outer: Outer(outer),
        exponential: Exponential::Exact,
        scope: Scope::Whole,
    })
}

fn rules(inner: Rule, outer: Rule) -> Method {
    nested(Inner::PerSegment(inner), outer)
}

/// A medium that jumps between 1/3 and the number of bfloat16 next to it: there the two formats stand on
/// different sides.
fn jump() -> SymbolicCase {
    // 1/3 = 0.333…, of 8 bits 0.333984375.
    let place = "33357/100000";
    let text = format!(
        "name = \"jump\"\nlength = 1\n\
         depth = \"lambda + max(0, lambda - {place})\"\nemission_of_depth = \"1\"\n"
    );
    manufacture(&Description::read(&text).unwrap())
        .unwrap()
        .remove(0)
        .case
}

fn cells(case: &SymbolicCase, methods: &[Method], n: u64) -> Vec<Cell> {
    let nodes = Shared::new(case, Native::<bf16>::new());
    let oracle = Oracle::new(case, methods);
    oracle
        .split(&nodes, n)
        .unwrap()
        .into_iter()
        .map(Result::unwrap)
        .collect()
}

#[test]
fn a_node_on_the_other_side_of_a_jump_is_not_split() {
    let case = jump();
    let methods = [
        rules(Rule::Trapezoid, Rule::Trapezoid),
        // Looks at 1/6, 1/2 and 5/6 alone, where nothing is near.
        rules(Rule::Midpoint, Rule::RiemannLeft),
    ];
    for cell in cells(&case, &methods[..1], 3) {
        let Cell::BranchDiverged { total } = cell else {
            panic!("{cell:?}");
        };
        assert!(total.is_finite() && !total.is_zero());
    }
    // With four segments nobody looks near the jump.
    for cell in cells(&case, &methods, 4) {
        assert!(cell.split().is_some(), "{cell:?}");
    }
    // Each method by itself: what diverges for one is no matter for another.
    let separately = cells(
        &case,
        &[methods[0], rules(Rule::Midpoint, Rule::Midpoint)],
        3,
    );
    assert!(matches!(separately[0], Cell::BranchDiverged { .. }));
    assert!(separately[1].split().is_some(), "{:?}", separately[1]);
}

/// In a format with enough bits the same node is on the right side.
#[test]
fn enough_bits_stand_on_the_right_side() {
    let case = jump();
    let nodes = Shared::new(&case, Mpfr { bits: 30 });
    let oracle = Oracle::new(&case, &[rules(Rule::Trapezoid, Rule::Trapezoid)]);
    let cell = oracle.split(&nodes, 3).unwrap().remove(0).unwrap();
    assert!(cell.split().is_some(), "{cell:?}");
}

/// Random places are recorded in their order, whichever rule asks for them.
#[test]
fn random_samples_are_replayed_in_their_order() {
    let case = super::random_case(3);
    let monte_carlo = |sampling| Inner::MonteCarlo { sampling, seed: 5 };
    let methods = [
        nested(monte_carlo(Sampling::Shared), Rule::Trapezoid),
        nested(monte_carlo(Sampling::Stratified), Rule::GaussLegendre(2)),
        nested(monte_carlo(Sampling::Independent), Rule::Midpoint),
    ];
    let nodes = Shared::new(&case, Native::<f32>::new());
    let oracle = Oracle::new(&case, &methods);
    for (cell, method) in oracle.split(&nodes, 32).unwrap().into_iter().zip(methods) {
        let cell = cell.unwrap();
        let split = cell.split().unwrap_or_else(|| panic!("{method}: {cell:?}"));
        // Sampling scatters by some 10⁻², binary32 by 10⁻⁷: an input of another place would be of the
        // former size.
        for part in [&split.input, &split.arithmetic] {
            assert!(part.to_f64().abs() < 1e-5, "{method}: {part}");
        }
        assert!(split.discretization.to_f64().abs() > 1e-4);
    }
}

/// Two formats do not mean the very same irrational offset; they mean the same node.
#[test]
fn gauss_nodes_of_two_precisions_are_the_same_nodes() {
    let case = super::random_case(8);
    let method = rules(Rule::GaussLegendre(3), Rule::GaussLegendre(2));
    let nodes = Shared::new(&case, Native::<f64>::new());
    let before = {
        method.radiance(&nodes, 16).unwrap();
        nodes.evaluations()
    };
    let oracle = Oracle::new(&case, &[method]);
    let cell = oracle.split(&nodes, 16).unwrap().remove(0).unwrap();
    // The replay has looked nothing up that the run had not.
    assert_eq!(nodes.evaluations(), before);
    let split = cell.split().unwrap();
    for part in [&split.input, &split.arithmetic] {
        assert!(part.to_f64().abs() < 1e-14, "{part}");
    }
    assert!(!split.arithmetic.is_zero());
}

//! Rays that end early: what is cut off is a part of its own.

use rug::Float;
use volver::case::manufacture::manufacture;
use volver::case::{Shared, SymbolicCase, catalogue};
use volver::convergence::{Cell, Oracle, Split};
use volver::method::Method;
use volver::real::{Format, Native};

/// Of optical depth far beyond what a threshold of 1/255 lets through.
fn thick() -> SymbolicCase {
    let description = catalogue::find("thick").unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

fn split<F: Format>(case: &SymbolicCase, names: &[&str], format: F, n: u64) -> Vec<Cell> {
    let methods: Vec<Method> = names.iter().map(|name| name.parse().unwrap()).collect();
    let oracle = Oracle::new(case, &methods);
    let nodes = Shared::new(case, format);
    let cells = oracle.split(&nodes, n).unwrap();
    cells.into_iter().map(Result::unwrap).collect()
}

#[test]
fn what_is_cut_off_is_truncation_and_not_discretization() {
    let case = thick();
    let names = [
        "front-to-back/middle/expm1",
        "front-to-back/middle/expm1/stop=1:255",
        "front-to-back/middle/expm1/stop=1:1000000000",
    ];
    for n in [64, 512, 4096] {
        let cells = split(&case, &names, Native::<f64>::new(), n);
        let splits: Vec<&Split> = cells.iter().map(|cell| cell.split().unwrap()).collect();
        let [whole, early, late] = splits[..] else {
            unreachable!()
        };
        assert!(whole.truncation.is_zero());
        assert_eq!(whole.discretization, early.discretization);
        assert_eq!(whole.discretization, late.discretization);
        // At most the threshold times the largest C behind, and not much less in so thick a medium.
        let of = |split: &Split| split.truncation.to_f64();
        assert!(
            of(early) < -1e-5 && of(early) > -10.0 / 255.0,
            "{}",
            of(early)
        );
        assert!(of(late).abs() < of(early).abs() / 1e4, "{}", of(late));
        for split in [whole, early, late] {
            // The replay ends where the run did: otherwise what was cut off would be here, and back there.
            for part in [&split.input, &split.arithmetic] {
                assert!(part.to_f64().abs() < 1e-11, "{part}");
            }
            let sum = Float::with_val(
                300,
                Float::sum(
                    [
                        &split.discretization,
                        &split.truncation,
                        &split.input,
                        &split.arithmetic,
                    ]
                    .into_iter(),
                ),
            );
            let gap = Float::with_val(300, sum - &split.total).abs();
            assert!(gap <= split.resolution, "{gap}");
        }
    }
}

/// T passes the threshold within a rounding of it: the format stops one segment earlier or later than MPFR does.
#[test]
fn a_format_that_stops_elsewhere_is_not_split() {
    let case = thick();
    let name = ["front-to-back/middle/subtraction/stop=1:255"];
    let diverged = (100..400).filter(|n| {
        let cell = split(&case, &name, Native::<half::bf16>::new(), *n).remove(0);
        matches!(cell, Cell::BranchDiverged { .. })
    });
    let diverged = diverged.count();
    // Of 8 bits and some hundred factors T is known to some percent, a few segments.
    assert!(diverged > 20, "{diverged} of 300");
}

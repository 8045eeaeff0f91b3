//! What runs of many segments do, from runs of few.

use volver::case::manufacture::manufacture;
use volver::case::{Case, CountedCase, Fresh, SymbolicCase, catalogue};
use volver::inside::study::counts;
use volver::method::Method;
use volver::real::counted::{Counted, count};
use volver::real::{Counts, Mpfr};
use volver::study::tradeoff::METHODS;

fn case(name: &str) -> SymbolicCase {
    let made = manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap();
    made.into_iter().next().unwrap().case
}

/// Every operation of that run.
fn one_by_one(case: &SymbolicCase, bits: u32, method: &Method, n: u64) -> Counts {
    let case = CountedCase(case);
    let nodes = Fresh::new(&case, Counted(Mpfr { bits }));
    count(|| method.radiance(&nodes, n).is_ok()).1
}

#[test]
fn counts_carried_on_are_those_of_the_run() {
    for name in ["sine-squared", "jump-off-node"] {
        let case = case(name);
        for method in METHODS {
            let method: Method = method.parse().unwrap();
            for (bits, n) in [(53, 1000), (113, 317)] {
                let fits = method.radiance(&Fresh::new(&case, Mpfr { bits }), n);
                if fits.is_ok() {
                    let found = counts(&case, bits, &method, n);
                    let expected = one_by_one(&case, bits, &method, n);
                    assert_eq!(found, expected, "{method} on {}, n = {n}", case.name());
                }
            }
        }
    }
}

#[test]
fn a_run_too_long_to_be_made_is_counted() {
    // Its operations one by one would take days.
    let method: Method = "front-to-back/middle/expm1".parse().unwrap();
    let found = counts(&case("sine-squared"), 53, &method, 1 << 40);
    assert_eq!(found.evaluations(), 1 << 40);
}

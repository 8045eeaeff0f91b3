//! Orders on the whole catalogue.

use super::{POSITIONS, compositing, front_to_back, made, slab};
use volver::case::{Case, HomogeneousSlab, SymbolicCase, catalogue};
use volver::convergence::{Verdict, fit};
use volver::method::{
    Accumulation, CompositingOrder, Expected, Method, OpacityFormula, Position, Summation,
    expected, expected_on,
};
use volver::real::Mpfr;
use volver::study::{Run, Silent, samples};

const LADDER: [u64; 9] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048];

fn methods() -> Vec<Method> {
    let depths = front_to_back(Accumulation::Depths, Summation::Naive);
    let families = [
        (OpacityFormula::Expm1, CompositingOrder::Tree),
        (OpacityFormula::Linear, CompositingOrder::BackToFront),
        (OpacityFormula::Linear, depths),
    ];
    let each = |position| {
        families.map(|(opacity, order)| Method::Composited(compositing(position, opacity, order)))
    };
    POSITIONS.into_iter().flat_map(each).collect()
}

#[test]
fn survey() {
    for name in catalogue::names() {
        for case in made(name) {
            let methods = methods();
            let run = Run::new(&case, Mpfr { bits: 200 }, &methods, &LADDER, &Silent).unwrap();
            for (m, method) in methods.iter().enumerate() {
                let theory = expected_on(method, &case, &LADDER);
                let fit = fit(&samples(&case, &run, m, None), Some(theory)).unwrap();
                if !fit.verdict.passes(Some(theory)) {
                    let orders: Vec<String> = fit
                        .pairs
                        .iter()
                        .map(|p| format!("{:.2}", p.order))
                        .collect();
                    println!(
                        "{} {method}: {theory:?} {} {}",
                        case.name(),
                        fit.verdict,
                        orders.join(" ")
                    );
                }
            }
        }
    }
}

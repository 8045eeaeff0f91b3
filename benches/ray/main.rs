//! One ray in binary64 beside the same in C: a medium that is compiled in, and one by formulas as files have it.
//!
//! `ray.c` is compiled here by `cc -O3 -march=native`. Answers are compared first; then all are timed in turn, by the
//! processor's clock of this thread.

#![allow(missing_docs, unsafe_code, clippy::expect_used)]

use volver::case::manufacture::manufacture;
use volver::case::{AnyNodes, Case, Fresh, SineSquared, catalogue};
use volver::method::Method;
use volver::real::Native;
use volver_benches::{Compared, compiled, seconds};

const SEGMENTS: u64 = 1 << 20;
/// Sums of as many terms in another order.
const SAME: f64 = 1e-12;

const METHODS: [(&str, &str); 4] = [
    ("trapezoid", "trapezoid/trapezoid"),
    ("front_to_back", "front-to-back/middle/expm1"),
    ("back_to_front", "back-to-front/middle/expm1"),
    ("gauss_boole", "gauss-3/boole"),
];

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    let library = compiled("ray/ray.c", folder.path());
    let description = catalogue::find("sine-squared").expect("a case");
    let made = manufacture(&description.expect("a case")).expect("a case");
    let symbolic = &made.first().expect("a channel").case;
    println!("medium     method                      ms      C ms  ratio (quartiles)");
    for (name, method) in METHODS {
        let method: Method = method.parse().expect("a method");
        // SAFETY: ray.c has a function of that name and type, and `library` outlives it.
        let in_c = unsafe { library.get::<extern "C" fn(usize) -> f64>(name.as_bytes()) };
        let in_c = in_c.expect("a function of ray.c");
        let in_c = || in_c(usize::try_from(SEGMENTS).expect("a size"));
        compare("compiled", &method, || of_case(&method, &SineSquared), in_c);
        compare("formulas", &method, || of_case(&method, symbolic), in_c);
    }
}

/// The radiance as the library gives it to whoever has a case.
fn of_case<C: Case>(method: &Method, case: &C) -> f64 {
    let nodes = Fresh::new(case, Native::<f64>::new());
    match method {
        Method::Nested(nested) => nested.radiance(&nodes, SEGMENTS),
        Method::Composited(compositing) => compositing.radiance(&nodes, SEGMENTS),
        _ => method.stream(AnyNodes::new(&nodes), SEGMENTS),
    }
    .expect("a radiance")
}

fn compare(medium: &str, method: &Method, ours: impl Fn() -> f64, theirs: impl Fn() -> f64) {
    let (own, other) = (ours(), theirs());
    assert!(
        (own - other).abs() <= SAME * other.abs(),
        "{method}: {own} and {other}"
    );
    let Compared { own, other, ratio } = Compared::new(|| seconds(&ours), || seconds(&theirs));
    let [low, ratio, high] = ratio;
    println!(
        "{medium:10} {:26} {:7.2} {:9.2}  {ratio:5.2} ({low:.2} to {high:.2})",
        method.name(),
        own * 1e3,
        other * 1e3,
    );
}

//! Counting changes no bit, and counts what the methods do: derived by hand here, from their formulas.

use half::f16;
use quickcheck::QuickCheck;
use std::sync::LazyLock;
use volver::case::manufacture::manufacture;
use volver::case::{Case, CountedCase, Fresh, SineSquared, SymbolicCase, catalogue};
use volver::method::Method;
use volver::real::counted::{Counted, Counts, Kind, count};
use volver::real::{Format, Ieee, Mpfr, Native, Real};

/// One of each family, and what uses other code within it.
const METHODS: [&str; 16] = [
    "riemann-left/riemann-left",
    "riemann-right/trapezoid/exact-per-segment",
    "trapezoid/trapezoid",
    "trapezoid/simpson/cubic",
    "simpson/simpson",
    "boole/boole",
    "gauss-2/gauss-2",
    "midpoint/midpoint/linear",
    "simpson-pairs-parabola/trapezoid",
    "monte-carlo@7/trapezoid",
    "front-to-back/front/subtraction",
    "front-to-back/middle/expm1/neumaier",
    "front-to-back/middle/relative/depths/pairwise/stop=1:255",
    "back-to-front/back/linear",
    "tree/middle/expm1",
    "preintegrated/quadratic-midpoint-by-4-simpson/linear-by-2-boole",
];

fn symbolic(name: &str) -> SymbolicCase {
    let description = catalogue::find(name).unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

fn method(name: &str) -> Method {
    name.parse().unwrap()
}

fn counts<C: Case, F: Format>(case: &C, format: F, method: &Method, n: u64) -> Counts {
    let case = CountedCase(case);
    let nodes = Fresh::new(&case, Counted(format));
    let (radiance, counts) = count(|| method.radiance(&nodes, n));
    radiance.unwrap();
    counts
}

/// Whether the radiance has the same bits, counted or not, and the same error where there is none.
fn unchanged<C: Case, F: Format>(case: &C, format: F, method: &Method, n: u64) -> bool {
    let plain = method.radiance(&Fresh::new(case, format), n);
    let counted = method.radiance(&Fresh::new(&CountedCase(case), Counted(format)), n);
    match (plain, counted) {
        (Ok(plain), Ok(counted)) => {
            let counted = counted.into_inner();
            plain.is_finite() == counted.is_finite()
                && plain.to_rational() == counted.to_rational()
                && plain.to_string() == counted.to_string()
        }
        (Err(plain), Err(counted)) => plain == counted,
        _ => false,
    }
}

static MEDIA: LazyLock<[SymbolicCase; 2]> =
    LazyLock::new(|| ["faint", "jump-off-node"].map(symbolic));

fn unchanged_everywhere(which: usize, n: u64) -> bool {
    let method = method(METHODS[which % METHODS.len()]);
    let n = 1 + n % 40;
    let [faint, jump] = &*MEDIA;
    macro_rules! all {
        ($($format:expr),*) => {
            $(unchanged(&SineSquared, $format, &method, n)
                && unchanged(faint, $format, &method, n)
                && unchanged(jump, $format, &method, n))&&*
        };
    }
    all!(
        Native::<f16>::new(),
        Native::<f32>::new(),
        Native::<f64>::new(),
        Ieee::TF32,
        Mpfr { bits: 113 }
    )
}

#[test]
fn counting_changes_no_bit() {
    QuickCheck::new()
        .tests(60)
        .quickcheck(unchanged_everywhere as fn(usize, u64) -> bool);
}

/// Of sin λ² under the methods below at P places: s is a copy of λ; s² is a copy and a product, τ = s cos s²
/// another product.
fn medium(places: u64) -> Counts {
    Counts::of(Kind::Fraction, places)
        + Counts::of(Kind::Field, places)
        + Counts::of(Kind::Transfer, places)
        + Counts::of(Kind::SineCosine, places)
        + Counts::of(Kind::Multiplication, 2 * places)
        + Counts::of(Kind::Copy, 2 * places)
}

/// What all marching shares, over n + 1 places: T = exp(−t), the terms ((C τ) T) W and their sum, t summed over
/// n segments, and both sums in units of d.
fn marching(n: u64) -> Counts {
    let places = n + 1;
    medium(places)
        // 0 for t and for I.
        + Counts::of(Kind::Integer, 2)
        // W at the front, between and at the back, and d.
        + Counts::of(Kind::Constant, 4)
        // ½, for rules that need it.
        + Counts::of(Kind::Fraction, 1)
        + Counts::of(Kind::Negation, places)
        + Counts::of(Kind::Exponential, places)
        + Counts::of(Kind::Multiplication, 3 * places + n + 1)
        + Counts::of(Kind::Addition, places + n)
        // t, for −t, and τ at the front of the ray.
        + Counts::of(Kind::Copy, places + 1)
}

/// The mean (τ₀ + τ₁)/2 of n segments.
fn means(n: u64) -> Counts {
    Counts::of(Kind::Multiplication, 2 * n)
        + Counts::of(Kind::Addition, n)
        + Counts::of(Kind::Copy, n)
}

/// α = −expm1(−τ d), then I ← I + C α T and T ← T (1 − α), at n middles.
fn compositing(n: u64) -> Counts {
    medium(n)
        // 1, and 0 for I and for t, which is not used.
        + Counts::of(Kind::Integer, 3)
        // d.
        + Counts::of(Kind::Constant, 1)
        + Counts::of(Kind::Multiplication, (1 + 2 + 1) * n)
        + Counts::of(Kind::Addition, 2 * n)
        + Counts::of(Kind::Negation, 2 * n)
        + Counts::of(Kind::ExponentialMinusOne, n)
        // τ d and 1 of every segment; T = 1 and I of the whole.
        + Counts::of(Kind::Copy, 2 * n + 2)
}

#[test]
fn counts_are_those_derived_by_hand() {
    let riemann = method("riemann-left/riemann-left");
    let trapezoid = method("trapezoid/trapezoid");
    let over = method("front-to-back/middle/expm1");
    let at = |method: &Method, n| counts(&SineSquared, Native::<f64>::new(), method, n);
    for n in [1, 2, 7, 64, 1000] {
        assert_eq!(at(&riemann, n), marching(n), "n = {n}");
        assert_eq!(at(&trapezoid, n), marching(n) + means(n), "n = {n}");
        assert_eq!(at(&over, n), compositing(n), "n = {n}");
    }
}

#[test]
fn counts_are_the_same_in_every_format_and_again() {
    let thick = symbolic("thick");
    for name in METHODS {
        // It stops where the format's T is small, one segment earlier in one than in another.
        if name.contains("stop") {
            continue;
        }
        let method = method(name);
        // The first run rounds the constants of the case's formulas, which is none of its work.
        let first = counts(&thick, Native::<f32>::new(), &method, 16);
        assert_eq!(
            counts(&thick, Native::<f32>::new(), &method, 16),
            first,
            "{name}"
        );
        assert_eq!(
            counts(&thick, Native::<f64>::new(), &method, 16),
            first,
            "{name}"
        );
        assert_eq!(
            counts(&thick, Mpfr { bits: 200 }, &method, 16),
            first,
            "{name}"
        );
        assert!(first.evaluations() >= 16, "{name}");
    }
}

#[test]
fn an_early_end_costs_less() {
    let thick = symbolic("thick");
    let at = |name| counts(&thick, Native::<f32>::new(), &method(name), 512);
    let whole = at("front-to-back/middle/expm1");
    let stopped = at("front-to-back/middle/expm1/stop=1:255");
    assert!(stopped.evaluations() < whole.evaluations());
    assert_eq!(whole.evaluations(), 512);
}

#[test]
fn usual_methods_cost_what_they_did() {
    let mut lines = Vec::new();
    for name in METHODS {
        let counts = counts(&SineSquared, Mpfr { bits: 100 }, &method(name), 64);
        let counts: Vec<String> = counts
            .iter()
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        lines.push(format!("{name}: {}", counts.join(", ")));
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("counts_of_methods", lines.join("\n")));
}

//! Scopes, and what is counted of what.

use std::panic::{AssertUnwindSafe, catch_unwind};
use volver::real::counted::{Counted, CountedReal, Counts, Kind, count, uncounted};
use volver::real::special::relative_opacity;
use volver::real::{Format, Mpfr, Native, Real};

fn one() -> CountedReal<f64> {
    Counted(Native::<f64>::new()).int(1)
}

#[test]
fn scopes_nest_and_add_up() {
    let (inner, outer) = count(|| {
        let (_, inner) = count(|| one() + &one());
        let _ = one() * &one();
        inner
    });
    assert_eq!(
        inner,
        Counts::of(Kind::Integer, 2) + Counts::of(Kind::Addition, 1)
    );
    assert_eq!(
        outer,
        inner + Counts::of(Kind::Integer, 2) + Counts::of(Kind::Multiplication, 1)
    );
    // What happened before is none of theirs.
    assert_eq!(count(|| ()).1, Counts::default());
}

#[test]
fn a_panic_leaves_the_tally_right() {
    let ((), outer) = count(|| {
        let broken = catch_unwind(AssertUnwindSafe(|| {
            count(|| {
                let _ = one().exp();
                panic!("on purpose");
            })
        }));
        assert!(broken.is_err());
        let broken = catch_unwind(AssertUnwindSafe(|| {
            uncounted(|| {
                let _ = one().exp();
                panic!("on purpose");
            })
        }));
        assert!(broken.is_err());
        let (_, inner) = count(|| one().ln());
        assert_eq!(
            inner,
            Counts::of(Kind::Integer, 1) + Counts::of(Kind::Logarithm, 1)
        );
    });
    assert_eq!(outer[Kind::Exponential], 1);
    assert_eq!(outer[Kind::Integer], 2);
    assert_eq!(outer[Kind::Logarithm], 1);
}

#[test]
fn uncounted_work_counts_for_itself_alone() {
    let (inner, outer) = count(|| uncounted(|| count(|| one().sqrt()).1));
    assert_eq!(inner[Kind::SquareRoot], 1);
    assert_eq!(outer, Counts::default());
}

#[test]
fn threads_have_tallies_of_their_own() {
    let (_, counts) = count(|| std::thread::spawn(|| drop(one().exp())).join());
    assert_eq!(counts, Counts::default());
}

/// Every operation once, on numbers of that format.
fn everything<F: Format>(format: F) -> Counts {
    let format = Counted(format);
    let x = || format.fraction(1, 2);
    let functions: [fn(_) -> _; 12] = [
        Real::abs,
        Real::sqrt,
        Real::exp,
        Real::exp_m1,
        Real::ln,
        Real::ln_1p,
        Real::tan,
        Real::sinh,
        Real::cosh,
        Real::tanh,
        Real::atan,
        Real::erf,
    ];
    let ((), counts) = count(|| {
        for function in functions {
            let function: fn(CountedReal<F::Real>) -> CountedReal<F::Real> = function;
            let value = function(x());
            assert_eq!(value.format(), format);
        }
        let (mut sin, cos) = x().sin_cos();
        sin += &cos;
        sin -= &cos;
        sin *= &cos;
        sin /= &cos;
        let _ = sin.clone() + &cos;
        let _ = sin.clone() - &cos;
        let _ = sin.clone() * &cos;
        let _ = sin.clone() / &cos;
        assert!(sin < cos || sin >= cos);
        sin.set(&cos);
        assert!(sin == cos);
        let _ = -sin;
        let _ = (format.pi(), format.ratio(&(1, 3).into()));
        let _ = relative_opacity(&cos);
    });
    counts
}

#[test]
fn every_operation_is_counted_once_in_every_format() {
    let counts = everything(Native::<f64>::new());
    let expected = [
        (Kind::Addition, 4),
        (Kind::Multiplication, 2),
        // One of them and two negations, a comparison, an integer, a copy are the relative opacity's.
        (Kind::Division, 3),
        (Kind::Negation, 4),
        (Kind::SquareRoot, 1),
        (Kind::Exponential, 1),
        (Kind::ExponentialMinusOne, 2),
        (Kind::Logarithm, 2),
        (Kind::SineCosine, 1),
        (Kind::Tangent, 1),
        (Kind::Hyperbolic, 3),
        (Kind::Arctangent, 1),
        (Kind::ErrorFunction, 1),
        (Kind::Integer, 1),
        (Kind::Fraction, 13),
        (Kind::Constant, 2),
        (Kind::Copy, 6),
    ];
    for (kind, times) in expected {
        assert_eq!(counts[kind], times, "{kind}");
    }
    // sin < cos, or the other way round, or both; sin = cos; x = 0.
    assert!((3..=4).contains(&counts[Kind::Comparison]));
    let known: u64 = expected.iter().map(|(_, times)| times).sum();
    let all: u64 = counts.iter().map(|(_, times)| times).sum();
    assert_eq!(all, known + counts[Kind::Comparison]);
    assert_eq!(counts.transcendentals(), 12);
    assert_eq!(counts.operations(), all - 6);
    for other in [
        everything(Native::<f32>::new()),
        everything(Mpfr { bits: 200 }),
    ] {
        assert_eq!(other, counts);
    }
}

#[test]
fn counts_are_a_map_in_json() {
    let counts = Counts::of(Kind::ExponentialMinusOne, 3) + Counts::of(Kind::Transfer, 7);
    let text = serde_json::to_string(&counts).unwrap();
    assert_eq!(text, r#"{"exponential_minus_one":3,"transfer":7}"#);
    assert_eq!(counts.evaluations(), 7);
}

//! Runs, their errors, and the floors beneath them.

use rug::{Float, Rational};
use std::sync::atomic::{AtomicU64, Ordering};
use volver::case::{Case, Fresh, HomogeneousSlab, Reciprocal, ReciprocalSquare, SineSquared};
use volver::inside::study::{exact, exact_radiance};
use volver::method::{
    Color, Exponential, Inner, Integration, Interpolant, LastSegment, Method, MethodError, Nested,
    Opacity, Outer, Preintegrated, Scope,
};
use volver::quadrature::Rule;
use volver::real::{Fixed, Format, Mpfr, Native};
use volver::study::{Progress, Run, Silent, samples};

fn nested(inner: Rule, outer: Rule, exponential: Exponential, scope: Scope) -> Method {
    Method::Nested(Nested {
        inner: Inner::PerSegment(inner),
        outer: Outer(outer),
        exponential,
        scope,
    })
}

fn trapezoids() -> Method {
    nested(
        Rule::Trapezoid,
        Rule::Trapezoid,
        Exponential::Exact,
        Scope::Whole,
    )
}

fn preintegrated(color: Color, opacity: Interpolant) -> Method {
    Method::Preintegrated(Preintegrated {
        color,
        opacity: Opacity {
            interpolant: opacity,
            integration: Integration::Closed,
        },
    })
}

fn by_trapezoids(count: u32) -> Integration {
    Integration::SubIntervals {
        count,
        rule: Rule::Trapezoid,
    }
}

/// Etiene, Kirby and Silva (2013), Table 1 without Monte Carlo, and its cubic remark.
fn table_1() -> Vec<Method> {
    let inner = [
        Rule::RiemannLeft,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::GaussLegendre(3),
    ];
    let outer = [
        Rule::RiemannRight,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
    ];
    let mut methods = Vec::new();
    for inner in inner {
        for outer in outer {
            methods.push(nested(inner, outer, Exponential::Exact, Scope::Whole));
            methods.push(nested(inner, outer, Exponential::Linear, Scope::PerSegment));
            methods.push(nested(inner, outer, Exponential::Cubic, Scope::PerSegment));
        }
    }
    methods
}

/// Their Table 2.
fn table_2() -> Vec<Method> {
    let quadratic = Interpolant::Quadratic(LastSegment::Beyond);
    let colors = [
        (Interpolant::Linear, true, Integration::Closed),
        (quadratic, true, Integration::Closed),
        (quadratic, true, by_trapezoids(100)),
        (quadratic, true, by_trapezoids(10)),
        (Interpolant::Linear, false, Integration::Closed),
    ];
    let mut methods = Vec::new();
    for (interpolant, attenuated, integration) in colors {
        for opacity in [Interpolant::Linear, quadratic] {
            let color = Color {
                interpolant,
                attenuated,
                integration,
            };
            methods.push(preintegrated(color, opacity));
        }
    }
    methods
}

/// What rounding does at `bits` never exceeds the floor that a run without an oracle reports.
fn the_floor_bounds_rounding<C: Case>(case: &C, methods: &[Method], bits: u32, levels: &[u64]) {
    let at = |bits| Run::new(case, Mpfr { bits }, methods, levels, &Silent).unwrap();
    let (run, oracle) = (at(bits), at(2 * bits + 64));
    for (m, method) in methods.iter().enumerate() {
        let a_priori = samples(case, &run, m, None).unwrap();
        for (level, sample) in a_priori.iter().enumerate() {
            let rounding =
                Float::with_val(64, &run.radiances[m][level] - &oracle.radiances[m][level]);
            assert!(
                rounding.clone().abs() <= sample.floor,
                "{method} on {case:?} at {bits} bits, n = {}: {rounding} above {}",
                levels[level],
                sample.floor
            );
        }
    }
}

const LEVELS: [u64; 6] = [8, 16, 32, 64, 128, 256];

#[test]
fn the_a_priori_floor_bounds_the_rounding_of_table_1() {
    for bits in [24, 53, 128] {
        the_floor_bounds_rounding(&SineSquared, &table_1(), bits, &LEVELS);
        the_floor_bounds_rounding(&ReciprocalSquare, &table_1(), bits, &LEVELS);
    }
}

#[test]
fn the_a_priori_floor_bounds_the_rounding_of_table_2() {
    for bits in [24, 53, 128] {
        the_floor_bounds_rounding(&Reciprocal, &table_2(), bits, &LEVELS[..4]);
        the_floor_bounds_rounding(&ReciprocalSquare, &table_2(), bits, &LEVELS[..4]);
    }
}

#[test]
fn samples_are_signed_errors_with_their_floors() {
    let case = HomogeneousSlab {
        length: (3, 2).into(),
        extinction: 1.into(),
        emission: 1.into(),
    };
    let ladder = [2, 4, 12];
    let at = |bits| Run::new(&case, Mpfr { bits }, &[trapezoids()], &ladder, &Silent).unwrap();
    let (run, oracle) = (at(40), at(200));
    let exact_bits = 300;
    // 1 − exp(−3/2).
    let radiance = -Float::with_val(exact_bits, -1.5).exp_m1();
    let unit = Float::with_val(exact_bits, &radiance >> 40_u32);
    let a_priori = samples(&case, &run, 0, None).unwrap();
    let a_posteriori = samples(&case, &run, 0, Some(&oracle)).unwrap();
    for (k, n) in ladder.into_iter().enumerate() {
        let sample = &a_priori[k];
        assert_eq!(sample.n, Some(n));
        assert_eq!(sample.step, 1.5 / n as f64);
        let error = Float::with_val(exact_bits, &run.radiances[0][k] - &radiance);
        // The trapezoid rule overestimates a falling convex function.
        assert!(sample.error > 0);
        assert!((Float::with_val(exact_bits, &sample.error) / error - 1_u32).abs() < 1e-15);
        let floor = unit.clone() * 16_u32 * n;
        assert!((Float::with_val(exact_bits, &sample.floor) / floor - 1_u32).abs() < 1e-15);

        let rounding = Float::with_val(exact_bits, &run.radiances[0][k] - &oracle.radiances[0][k]);
        let floor = rounding.abs().max(&unit);
        let sample = &a_posteriori[k];
        assert!((Float::with_val(exact_bits, &sample.floor) / floor - 1_u32).abs() < 1e-15);
    }
    // An oracle that was not run at a level says nothing there.
    let partial = oracle.at_levels(&[4]);
    let mixed = samples(&case, &run, 0, Some(&partial)).unwrap();
    assert_eq!(mixed[0].floor, a_priori[0].floor);
    assert_eq!(mixed[1].floor, a_posteriori[1].floor);
    assert!(samples(&case, &run, 1, None).unwrap().is_empty());
}

/// In so few bits the rounding shows; the floor is the difference from the oracle or u·|I|, whichever is
/// more, and both happen.
#[test]
fn the_floor_is_never_below_a_rounding_of_the_radiance() {
    let case = SineSquared;
    let at = |bits| Run::new(&case, Mpfr { bits }, &table_1(), &LEVELS, &Silent).unwrap();
    let (run, oracle) = (at(24), at(120));
    let unit = Float::with_val(64, exact_radiance(&case, 24).unwrap() >> 24_u32);
    let floors: Vec<Float> = (0..run.radiances.len())
        .flat_map(|m| samples(&case, &run, m, Some(&oracle)).unwrap())
        .map(|sample| sample.floor)
        .collect();
    assert!(floors.iter().all(|floor| *floor >= unit));
    assert!(floors.contains(&unit));
    assert!(floors.iter().any(|floor| *floor > unit));
}

#[test]
fn a_run_keeps_the_order_of_its_ladder() {
    let ladder = [32, 8, 24];
    let methods = [trapezoids(), table_1()[3]];
    let format = Native::<f64>::new();
    let run = Run::new(&SineSquared, format, &methods, &ladder, &Silent).unwrap();
    let nodes = Fresh::new(&SineSquared, format);
    for (m, method) in methods.iter().enumerate() {
        for (k, &n) in ladder.iter().enumerate() {
            let radiance = method.radiance(&nodes, n).unwrap();
            assert_eq!(run.radiances[m][k], radiance);
        }
    }
    assert_eq!((run.bits, &run.ladder[..]), (53, &ladder[..]));
    let some = run.at_levels(&[24, 32, 1000]);
    assert_eq!(some.ladder, [32, 24]);
    assert_eq!(some.radiances[1][1], run.radiances[1][2]);
    assert_eq!(some.radiances[0][0], run.radiances[0][0]);
    assert_eq!((some.bits, some.evaluations), (53, run.evaluations));
}

#[test]
fn a_run_refuses_what_a_method_refuses() {
    let boole = nested(Rule::Boole, Rule::Boole, Exponential::Exact, Scope::Whole);
    let refused = Run::new(
        &SineSquared,
        Native::<f32>::new(),
        &[trapezoids(), boole],
        &[4, 6],
        &Silent,
    );
    assert!(matches!(
        refused,
        Err(MethodError::Segments {
            n: 6,
            multiple: 4,
            ..
        })
    ));
}

#[test]
fn progress_hears_of_every_level_and_method() {
    struct Sum(AtomicU64);
    impl Progress for Sum {
        fn advance(&self, units: u64) {
            self.0.fetch_add(units, Ordering::Relaxed);
        }
    }
    let linear = Color {
        interpolant: Interpolant::Linear,
        attenuated: true,
        integration: Integration::Closed,
    };
    let sub = Color {
        integration: by_trapezoids(100),
        ..linear
    };
    let methods = [
        trapezoids(),
        preintegrated(linear, Interpolant::Linear),
        preintegrated(sub, Interpolant::Linear),
    ];
    let heard = |methods: &[Method]| {
        let heard = Sum(AtomicU64::new(0));
        let format = Native::<f64>::new();
        Run::new(&Reciprocal, format, methods, &[8, 16], &heard).unwrap();
        heard.0.into_inner()
    };
    // How much a segment is.
    for (method, units) in methods.iter().zip([1, 1, 100]) {
        assert_eq!(heard(&[*method]), 24 * units);
    }
    assert_eq!(heard(&methods), 24 * 102);
}

#[test]
fn exact_values_are_held_in_full() {
    let third = Mpfr { bits: 77 }.ratio(&Rational::from((1, 3)));
    assert_eq!(exact(&third), *third.as_float());
    assert_eq!(exact(&third).prec(), 77);
    assert_eq!(exact(&0.1_f32), 0.1_f32);
    assert!(exact(&f64::INFINITY).is_nan());
    // ln 2, with 64 bits to spare beyond the format's, and never less than binary64's.
    for (bits, held) in [(24, 117), (53, 117), (200, 264)] {
        let radiance = exact_radiance(&Reciprocal, bits).unwrap();
        assert_eq!(radiance.prec(), held);
        assert_eq!(radiance, Float::with_val(held, 2).ln());
    }
}

/// Above 1 a fixed-point number has more significant bits than its format has after the point.
#[test]
fn the_value_of_a_fixed_point_number_is_kept_whole() {
    let format = Fixed::new(16, 1).unwrap();
    let x = format.fraction(12_345, 2);
    assert_eq!(exact(&x), 6172.5);
    assert!(exact(&(format.int(0) / &format.int(0))).is_nan());
    assert_eq!(exact(&format.int(0)), 0);
    // A power of 2 needs no more bits than its format has.
    assert_eq!(exact(&Mpfr { bits: 9 }.int(1 << 40)).prec(), 9);
}

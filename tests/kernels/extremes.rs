//! Kernels where numbers end: right ones keep their digits, and what loses them is told.

mod command;
mod forms;
mod others;
mod thin;

use volver::kernel::{Closure, Declaration, Kernel, Segments};
use volver::study::Silent;
use volver::study::extremes::{Answer, Cell, Extremes, extremes};
use volver::study::stress::Digits;

/// The opacity of an optical depth.
type Opacity = fn(f64) -> f64;

fn expm1(x: f64) -> f64 {
    -(-x).exp_m1()
}

fn subtraction(x: f64) -> f64 {
    1.0 - (-x).exp()
}

/// Front to back, samples in the middles, of what `tau` makes of τ.
fn march(segments: &Segments, tau: Opacity, opacity: Opacity) -> f64 {
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    let middles = segments.middles.extinction.iter();
    let both = middles.zip(&segments.middles.emission[0]);
    for ((extinction, emission), length) in both.zip(segments.lengths()) {
        let alpha = opacity(tau(*extinction) * length);
        radiance += transmittance * alpha * emission;
        transmittance *= 1.0 - alpha;
    }
    radiance
}

fn method(name: &str) -> Declaration {
    Declaration {
        method: Some(name.parse().unwrap()),
        ..Declaration::new("under test")
    }
}

/// Of order 2, and nothing else is said.
fn order() -> Declaration {
    Declaration {
        order: Some(2.0),
        ..Declaration::new("under test")
    }
}

fn ask(kernel: &mut dyn Kernel) -> Extremes {
    extremes(kernel, &Silent).unwrap()
}

/// What a loop over segments shows.
fn of(declaration: Declaration, radiance: impl Fn(&Segments) -> f64 + Send) -> Extremes {
    let mut kernel = Closure::new(declaration, move |task, _| {
        task.cut().map_or(f64::NAN, &radiance)
    });
    ask(&mut kernel)
}

fn cell<'a>(extremes: &'a Extremes, name: &str) -> &'a Cell {
    let found = extremes.cells.iter().find(|cell| cell.name() == name);
    found.unwrap_or_else(|| panic!("no {name} in {:#?}", extremes.cells))
}

fn faults(extremes: &Extremes) -> Vec<String> {
    extremes.faults().map(Cell::name).collect()
}

fn digits(found: Option<Digits>) -> f64 {
    match found {
        Some(Digits::Exact) => f64::INFINITY,
        Some(Digits::Of(digits)) => digits,
        None => f64::NAN,
    }
}

const NEGATIVE: &str = "fault/negative-tau";

/// 1 − e^(−t) of every scenario, by another formula than the library's: of sixteen rays that are known by heart.
#[test]
fn truths_are_those_of_closed_forms() {
    let found = of(order(), |s| march(s, |tau| tau.max(0.0), expm1));
    let depth = |name: &str| match name.split_once('/').unwrap() {
        ("depth", depth) => depth.parse().unwrap(),
        ("vacuum", "all") => 0.0,
        // max(τ, 0) is 1 on three segments of eight, and has two ramps of half a segment's worth.
        ("vacuum", "between") | ("fault", "negative-tau") => 0.5,
        ("emission", _) => 8.0,
        ("segments", "1") => 0.375,
        ("segments", "1-thick") => 100.0,
        other => panic!("{other:?}"),
    };
    assert_eq!(found.cells.len(), 16);
    for cell in &found.cells {
        let bright: f64 = match cell.scenario.split_once('/').unwrap() {
            ("emission", bright) => bright.parse().unwrap(),
            _ => 1.0,
        };
        let t: f64 = depth(&cell.scenario);
        // By a series where it is short, else by the sum of a subtraction.
        let opacity = if t < 1e-3 {
            t * (1.0 - t / 2.0 * (1.0 - t / 3.0))
        } else {
            1.0 - 1.0 / t.exp()
        };
        let truth = cell.truth.as_ref().unwrap().to_f64();
        let close = (truth - bright * opacity).abs() <= 1e-12 * truth;
        assert!(close, "{}: {truth} {opacity}", cell.scenario);
    }
    assert_eq!(faults(&found), [""; 0]);
    assert_eq!(cell(&found, NEGATIVE).answer, Some(Answer::Rectified));
}

/// Thick rays that stay partly clear, at whatever depth opacity or depth is clamped.
#[test]
fn what_is_clamped_is_wrong_where_rays_are_thick() {
    let clamped = of(method("front-to-back/middle/expm1"), |s| {
        march(s, |tau| tau, |x| expm1(x).min(0.9))
    });
    // e^(−2.4) is 0.09: 1e1 has segments of 1.25, which stay below 0.9.
    assert_eq!(
        faults(&clamped),
        ["depth/1e2", "depth/1e3", "segments/1-thick"]
    );
    let thin = cell(&clamped, "depth/1e-12");
    assert!(
        digits(thin.digits) >= 14.0 && thin.promised >= Some(14.0),
        "{thin:?}"
    );
}

/// Emission divided by τ, as a source function is.
#[test]
fn nan_in_vacuum_is_wrong() {
    let found = of(order(), |s| march(s, |tau| tau * (tau / tau), expm1));
    assert_eq!(faults(&found), ["vacuum/all", "vacuum/between"]);
    for name in ["vacuum/all", "vacuum/between"] {
        assert_eq!(cell(&found, name).answer, Some(Answer::NotANumber));
    }
}

#[test]
fn below_zero_a_rectifier_and_the_formula_are_told_apart() {
    let formula = of(order(), |s| march(s, |tau| tau, expm1));
    let amplified = cell(&formula, NEGATIVE);
    assert_eq!(amplified.answer, Some(Answer::Amplified));
    // t(D) = −1/2.
    let value = amplified.value.as_ref().unwrap().to_f64();
    assert!((value - (1.0 - 0.5_f64.exp())).abs() < 1e-14, "{value}");
    assert!(digits(amplified.digits) > 13.0 && digits(amplified.against_truth) == 0.0);
    assert_eq!(faults(&formula), [""; 0]);
    // Nobody said what τ below 0 is, but a method does.
    let folded = |s: &Segments| march(s, f64::abs, expm1);
    let free = of(order(), folded);
    assert_eq!(cell(&free, NEGATIVE).answer, Some(Answer::Neither));
    assert_eq!(faults(&free), [""; 0]);
    let declared = of(method("front-to-back/middle/expm1"), folded);
    assert_eq!(faults(&declared), [NEGATIVE]);
    // Finite truths, and no number.
    let not = of(order(), |s| march(s, |tau| tau.sqrt().powi(2), expm1));
    assert_eq!(cell(&not, NEGATIVE).answer, Some(Answer::NotANumber));
    assert!(faults(&not).contains(&NEGATIVE.to_string()));
}

/// The trapezoid rule has half of 125 where a ray of 125 a segment has 1: that is the rule, and as promised where it is declared.
#[test]
fn a_rule_that_is_not_exact_is_measured_by_itself() {
    let trapezoids = |segments: &Segments| {
        let edges = &segments.edges;
        let (mut radiance, mut depth) = (0.0, 0.0);
        for (i, length) in segments.lengths().enumerate() {
            let term = |i: usize, t: f64| edges.emission[0][i] * edges.extinction[i] * (-t).exp();
            let own = f64::midpoint(edges.extinction[i], edges.extinction[i + 1]) * length;
            radiance += length / 2.0 * (term(i, depth) + term(i + 1, depth + own));
            depth += own;
        }
        radiance
    };
    let declared = of(method("trapezoid/trapezoid"), trapezoids);
    assert_eq!(faults(&declared), [""; 0]);
    let thick = cell(&declared, "depth/1e3");
    assert!(digits(thick.digits) > 13.0, "{thick:?}");
    assert_eq!(digits(thick.against_truth), 0.0, "{thick:?}");
    let free = of(order(), trapezoids);
    assert!(!free.is_exact);
    assert_eq!(faults(&free), [""; 0]);
    assert_eq!(cell(&free, "depth/1e3").answer, Some(Answer::Coarse));
    // As thin as that an order says more.
    let off = of(order(), move |s| 1.001 * trapezoids(s));
    let faults = faults(&off);
    assert!(faults.contains(&"depth/1e-12".to_string()), "{faults:?}");
    assert!(!faults.contains(&"depth/1e3".to_string()), "{faults:?}");
}

#[test]
fn one_segment_is_a_ray_too() {
    let without_last = of(order(), |segments| {
        if segments.count() == 1 {
            0.0
        } else {
            march(segments, |tau| tau, expm1)
        }
    });
    assert_eq!(faults(&without_last), ["segments/1", "segments/1-thick"]);
    assert_eq!(cell(&without_last, "segments/1").answer, Some(Answer::Zero));
}

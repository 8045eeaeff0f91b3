//! Kernels that say how exact their arithmetic is: what is declared is allowed, once where it happens once and n times where
//! it happens in every segment; a hundred times as much is not.

use super::{SMOOTH, deviations, run, settings, shown, subjects};
use std::cell::Cell;
use volver::kernel::{Closure, Declaration, Quantum, Segments, Task, UlpBound};
use volver::real::FormatName;
use volver::study::verify::{Conclusion, Identify, Settings, Verification};

/// 2⁻²⁴: a unit in the last place of binary32 just below 1.
const U: f64 = 1.0 / 16_777_216.0;

const METHOD: &str = "front-to-back/middle/subtraction";

fn declared() -> Declaration {
    Declaration {
        format: FormatName::F32,
        ..super::declared(METHOD)
    }
}

/// By levels so coarse that orders show before rounding does.
fn coarse() -> Settings {
    Settings {
        identify: Identify::Off,
        ..settings("6,8,12,16,24,32,48,64,96,128,192,256,384,512")
    }
}

/// Front to back in binary32, by what `exp` makes of −τ d.
fn march(segments: &Segments, channel: usize, exp: impl Fn(f32) -> f32) -> f32 {
    let middles = &segments.middles;
    let (mut radiance, mut transmittance) = (0.0_f32, 1.0_f32);
    let values = middles.extinction.iter().zip(&middles.emission[channel]);
    for ((tau, c), length) in values.zip(segments.lengths()) {
        let alpha = 1.0 - exp(-(*tau as f32 * length as f32));
        radiance += transmittance * alpha * *c as f32;
        transmittance *= 1.0 - alpha;
    }
    radiance
}

/// By that many units in the last place too small, at every argument.
fn low(units: f64) -> impl Fn(f32) -> f32 + Copy {
    move |x| {
        let exact = f64::from(x).exp();
        (exact - units * U * (2.0 * exact).min(1.0)) as f32
    }
}

fn exact(x: f32) -> f32 {
    f64::from(x).exp() as f32
}

/// What is made of a kernel whose answers `store` alters.
fn verified(
    declaration: Declaration,
    settings: &Settings,
    exp: impl Fn(f32) -> f32 + Copy + Send,
    store: impl Fn(&Task<'_>, f64) -> f64 + Send,
) -> Verification {
    let mut kernel = Closure::new(declaration, move |task, channel| {
        let segments = task.cut().expect("segments are asked for");
        store(task, march(segments, channel, exp).into())
    });
    run(&mut kernel, &subjects(&SMOOTH), settings)
}

fn confirms(verification: &Verification) {
    let shown = shown(verification);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    assert!(!verification.contradicts_declaration(), "{shown}");
}

fn contradicts(verification: &Verification) {
    let shown = shown(verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
    assert!(verification.counts().contradicted > 0, "{shown}");
    assert!(verification.contradicts_declaration(), "{shown}");
}

fn with_exp(bound: f64) -> Declaration {
    Declaration {
        exp_ulp: Some(UlpBound::new(bound, 0.0).unwrap()),
        ..declared()
    }
}

/// An exponential as bad as those of shading languages: equal segments have equal errors, which add up like n.
#[test]
fn exponentials_are_as_bad_as_they_are_said_to_be() {
    let as_is = |_: &Task<'_>, y: f64| y;
    confirms(&verified(with_exp(20.5), &coarse(), low(20.0), as_is));
    contradicts(&verified(declared(), &coarse(), low(20.0), as_is));
    // A hundred times as bad is no exponential of that kind.
    contradicts(&verified(with_exp(20.5), &coarse(), low(2000.0), as_is));
    contradicts(&verified(with_exp(4.0), &coarse(), low(400.0), as_is));
}

/// What is off by units for every bit of its argument is so whatever the number of segments is.
#[test]
fn bounds_grow_with_the_argument_where_they_are_said_to() {
    let steep = |slope: f64| move |x: f32| low(slope * f64::from(x.abs()))(x);
    let as_is = |_: &Task<'_>, y: f64| y;
    let with = |slope| Declaration {
        exp_ulp: Some(UlpBound::new(0.5, slope).unwrap()),
        ..declared()
    };
    confirms(&verified(with(200.0), &coarse(), steep(200.0), as_is));
    assert!(verified(declared(), &coarse(), steep(200.0), as_is).contradicts_declaration());
    contradicts(&verified(with(200.0), &coarse(), steep(2e4), as_is));
    // Powers have the logarithm to the base 2 for their argument, which is larger.
    let power = Declaration {
        pow_ulp: Some(UlpBound::new(0.5, 200.0 * std::f64::consts::LN_2).unwrap()),
        ..declared()
    };
    confirms(&verified(power.clone(), &coarse(), steep(200.0), as_is));
    contradicts(&verified(power, &coarse(), steep(2e4), as_is));
}

/// A relative error of opacities is one of the answer, and adds up to no more.
#[test]
fn opacities_by_a_coarse_expm1_are_allowed_where_that_is_declared() {
    // So many units of 1 − f for f.
    let coarse_opacity = |units: f64| {
        move |segments: &Segments, channel: usize| {
            let middles = &segments.middles;
            let (mut radiance, mut transmittance) = (0.0, 1.0);
            let values = middles.extinction.iter().zip(&middles.emission[channel]);
            for ((tau, c), length) in values.zip(segments.lengths()) {
                let alpha = -(-tau * length).exp_m1() * (1.0 + units * 2.0 * U);
                radiance += transmittance * alpha * c;
                transmittance *= 1.0 - alpha;
            }
            radiance
        }
    };
    let verified = |bound: Option<f64>, units| {
        let declaration = Declaration {
            expm1_ulp: bound.map(|bound| UlpBound::new(bound, 0.0).unwrap()),
            format: FormatName::F32,
            ..super::declared("front-to-back/middle/expm1")
        };
        let of = coarse_opacity(units);
        let mut kernel = Closure::new(declaration, move |task: &Task<'_>, channel| {
            of(task.cut().expect("segments are asked for"), channel)
        });
        run(&mut kernel, &subjects(&SMOOTH), &coarse())
    };
    confirms(&verified(Some(400.0), 400.0));
    assert!(verified(None, 400.0).contradicts_declaration());
    contradicts(&verified(Some(400.0), 40_000.0));
}

/// Whatever is declared, an answer that is all error is no answer.
#[test]
fn no_exponential_is_declared_so_bad_that_all_passes() {
    let twice = |_: &Task<'_>, y: f64| 2.0 * y;
    let verification = verified(with_exp(1e9), &coarse(), exact, twice);
    let shown = shown(&verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
    // Floors as high as that would hide it.
    assert!(verification.counts().contradicted > 0, "{shown}");
}

fn rounded_to(quantum: f64, y: f64) -> f64 {
    (y / quantum).round() * quantum
}

/// Eleven bits of what is computed in 24: stored once, however many segments there are.
#[test]
fn what_is_stored_is_rounded_once() {
    let half = |_: &Task<'_>, y: f64| {
        let bits = rug::Float::with_val(11, y);
        bits.to_f64()
    };
    let output = Declaration {
        output: Some(FormatName::F16),
        ..declared()
    };
    confirms(&verified(output.clone(), &coarse(), exact, half));
    let undeclared = verified(declared(), &coarse(), exact, half);
    assert!(undeclared.contradicts_declaration());
    // Of an eighth as many bits nothing is what is declared.
    let eight = |_: &Task<'_>, y: f64| rug::Float::with_val(5, y).to_f64();
    let verification = verified(output.clone(), &coarse(), exact, eight);
    assert!(verification.contradicts_declaration());
    // Nor is it named as a deviation.
    let identified = Settings {
        identify: Identify::Auto,
        ..coarse()
    };
    let verification = verified(output, &identified, exact, half);
    assert_eq!(deviations(&verification), [""; 0]);
    let verification = verified(declared(), &identified, exact, half);
    assert!(deviations(&verification).contains(&"format"));
}

/// The largest |C| of a ray.
fn brightest(task: &Task<'_>) -> f64 {
    let segments = task.cut().expect("segments are asked for");
    let all = [&segments.edges, &segments.middles].into_iter();
    let all = all.flat_map(|samples| samples.emission.iter().flatten());
    all.fold(0.0, |most, c| c.abs().max(most))
}

/// Images are stored in parts of their brightest value.
#[test]
fn quanta_may_be_parts_of_the_largest_emission() {
    const PART: f64 = 1.0 / 4095.0;
    let stored = |task: &Task<'_>, y: f64| rounded_to(PART * brightest(task), y);
    let with = |quantum| Declaration {
        quantum: Some(quantum),
        ..declared()
    };
    let relative = || with(Quantum::Relative(PART));
    confirms(&verified(relative(), &coarse(), exact, stored));
    // The brightest cases are not stored in parts of 1.
    let absolute = with(Quantum::Absolute(PART / 4.0));
    assert!(verified(absolute, &coarse(), exact, stored).contradicts_declaration());
    let coarser = |task: &Task<'_>, y: f64| rounded_to(100.0 * PART * brightest(task), y);
    contradicts(&verified(relative(), &coarse(), exact, coarser));
    // Nothing is said of what it computes, and nothing wrong.
    let identified = Settings {
        identify: Identify::Auto,
        ..coarse()
    };
    let verification = verified(relative(), &identified, exact, stored);
    assert_eq!(deviations(&verification), [""; 0]);
    confirms(&verification);
}

/// Sums in an order that nobody determines: the same question has answers that differ.
#[test]
fn noise_is_as_much_as_is_declared() {
    let scatter = |size: f64| {
        let state = Cell::new(1_u64);
        move |_: &Task<'_>, y: f64| {
            // Steele and Vigna's multiplier; the high bits scatter.
            state.set(
                state
                    .get()
                    .wrapping_mul(0xd134_2543_de82_ef95)
                    .wrapping_add(1),
            );
            y + size * ((state.get() >> 11) as f64 / 52_f64.exp2() - 1.0)
        }
    };
    let noisy = || Declaration {
        noise: Some(1e-4),
        ..declared()
    };
    let settings = Settings {
        identify: Identify::Auto,
        ..coarse()
    };
    let verification = verified(noisy(), &settings, exact, scatter(1e-4));
    confirms(&verification);
    assert_eq!(deviations(&verification), [""; 0]);
    assert!(verification.lines.iter().all(|line| line.steady));
    let undeclared = verified(declared(), &coarse(), exact, scatter(1e-4));
    assert!(undeclared.lines.iter().any(|line| !line.steady));
    assert_eq!(undeclared.conclusion(), Conclusion::NotConfirmed);
    let more = verified(noisy(), &coarse(), exact, scatter(1e-2));
    assert!(more.lines.iter().any(|line| !line.steady));
    assert_eq!(more.conclusion(), Conclusion::NotConfirmed);
    assert!(more.findings[0].words.ends_with("twice the declared noise"));
}

/// In binary16 numbers below 2⁻¹⁴ are 0 to units that have no subnormal ones: opacities of thin segments vanish.
#[test]
fn what_is_below_the_smallest_normal_number_may_be_lost() {
    const LEAST: f64 = 1.0 / 16_384.0;
    let flush = |units: f64| {
        move |task: &Task<'_>, channel: usize| {
            let middles = &task.cut().expect("segments are asked for").middles;
            let lengths = task.cut().unwrap().lengths();
            let (mut radiance, mut transmittance) = (0.0, 1.0);
            let values = middles.extinction.iter().zip(&middles.emission[channel]);
            for ((tau, c), length) in values.zip(lengths) {
                let alpha = -(-tau * length).exp_m1();
                let alpha = if alpha < units * LEAST { 0.0 } else { alpha };
                radiance += transmittance * alpha * c;
                transmittance *= 1.0 - alpha;
            }
            radiance
        }
    };
    // Eleven bits, so that nothing but the ends of the format is seen, in units of few enough of them.
    let wide = "ieee:53,-14,15".parse().expect("a format");
    let with = |subnormals_lost| Declaration {
        subnormals_lost,
        format: wide,
        method: None,
        order: Some(2.0),
        ..declared()
    };
    let verified = |lost, units| {
        let mut kernel = Closure::new(with(lost), flush(units));
        run(&mut kernel, &subjects(&SMOOTH), &coarse())
    };
    let lost = verified(true, 1.0);
    assert_eq!(lost.counts().contradicted, 0, "{}", shown(&lost));
    let kept = verified(false, 1.0);
    assert!(kept.counts().contradicted > 0, "{}", shown(&kept));
    let more = verified(true, 100.0);
    assert!(more.counts().contradicted > 0, "{}", shown(&more));
}

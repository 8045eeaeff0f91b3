//! Opacities in steps: of segments, or of a unit of length; to the nearest, or to the one below. And what is rounded on the
//! way to an answer.

use volver::identify::{Budget, Examined, Verdict, examine};
use volver::kernel::{Closure, Declaration, Task};

fn compositing(opacity: impl Fn(f64, f64) -> f64 + Send) -> Examined {
    of_transmittance(opacity, |_, passes| passes)
}

fn of_transmittance(
    opacity: impl Fn(f64, f64) -> f64 + Send,
    stored: impl Fn(usize, f64) -> f64 + Send,
) -> Examined {
    let radiance = move |task: &Task<'_>, channel: usize| {
        let segments = task.cut().unwrap();
        let (mut radiance, mut passes) = (0.0, 1.0);
        let samples = segments.middles.extinction.iter();
        let samples = samples.zip(&segments.middles.emission[channel]);
        for (i, ((tau, c), d)) in samples.zip(segments.lengths()).enumerate() {
            let opacity = opacity(*tau, d);
            radiance = stored(i, radiance + passes * opacity * c);
            passes = stored(i, passes * (1.0 - opacity));
        }
        radiance
    };
    let mut kernel = Closure::new(Declaration::new("steps"), radiance);
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

fn deviations(examined: &Examined) -> Vec<(&'static str, String)> {
    let all = examined.deviations.iter();
    all.map(|d| (d.name, d.does.clone())).collect()
}

#[test]
fn opacities_in_steps_are_told_apart() {
    let of_unit = |tau: f64, d: f64, round: fn(f64) -> f64| {
        let unit = round(-(-tau).exp_m1() * 255.0) / 255.0;
        1.0 - (1.0 - unit).powf(d)
    };
    let of_segment =
        |tau: f64, d: f64, round: fn(f64) -> f64| round(-(-tau * d).exp_m1() * 255.0) / 255.0;
    let name = "opacity-quantum";
    let step = "0.00392156862745098";
    for (found, does) in [
        (
            compositing(|tau, d| of_segment(tau, d, f64::round)),
            format!("opacities are multiples of {step}"),
        ),
        (
            compositing(|tau, d| of_segment(tau, d, f64::floor)),
            format!("opacities are rounded down to multiples of {step}"),
        ),
        (
            compositing(|tau, d| of_unit(tau, d, f64::round)),
            format!("opacities of a unit of length are multiples of {step}"),
        ),
        (
            compositing(|tau, d| of_unit(tau, d, f64::floor)),
            format!("opacities of a unit of length are rounded down to multiples of {step}"),
        ),
    ] {
        assert_eq!(deviations(&found), [(name, does)]);
    }
}

/// Every 16th segment what was added and what is let through go by a store of 11 bits.
#[test]
fn what_is_rounded_on_the_way_is_never_right() {
    let spilled = |i: usize, x: f64| {
        if i % 16 == 15 {
            rug::Float::with_val(11, x).to_f64()
        } else {
            x
        }
    };
    let exponential = |tau: f64, d: f64| -(-tau * d).exp_m1();
    assert_eq!(compositing(exponential).verdict(), Verdict::Right);
    assert_ne!(
        of_transmittance(exponential, spilled).verdict(),
        Verdict::Right
    );
    // In every segment.
    let stored = |_, x: f64| rug::Float::with_val(11, x).to_f64();
    assert_ne!(
        of_transmittance(exponential, stored).verdict(),
        Verdict::Right
    );
}

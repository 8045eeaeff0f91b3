//! How often the interval of a fit contains the true order: measured on synthetic errors.

use crate::convergence::random::Random;
use rug::Float;
use volver::convergence::{Fit, Sample, Verdict, fit};
use volver::method::Expected;

/// Ladders of n = 4 … about 4096, of constant and of changing ratio.
fn ladder(random: &mut Random) -> Vec<u64> {
    let kind = random.below(4);
    let mut levels = vec![4 + random.below(6)];
    while let Some(n) = levels.last().copied().filter(|n| *n < 3000) {
        levels.push(match kind {
            0 | 1 => 2 * n,
            2 => 3 * n,
            _ => n + n / 2 + random.below(n),
        });
    }
    levels
}

/// e = c·dᵖ(1 + a·d + b·d²) + noise with unit roundoff `unit`; the floor is what a comparison with
/// a run of high precision would show: max(|noise|, unit).
fn samples(random: &mut Random, order: f64, unit: f64) -> Vec<Sample> {
    let c = 10_f64.powf(random.uniform(-3.0, 1.0)) * random.sign();
    let (a, b) = (random.uniform(-3.0, 3.0), random.uniform(-5.0, 5.0));
    let growth = [0.0, 0.5, 1.0][usize::try_from(random.below(3)).unwrap()];
    ladder(random)
        .into_iter()
        .map(|n| {
            let d = 1.0 / n as f64;
            let noise = unit * (n as f64).powf(growth) * random.normal();
            let error = c * d.powf(order) * (1.0 + a * d + b * d * d) + noise;
            Sample {
                n: Some(n),
                step: d,
                error: Float::with_val(53, error),
                floor: Float::with_val(53, noise.abs().max(unit)),
            }
        })
        .collect()
}

struct Count {
    fitted: u32,
    covered: u32,
    falsely_confirmed: u32,
}

fn measure(unit: f64, trials: u32, seed: u64) -> Count {
    let mut random = Random::new(seed);
    let mut count = Count {
        fitted: 0,
        covered: 0,
        falsely_confirmed: 0,
    };
    for _ in 0..trials {
        let order = 0.5 * (1 + random.below(12)) as f64;
        let samples = samples(&mut random, order, unit);
        let free = fit(&samples, None).unwrap();
        let right = fit(&samples, Some(Expected::Order(order))).unwrap();
        if free.verdict == Verdict::Fitted {
            count.fitted += 1;
            let covers = |f: &Fit| (f.order.unwrap() - order).abs() <= f.half_width.unwrap();
            count.covered += u32::from(covers(&free));
            assert_eq!(right.verdict == Verdict::Confirmed, covers(&free));
        }
        for wrong in [order - 1.0, order - 0.5, order + 0.5, order + 1.0] {
            let verdict = fit(&samples, Some(Expected::Order(wrong))).unwrap().verdict;
            count.falsely_confirmed += u32::from(verdict == Verdict::Confirmed);
        }
    }
    count
}

/// `cargo test --release --test orders fit::coverage -- --nocapture` prints the figures.
#[test]
fn intervals_cover_the_true_order_and_never_confirm_a_wrong_one() {
    for (name, unit) in [
        ("binary32", 2_f64.powi(-24)),
        ("binary64", 2_f64.powi(-53)),
        ("no roundoff", 0.0),
    ] {
        let count = measure(unit, 20_000, 11);
        let coverage = f64::from(count.covered) / f64::from(count.fitted);
        println!(
            "{name}: {} of {} covered ({:.3} %), {} falsely confirmed",
            count.covered,
            count.fitted,
            100.0 * coverage,
            count.falsely_confirmed
        );
        assert!(count.fitted > 3000, "{name}: {} fitted", count.fitted);
        assert!(coverage >= 0.99, "{name}: coverage {coverage}");
        assert_eq!(count.falsely_confirmed, 0, "{name}");
    }
}

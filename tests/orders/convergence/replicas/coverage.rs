//! How often the intervals contain the true order: measured on synthetic replicas.

use super::noise::Noise;
use crate::convergence::random::Random;
use volver::convergence::{OrderInterval, Replicas, Verdict, fit_replicas};
use volver::method::Expected;

#[derive(Default)]
struct Count {
    deviation: u32,
    biases: u32,
    bias: u32,
    falsely_confirmed: u32,
}

/// Seven doublings of b·d + dᑫ·noise for q = ½, 1, 3/2.
fn measure(noise: Noise, replicas: usize, trials: u32) -> Count {
    let mut random = Random::new(5);
    let mut count = Count::default();
    let bias = 2.0;
    for trial in 0..trials {
        let q = 0.5 * f64::from(1 + trial % 3);
        let levels: Vec<Replicas> = (3..10)
            .map(|k| {
                let step = 0.5_f64.powi(k);
                let mut error = || bias * step + step.powf(q) * noise.draw(&mut random);
                Replicas {
                    n: None,
                    step,
                    floor: 0.0,
                    errors: (0..replicas).map(|_| error()).collect(),
                }
            })
            .collect();
        let wrong = Some(Expected::Order(q + 0.5));
        let fit = fit_replicas(&levels, wrong, u64::from(trial)).unwrap();
        let holds = |i: OrderInterval, order: f64| u32::from(i.low <= order && order <= i.high);
        count.deviation += holds(fit.deviation.unwrap(), q);
        count.falsely_confirmed += u32::from(fit.verdict == Verdict::Confirmed);
        if let Some(interval) = fit.bias {
            count.biases += 1;
            count.bias += holds(interval, 1.0);
        }
    }
    count
}

#[test]
fn intervals_hold_the_true_orders() {
    let count = measure(Noise::Normal, 30, 150);
    assert!(count.deviation >= 149, "{} of 150", count.deviation);
    assert!(
        count.bias + 2 >= count.biases,
        "{} of {}",
        count.bias,
        count.biases
    );
    assert!(count.biases > 100);
    assert_eq!(count.falsely_confirmed, 0);
}

/// `cargo test --release --test orders replicas::coverage -- --ignored --nocapture` prints the figures.
#[test]
#[ignore = "takes minutes: the figures in the documentation of fit_replicas"]
fn table_of_coverage() {
    for noise in [Noise::Normal, Noise::Uniform, Noise::ChiSquared] {
        for replicas in [8, 12, 30, 60] {
            let trials = 1500;
            let count = measure(noise, replicas, trials);
            println!(
                "{noise:?}, {replicas} replicas: deviation {:.2} %, bias {:.2} % of {}, {} falsely confirmed",
                100.0 * f64::from(count.deviation) / f64::from(trials),
                100.0 * f64::from(count.bias) / f64::from(count.biases),
                count.biases,
                count.falsely_confirmed
            );
        }
    }
}

//! Stochastic methods of known order: the fit, its coverage, and every verdict.

mod coverage;
mod noise;
mod truth;

use crate::convergence::random::Random;
use volver::convergence::{
    ErrorPart, OrderInterval, Replicas, ReplicasError, StochasticFit, Verdict, fit_replicas,
    reported_error,
};
use volver::method::Expected;

/// Seven doublings of bias·dᵖ + deviation·dᑫ·(a number of mean 0 and variance 1).
fn replicas(
    count: usize,
    seed: u64,
    mean: impl Fn(f64) -> f64,
    deviation: impl Fn(f64) -> f64,
) -> Vec<Replicas> {
    let mut random = Random::new(seed);
    (3..10_i32)
        .map(|k| {
            let step = 0.5_f64.powi(k);
            let error = |_| mean(step) + deviation(step) * random.normal();
            Replicas {
                n: Some(1 << k),
                step,
                floor: 0.0,
                errors: (0..count).map(error).collect(),
            }
        })
        .collect()
}

#[allow(clippy::unnecessary_wraps)] // What is expected is optional.
fn order(p: f64) -> Option<Expected> {
    Some(Expected::Order(p))
}

const BLIND: Option<Expected> = Some(Expected::Blind {
    general: 1.0,
    here: 2.0,
});

fn judged(levels: &[Replicas], expected: Option<Expected>) -> Verdict {
    fit_replicas(levels, expected, 1).unwrap().verdict
}

fn contains(interval: OrderInterval, order: f64) -> bool {
    interval.low <= order && order <= interval.high
}

#[test]
fn scatter_and_bias_have_orders_of_their_own() {
    let levels = replicas(60, 3, |d| 2.0 * d, |d| 0.3 * d.powf(1.5));
    let fit = fit_replicas(&levels, order(1.0), 1).unwrap();
    // The order of the error is the lower one.
    assert_eq!(fit.verdict, Verdict::Confirmed);
    assert_eq!(fit.larger, ErrorPart::Bias);
    assert_eq!(judged(&levels, order(1.5)), Verdict::TooLow);
    let (deviation, bias) = (fit.deviation.unwrap(), fit.bias.unwrap());
    assert!(
        contains(deviation, 1.5) && !contains(deviation, 1.0),
        "{deviation:?}"
    );
    assert!(contains(bias, 1.0) && !contains(bias, 1.5), "{bias:?}");
    assert!((deviation.log2_constant - 0.3_f64.log2()).abs() < 0.5);
    assert!((bias.log2_constant - 1.0).abs() < 0.1);
    assert_eq!((deviation.levels, bias.levels, fit.replicas), (7, 7, 60));
    assert_eq!(judged(&levels, order(2.0)), Verdict::TooLow);
    assert_eq!(judged(&levels, order(0.5)), Verdict::TooHigh);
    assert_eq!(judged(&levels, Some(Expected::Exact)), Verdict::TooLow);
    assert_eq!(judged(&levels, None), Verdict::Fitted);
    assert_eq!(judged(&levels, BLIND), Verdict::Blind);
}

#[test]
fn moments_of_a_worked_example() {
    let errors = [1.0, 2.0, 3.0, 4.0, 1.0, 2.0, 3.0, 4.0];
    let level = |step: f64| Replicas {
        n: None,
        step,
        floor: 0.0,
        errors: errors.iter().map(|e| e * step).collect(),
    };
    let levels = [8.0, 4.0, 2.0, 1.0].map(level);
    let fit = fit_replicas(&levels, None, 1).unwrap();
    // Mean 2.5, Σ(e − 2.5)² = 10, variance 10/7, standard error √(10/7/8).
    let moments = fit.levels[3];
    assert!((moments.mean - 2.5).abs() < 1e-15);
    assert!((moments.deviation - (10.0_f64 / 7.0).sqrt()).abs() < 1e-15);
    assert!((moments.standard_error - (10.0_f64 / 56.0).sqrt()).abs() < 1e-15);
    // t = 2.5/√(10/56) = 5.9; of 8 replicas and 4 levels the quantile is 11.7.
    assert!(!moments.biased && moments.above_floor);
    assert_eq!(fit.bias, None);
    // All levels are multiples of one another: whatever is resampled, the order is 1. It is believed to 2 % a level:
    // 3.2905·0.02/ln 2 over √Σ(x − x̄)² = √5.
    let interval = fit.deviation.unwrap();
    assert!((interval.order - 1.0).abs() < 1e-12);
    let believed = 3.290_527 * 0.02 / 2_f64.ln() / 5_f64.sqrt();
    assert!((interval.half_width() - believed).abs() < 1e-6);
    let three = fit_replicas(&levels[..3], None, 1).unwrap();
    assert_eq!(
        (three.verdict, three.deviation),
        (Verdict::TooFewLevels, None)
    );
}

#[test]
fn a_bias_lost_in_the_scatter_has_no_order() {
    let levels = replicas(30, 5, |_| 0.0, |d| d);
    assert_eq!(fit_replicas(&levels, order(1.0), 1).unwrap().bias, None);
    // Significant at the coarse levels is enough, and the means of all levels count.
    let fit = fit_replicas(&replicas(30, 5, |d| 30.0 * d * d, |d| d), order(1.0), 1).unwrap();
    let bias = fit.bias.unwrap();
    assert!(bias.levels == 7 && contains(bias, 2.0), "{bias:?}");
    // Of 30 replicas and 7 levels, the quantile of t at 3e-5/7 on two sides, by scipy: 5.641.
    for level in &fit.levels {
        let errors = level.mean.abs() / level.standard_error;
        assert_eq!(level.biased, errors > 5.641, "{errors}");
    }
    assert!(fit.levels[0].biased && !fit.levels[6].biased);
}

#[test]
fn a_bias_that_stays_is_stalled_whatever_the_scatter_does() {
    let stays = replicas(60, 7, |_| 0.1, |d| 0.2 * d);
    assert_eq!(judged(&stays, order(1.0)), Verdict::Stalled);
    assert_eq!(judged(&stays, BLIND), Verdict::Stalled);
    let grows = replicas(60, 7, |d| 0.01 / d, |d| 0.2 * d);
    assert_eq!(judged(&grows, order(1.0)), Verdict::Diverged);
    // Seen, but still below the scatter at the finest level: more levels would tell.
    let below = replicas(60, 7, |_| 0.001, |d| d);
    assert_eq!(judged(&below, order(1.0)), Verdict::Confirmed);
}

/// Seventeen standard errors at the finest level, where the bias is still a small part of the scatter.
#[test]
fn a_bias_that_may_stay_is_never_confirmed() {
    let finest = 0.5_f64.powi(9);
    let bias = 17.0 * finest.powf(1.5) / 60_f64.sqrt();
    for seed in 0..5 {
        let fit = fit_replicas(
            &replicas(60, seed, |_| bias, |d| d.powf(1.5)),
            order(1.5),
            1,
        );
        let fit = fit.unwrap();
        assert_eq!(fit.verdict, Verdict::TooLow);
        assert!(fit.bias_may_stay && fit.most_biased().unwrap().step == finest);
        // Where no order is expected it is said all the same.
        let half = fit_replicas(&replicas(60, seed, |_| bias, |d| d.powf(1.5)), None, 1);
        assert!(half.unwrap().bias_may_stay);
    }
    // A bias that falls faster than the scatter is none that stays.
    let falls = replicas(60, 1, |d| 20.0 * d * d, |d| d.powf(1.5));
    let fit = fit_replicas(&falls, order(1.5), 1).unwrap();
    assert_eq!(
        (fit.verdict, fit.bias_may_stay),
        (Verdict::Confirmed, false)
    );
    assert!(contains(fit.bias.unwrap(), 2.0));
}

#[test]
fn the_floor_ends_a_ladder_by_the_larger_error() {
    // A bias 20 000 times the scatter, whose scatter lies below the floor.
    let mut levels = replicas(30, 2, |d| d * d, |d| 5e-5 * d * d);
    for level in &mut levels {
        level.floor = 1e-7;
    }
    let fit = fit_replicas(&levels, order(2.0), 1).unwrap();
    assert_eq!(fit.verdict, Verdict::Confirmed);
    assert_eq!((fit.larger, fit.deviation), (ErrorPart::Bias, None));
    assert!(contains(fit.bias.unwrap(), 2.0));
    assert_eq!(judged(&levels, order(3.0)), Verdict::TooLow);
    assert_eq!(judged(&levels, order(1.0)), Verdict::TooHigh);
}

/// s = d^(3/2)/(1 + (16d)²): flat at n = 8, of order 3/2 from 64 on.
#[test]
fn coarse_levels_that_are_not_asymptotic_do_not_belong_to_the_fit() {
    let starts = |d: f64| d.powf(1.5) / (1.0 + (16.0 * d).powi(2));
    for seed in 0..5 {
        let levels = replicas(60, seed, |_| 0.0, starts);
        let fit = fit_replicas(&levels, order(1.5), 1).unwrap();
        assert!(fit.deviation.is_none_or(|i| i.levels < 7));
        assert!(matches!(
            fit.verdict,
            Verdict::Confirmed | Verdict::PreAsymptotic
        ));
    }
}

#[test]
fn reported_standard_errors_are_compared_with_the_scatter() {
    let levels = replicas(30, 4, |_| 0.0, |d| d);
    let times = |factor: f64| -> Vec<Vec<f64>> {
        let of = |level: &Replicas| vec![factor * level.step; 30];
        levels.iter().map(of).collect()
    };
    for (factor, wrong) in [
        (0.1, true),
        (0.4, true),
        (1.0, false),
        (1.2, false),
        (2.5, true),
        (10.0, true),
    ] {
        let found = reported_error(&levels, &times(factor), 1).unwrap();
        assert_eq!(found.is_wrong(), wrong, "{factor}: {found:?}");
        // Four levels of 30 replicas: 0.13/√4 each way.
        assert!((found.ratio / factor).ln().abs() < 0.3, "{found:?}");
        assert!(found.low < found.ratio && found.ratio < found.high);
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY, 0.0] {
        let mut reported = times(1.0);
        reported[6] = vec![bad; 30];
        let found = reported_error(&levels, &reported, 1).unwrap();
        assert!(found.is_wrong(), "{bad}: {found:?}");
    }
    let mut incomplete = times(1.0);
    incomplete[6].pop();
    assert_eq!(reported_error(&levels, &incomplete, 1), None);
    assert_eq!(reported_error(&levels[..3], &times(1.0), 1), None);
    let constant = replicas(30, 4, |d| d, |_| 0.0);
    assert_eq!(reported_error(&constant, &times(1.0), 1), None);
}

#[test]
fn scatter_that_does_not_fall_is_no_convergence() {
    assert_eq!(
        judged(&replicas(60, 9, |_| 0.0, |_| 0.1), order(0.5)),
        Verdict::Stalled
    );
    assert_eq!(
        judged(&replicas(60, 9, |_| 0.0, |d| 0.1 / d), order(0.5)),
        Verdict::Diverged
    );
}

#[test]
fn few_replicas_leave_too_wide_an_interval() {
    let levels = replicas(8, 11, |_| 0.0, |d| d);
    let fit = fit_replicas(&levels, order(1.0), 1).unwrap();
    let interval = fit.deviation.unwrap();
    assert!(interval.high - interval.low > 0.5);
    assert_eq!(fit.verdict, Verdict::PreAsymptotic);
}

#[test]
fn the_floor_cuts_as_in_a_deterministic_fit() {
    let with_floor = |floor: f64| {
        let mut levels = replicas(60, 13, |_| 0.0, |d| d);
        for level in &mut levels {
            level.floor = floor;
        }
        fit_replicas(&levels, order(1.0), 1).unwrap()
    };
    let above = |fit: &StochasticFit| fit.levels.iter().filter(|l| l.above_floor).count();
    // 30·3e-4 = 0.009 lies between 1/64 and 1/128.
    let four = with_floor(3e-4);
    assert_eq!(above(&four), 4);
    assert_eq!(four.deviation.unwrap().levels, 4);
    // Two levels are too few for an order.
    let two = with_floor(1.5e-3);
    assert_eq!((above(&two), two.deviation), (2, None));
    assert_eq!(two.verdict, Verdict::FloorLimited);
    let none = with_floor(1.0);
    assert_eq!((above(&none), none.verdict), (0, Verdict::Exact));
    // A floor at one level holds for all finer ones.
    let mut once = replicas(60, 13, |_| 0.0, |d| d);
    once[4].floor = 1.0;
    assert_eq!(above(&fit_replicas(&once, None, 1).unwrap()), 4);
}

#[test]
fn replicas_that_agree_exactly_are_exact_only_without_an_error() {
    let exact = replicas(10, 1, |_| 0.0, |_| 0.0);
    assert_eq!(judged(&exact, Some(Expected::Exact)), Verdict::Exact);
    assert_eq!(judged(&exact, order(1.0)), Verdict::Exact);
    assert_eq!(judged(&exact, BLIND), Verdict::Blind);
    // A deterministic method by mistake: no scatter, but an error.
    let biased = replicas(10, 1, |d| d, |_| 0.0);
    assert_eq!(judged(&biased, order(1.0)), Verdict::FloorLimited);
    assert_eq!(judged(&biased, BLIND), Verdict::Blind);
    assert_eq!(
        judged(&biased, Some(Expected::Exact)),
        Verdict::FloorLimited
    );
}

#[test]
fn values_that_are_not_finite_decide() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut levels = replicas(10, 1, |_| 0.0, |d| d);
        levels[3].errors[4] = bad;
        for expected in [order(1.0), BLIND] {
            let fit = fit_replicas(&levels, expected, 1).unwrap();
            assert_eq!(fit.verdict, Verdict::NotFinite);
            assert_eq!((fit.deviation, fit.bias), (None, None));
        }
    }
}

#[test]
fn a_seed_decides_the_interval_and_nothing_else() {
    let levels = replicas(20, 17, |_| 0.0, |d| d);
    let fit = |seed| fit_replicas(&levels, order(1.0), seed).unwrap();
    assert_eq!(fit(1), fit(1));
    let (a, b) = (fit(1).deviation.unwrap(), fit(2).deviation.unwrap());
    assert_eq!(a.order, b.order);
    assert_ne!(a.low, b.low);
    assert!((a.low - b.low).abs() < 0.1 * (a.high - a.low));
}

#[test]
fn bad_input_is_named() {
    let good = replicas(8, 1, |_| 0.0, |d| d);
    assert!(fit_replicas(&good, None, 1).is_ok());
    let refused = |change: &dyn Fn(&mut Vec<Replicas>)| {
        let mut levels = good.clone();
        change(&mut levels);
        fit_replicas(&levels, None, 1).unwrap_err()
    };
    assert_eq!(
        refused(&|l| l.truncate(2)),
        ReplicasError::TooFewLevels { levels: 2 }
    );
    assert_eq!(
        refused(&Vec::clear),
        ReplicasError::TooFewLevels { levels: 0 }
    );
    assert_eq!(
        refused(&|l| l[2].errors.truncate(7)),
        ReplicasError::TooFewReplicas {
            level: 2,
            replicas: 7
        }
    );
    assert_eq!(
        refused(&|l| l[1].errors.push(0.0)),
        ReplicasError::Unequal {
            level: 1,
            replicas: 9,
            allowed: 8
        }
    );
    for step in [0.0, -1.0, f64::INFINITY, 1.0] {
        assert_eq!(
            refused(&|l| l[1].step = step),
            ReplicasError::Step { level: 1, step }
        );
    }
    let same = good[0].step;
    assert_eq!(
        refused(&|l| l[1].step = same),
        ReplicasError::Step {
            level: 1,
            step: same
        }
    );
    for floor in [-1.0, f64::INFINITY] {
        assert_eq!(
            refused(&|l| l[1].floor = floor),
            ReplicasError::Floor { level: 1, floor }
        );
    }
    let infinite = Some(Expected::Order(f64::INFINITY));
    assert!(matches!(
        fit_replicas(&good, infinite, 1),
        Err(ReplicasError::Expectation { .. })
    ));
}

/// A feature that no replica of one level has hit: their errors agree, and are no bias.
#[test]
fn replicas_that_agree_by_chance_have_no_standard_error_of_their_own() {
    let mut levels = replicas(30, 21, |_| 0.0, |d| d);
    levels[5].errors = vec![-0.1 * levels[5].step; 30];
    let fit = fit_replicas(&levels, order(1.0), 1).unwrap();
    assert!(fit.levels.iter().all(|level| !level.biased));
    // Far off what scatters at the level before, they are.
    levels[5].errors = vec![-10.0 * levels[5].step; 30];
    let fit = fit_replicas(&levels, order(1.0), 1).unwrap();
    assert!(fit.levels[5].biased && !fit.levels[4].biased);
}

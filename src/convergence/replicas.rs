//! The order of a stochastic method from seeded replicas.

use super::FLOOR_MARGIN;
use super::bootstrap::{Resampler, quantile};
use super::line::least_squares;
use super::verdict::{MAX_HALF_WIDTH, NO_CONVERGENCE, Verdict};
use super::window::MIN_WINDOW;
use crate::method::Expected;
use serde::Serialize;

/// Fewest replicas a level may have.
pub const MIN_REPLICAS: usize = 8;
/// Fewest levels a stochastic order is fitted to.
const MIN_LEVELS: usize = 3;
/// Bootstrap resamples: the outer 0.05 % on each side are then ten resamples.
const RESAMPLES: usize = 20_000;
/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.999;
/// A mean of fewer standard errors than this may be noise.
const SIGNIFICANT: f64 = 2.0;
/// A bias dominates where it exceeds the standard deviation by this many standard errors.
const DOMINANT: f64 = 3.0;

/// One level of a stochastic method: the signed errors of independent seeded runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replicas {
    /// Number of segments, where the step divides the ray.
    pub n: Option<u64>,
    /// Step d > 0.
    pub step: f64,
    /// Signed errors, one a replica; replica r of every level comes from the same seed or from
    /// independent ones, either will do.
    pub errors: Vec<f64>,
    /// Magnitude below which an error is roundoff; 0 where none is known.
    pub floor: f64,
}

/// An order with its 99.9 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OrderInterval {
    /// The order p.
    pub order: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// log₂ c in c·dᵖ.
    pub log2_constant: f64,
    /// Levels the fit rests on.
    pub levels: usize,
}

/// Mean and standard deviation of one level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LevelMoments {
    /// Number of segments, where known.
    pub n: Option<u64>,
    /// Step.
    pub step: f64,
    /// Mean error: the bias.
    pub mean: f64,
    /// Standard deviation of the errors (R − 1 in the denominator).
    pub deviation: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
    /// The standard deviation stands above the floor.
    pub above_floor: bool,
    /// The mean stands above the floor and exceeds two standard errors.
    pub biased: bool,
}

/// The orders of a stochastic method: of its scatter, and of its bias.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StochasticFit {
    /// What the standard deviation's order says of the expectation.
    pub verdict: Verdict,
    /// Order of the standard deviation; `None` with fewer than three levels above the floor.
    pub deviation: Option<OrderInterval>,
    /// Order of the bias; `None` where fewer than three levels show a significant one.
    pub bias: Option<OrderInterval>,
    /// What was fitted, coarse to fine.
    pub levels: Vec<LevelMoments>,
    /// Replicas a level.
    pub replicas: usize,
}

/// Replicas that no fit can take.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ReplicasError {
    /// Too few levels.
    #[error("{levels} levels are too few for a stochastic fit (allowed: {MIN_LEVELS} or more)")]
    TooFewLevels {
        /// Levels given.
        levels: usize,
    },
    /// Too few replicas at a level.
    #[error("{replicas} replicas at level {level} are too few (allowed: {MIN_REPLICAS} or more)")]
    TooFewReplicas {
        /// Index of the level.
        level: usize,
        /// Replicas given.
        replicas: usize,
    },
    /// Levels have different numbers of replicas.
    #[error("{replicas} replicas at level {level} (allowed: {allowed}, as at level 0)")]
    Unequal {
        /// Index of the level.
        level: usize,
        /// Replicas given.
        replicas: usize,
        /// Replicas at level 0.
        allowed: usize,
    },
    /// A step is not positive, or does not lie below the one before it.
    #[error(
        "step {step} of level {level} is not allowed (allowed: finite, above 0, strictly decreasing)"
    )]
    Step {
        /// Index of the level.
        level: usize,
        /// The step.
        step: f64,
    },
    /// A floor is negative or not finite.
    #[error(
        "floor {floor} of level {level} is not allowed (allowed: finite, 0 where unknown, or above)"
    )]
    Floor {
        /// Index of the level.
        level: usize,
        /// The floor.
        floor: f64,
    },
    /// The expected order is no number.
    #[error("expected order {order} is not allowed (allowed: finite numbers)")]
    Expectation {
        /// The order.
        order: f64,
    },
}

/// Fits the orders of the standard deviation and of the bias over all levels above the floor.
///
/// Least squares in log–log, separately: the standard deviation with equal weights
/// (var ln s ≈ 1/(2(R − 1)) at every level), the bias weighted by (mean/standard error)² over the
/// levels where the mean exceeds two standard errors. Pairwise orders scatter too much for a
/// window, so that pre-asymptotic levels are the caller's to leave out.
///
/// Intervals hold 99.9 %: a bootstrap of 20 000 resamples of whole replicas, drawn with `seed`
/// (PCG64; the draws are the same on every platform).
///
/// The verdict is that of the standard deviation against `expected`, by the words of [`Verdict`]: `Confirmed`
/// where the expected order lies in an interval of half-width ≤ 0.25, `TooLow`, `TooHigh`,
/// `PreAsymptotic` (too wide), `FloorLimited`, `Exact` (every error of every level at the floor),
/// `Stalled`, `Diverged`, `NotFinite`, `TooFewLevels` (fewer than 4), `Blind`, `Fitted`.
/// `Stalled` also where the *bias* does not converge (|p| < 0.1) and exceeds the standard
/// deviation at the finest level by more than three standard errors: more samples would then not help.
///
/// # Errors
///
/// [`ReplicasError`] with fewer than 3 levels, fewer than 8 replicas, unequal numbers of them, steps that
/// are not positive and strictly decreasing, bad floors, or an expected order that is not finite.
pub fn fit_replicas(
    levels: &[Replicas],
    expected: Option<Expected>,
    seed: u64,
) -> Result<StochasticFit, ReplicasError> {
    let replicas = check(levels, expected)?;
    let finite = levels
        .iter()
        .all(|l| l.errors.iter().all(|e| e.is_finite()));
    let all: Vec<usize> = (0..replicas).collect();
    let mut floor = 0.0_f64;
    let mut cut = false;
    let moments: Vec<LevelMoments> = levels
        .iter()
        .map(|level| {
            let (mean, deviation) = mean_and_deviation(&level.errors, &all);
            let standard_error = deviation / (replicas as f64).sqrt();
            floor = floor.max(level.floor);
            let margin = f64::from(FLOOR_MARGIN) * floor;
            cut = cut || deviation <= margin;
            LevelMoments {
                n: level.n,
                step: level.step,
                mean,
                deviation,
                standard_error,
                above_floor: !cut,
                biased: mean.abs() > margin && mean.abs() >= SIGNIFICANT * standard_error,
            }
        })
        .collect();
    let (deviation, bias) = if finite {
        intervals(levels, &moments, replicas, seed)
    } else {
        (None, None)
    };
    let mut fit = StochasticFit {
        verdict: Verdict::NotFinite,
        deviation,
        bias,
        levels: moments,
        replicas,
    };
    if finite {
        fit.verdict = judge(&fit, expected);
    }
    Ok(fit)
}

/// Refuses what no verdict covers; the number of replicas.
fn check(levels: &[Replicas], expected: Option<Expected>) -> Result<usize, ReplicasError> {
    let allowed = levels.first().map_or(0, |l| l.errors.len());
    if levels.len() < MIN_LEVELS {
        return Err(ReplicasError::TooFewLevels {
            levels: levels.len(),
        });
    }
    let mut previous = f64::INFINITY;
    for (level, l) in levels.iter().enumerate() {
        let replicas = l.errors.len();
        if replicas < MIN_REPLICAS {
            return Err(ReplicasError::TooFewReplicas { level, replicas });
        }
        if replicas != allowed {
            return Err(ReplicasError::Unequal {
                level,
                replicas,
                allowed,
            });
        }
        let step = l.step;
        if !step.is_finite() || step <= 0.0 || step >= previous {
            return Err(ReplicasError::Step { level, step });
        }
        previous = step;
        let floor = l.floor;
        if !floor.is_finite() || floor < 0.0 {
            return Err(ReplicasError::Floor { level, floor });
        }
    }
    match expected {
        Some(Expected::Order(order)) if !order.is_finite() => {
            Err(ReplicasError::Expectation { order })
        }
        _ => Ok(allowed),
    }
}

/// Mean and standard deviation of the replicas chosen. Equal errors have deviation 0 exactly.
fn mean_and_deviation(errors: &[f64], chosen: &[usize]) -> (f64, f64) {
    let count = chosen.len() as f64;
    let first = chosen.first().map_or(0.0, |r| errors[*r]);
    let shift = chosen.iter().map(|r| errors[*r] - first).sum::<f64>() / count;
    let squares: f64 = chosen
        .iter()
        .map(|r| (errors[*r] - first - shift).powi(2))
        .sum();
    (first + shift, (squares / (count - 1.0)).sqrt())
}

type Intervals = (Option<OrderInterval>, Option<OrderInterval>);

/// Both orders with their bootstrap intervals.
fn intervals(
    levels: &[Replicas],
    moments: &[LevelMoments],
    replicas: usize,
    seed: u64,
) -> Intervals {
    let scatter: Vec<usize> = (0..levels.len())
        .filter(|i| moments[*i].above_floor)
        .collect();
    let biased: Vec<usize> = (0..levels.len())
        .filter(|i| moments[*i].above_floor && moments[*i].biased)
        .collect();
    let line = |which: &[usize], value: &dyn Fn(usize) -> (f64, f64)| {
        if which.len() < MIN_LEVELS {
            return None;
        }
        let points: Vec<(f64, f64, f64)> = which
            .iter()
            .map(|i| {
                let (magnitude, weight) = value(*i);
                (levels[*i].step.log2(), magnitude.abs().log2(), weight)
            })
            .collect();
        least_squares(&points)
    };
    let weight = |i: usize| (moments[i].mean / moments[i].standard_error).powi(2);
    let deviation = line(&scatter, &|i| (moments[i].deviation, 1.0));
    let bias = line(&biased, &|i| (moments[i].mean, weight(i)));

    let mut resampler = Resampler::new(seed);
    let mut chosen = vec![0; replicas];
    let mut resampled = vec![(0.0, 0.0); levels.len()];
    let (mut deviations, mut biases) = (Vec::new(), Vec::new());
    for _ in 0..RESAMPLES {
        resampler.draw(&mut chosen);
        for (target, level) in resampled.iter_mut().zip(levels) {
            *target = mean_and_deviation(&level.errors, &chosen);
        }
        deviations.extend(line(&scatter, &|i| (resampled[i].1, 1.0)).map(|l| l.slope));
        biases.extend(line(&biased, &|i| (resampled[i].0, weight(i))).map(|l| l.slope));
    }
    let interval = |line: Option<super::line::Line>, slopes: Vec<f64>, levels: usize| {
        let line = line?;
        let (low, high) = percentiles(slopes, replicas)?;
        Some(OrderInterval {
            order: line.slope,
            low,
            high,
            log2_constant: line.intercept,
            levels,
        })
    };
    (
        interval(deviation, deviations, scatter.len()),
        interval(bias, biases, biased.len()),
    )
}

/// The ends of the central interval of bootstrap slopes.
fn percentiles(mut slopes: Vec<f64>, _replicas: usize) -> Option<(f64, f64)> {
    slopes.retain(|s| s.is_finite());
    slopes.sort_by(f64::total_cmp);
    let tail = (1.0 - CONFIDENCE) / 2.0;
    Some((quantile(&slopes, tail)?, quantile(&slopes, 1.0 - tail)?))
}

/// The verdict of finite errors.
fn judge(fit: &StochasticFit, expected: Option<Expected>) -> Verdict {
    let blind = matches!(expected, Some(Expected::Blind { .. }));
    if fit.levels.len() < MIN_WINDOW {
        return Verdict::TooFewLevels;
    }
    if fit.levels.iter().all(|l| !l.above_floor && !l.biased) {
        return if blind {
            Verdict::Blind
        } else {
            Verdict::Exact
        };
    }
    if let (Some(bias), Some(finest)) = (fit.bias, fit.levels.last()) {
        let dominates = finest.mean.abs() - DOMINANT * finest.standard_error > finest.deviation;
        if dominates && bias.order < NO_CONVERGENCE {
            return no_convergence(bias.order);
        }
    }
    let cut = fit.levels.iter().any(|l| !l.above_floor);
    let Some(deviation) = fit.deviation else {
        return if blind {
            Verdict::Blind
        } else {
            Verdict::FloorLimited
        };
    };
    if deviation.order < NO_CONVERGENCE {
        return no_convergence(deviation.order);
    }
    if blind {
        return Verdict::Blind;
    }
    if (deviation.high - deviation.low) / 2.0 > MAX_HALF_WIDTH {
        return if cut {
            Verdict::FloorLimited
        } else {
            Verdict::PreAsymptotic
        };
    }
    match expected {
        None => Verdict::Fitted,
        Some(Expected::Order(p)) if p > deviation.high => Verdict::TooLow,
        Some(Expected::Order(p)) if p < deviation.low => Verdict::TooHigh,
        Some(Expected::Order(_)) => Verdict::Confirmed,
        Some(Expected::Exact) => Verdict::TooLow,
        Some(Expected::Blind { .. }) => Verdict::Blind,
    }
}

/// `Stalled` or `Diverged`, by the sign of what is left of the order.
fn no_convergence(order: f64) -> Verdict {
    if order <= -NO_CONVERGENCE {
        Verdict::Diverged
    } else {
        Verdict::Stalled
    }
}

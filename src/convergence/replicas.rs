//! The order of a stochastic method from seeded replicas.

mod bias;
mod contrast;
mod input;
mod interval;
mod judge;
pub(crate) mod moments;
mod reported;
mod scatter;

pub use input::{MIN_REPLICAS, ReplicasError};
pub use reported::{ReportedError, reported_error};

use super::verdict::Verdict;
use crate::method::Expected;
use input::check;
use interval::Resampled;
use judge::judge;
use serde::Serialize;

/// How far a power law is believed, as a part of the error: whatever the number of replicas, levels that differ from it by
/// less are no evidence against it, and no interval is narrower than that allows.
const BELIEVED: f64 = 0.02;

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
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct OrderInterval {
    /// The order p.
    pub order: f64,
    /// Lower end; −∞ (`null` in JSON) where the levels leave it open.
    #[cfg_attr(feature = "studies", schemars(with = "Option<f64>"))]
    pub low: f64,
    /// Upper end; ∞ (`null` in JSON) where the levels leave it open.
    #[cfg_attr(feature = "studies", schemars(with = "Option<f64>"))]
    pub high: f64,
    /// log₂ c in c·dᵖ.
    pub log2_constant: f64,
    /// Levels the fit rests on: so many of the finest that stand above the floor.
    pub levels: usize,
}

impl OrderInterval {
    /// (high − low)/2.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        (self.high - self.low) / 2.0
    }

    fn holds(&self, order: f64) -> bool {
        self.low <= order && order <= self.high
    }
}

/// Mean and standard deviation of one level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
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
    /// The standard deviation stands above the floor, here and at all coarser levels.
    pub above_floor: bool,
    /// The mean stands above the floor and is not 0 by chance: see [`fit_replicas`].
    pub biased: bool,
}

/// One of the two parts that the error of a stochastic method has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ErrorPart {
    /// The standard deviation over seeds.
    Scatter,
    /// The mean error.
    Bias,
}

/// The orders of a stochastic method: of its scatter, and of its bias.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct StochasticFit {
    /// What both orders say of the expectation.
    pub verdict: Verdict,
    /// Order of the standard deviation; `None` where no four fine levels above the floor keep to one.
    pub deviation: Option<OrderInterval>,
    /// Order of the bias; `None` where no mean is significant, or no four fine levels keep to one.
    pub bias: Option<OrderInterval>,
    /// The part that is larger at the finest level above the floor.
    pub larger: ErrorPart,
    /// A mean is significant at one of the finest levels, and does not fall for all that is known.
    pub bias_may_stay: bool,
    /// What was fitted, coarse to fine.
    pub levels: Vec<LevelMoments>,
    /// Replicas a level.
    pub replicas: usize,
}

impl StochasticFit {
    /// The order of one part.
    #[must_use]
    pub fn order_of(&self, part: ErrorPart) -> Option<OrderInterval> {
        match part {
            ErrorPart::Scatter => self.deviation,
            ErrorPart::Bias => self.bias,
        }
    }

    /// The level whose mean is the most standard errors away from 0, of those where it is significant.
    #[must_use]
    pub fn most_biased(&self) -> Option<&LevelMoments> {
        let biased = self.levels.iter().filter(|level| level.biased);
        let errors = |level: &LevelMoments| {
            if level.standard_error > 0.0 {
                level.mean.abs() / level.standard_error
            } else {
                0.0
            }
        };
        biased.max_by(|a, b| errors(a).total_cmp(&errors(b)))
    }
}

/// Fits the orders of the standard deviation and of the bias, each to the levels that keep to one.
///
/// **Scatter.** The order is the slope of log₂ s against log₂ d over the longest fine-side run of at least four levels
/// above the floor that a test of fit leaves: neither is the run bent by two standard errors, nor is its first or last
/// level 2½ off the line of the others. Standard errors and intervals are those of 20 000 resamples of whole replicas (PCG64 from
/// `seed`; the same on every platform), percentiles widened by the t-distribution of R − 1 degrees of freedom and √(R/(R − 1)): on
/// normal and uniform errors they hold 99.9 %, on skewed χ² errors 99.5 % (`tests/orders/convergence/replicas/coverage.rs`).
///
/// An order is only *contradicted* where four readings exclude it on the same side: that run, the finest four
/// levels, a line with a term of the next order over all levels, c·dᵖ(1 + a·d), and the slope at the fine end of a parabola.
///
/// **Bias.** A mean is significant where |m|/(s/√R), and the same corrected for the skewness of the errors (Hall 1992),
/// both exceed the t-quantile of 3·10⁻⁵/L for L levels: without a bias a channel has one in at most one case of 10 000. Its order is that of b·dᵝ with the
/// least Σ((m − b·dᵝ)/σ)² over the longest fine-side run that a χ² test at 1 % leaves; all means count, significant or not. The
/// interval is where that sum exceeds the least by the 99.9 % quantile; an end may be open.
///
/// **Verdict**, by the words of [`Verdict`]. The order of the error is the lower one of both. `TooLow` where either
/// is lower than expected (of a bias the finest four levels alone must say so too), `Stalled` and `Diverged` where it is below
/// 0.1, `TooHigh` where both are higher. `Confirmed` where the scatter, or a larger bias, has the order
/// expected with a half-width of at most 0.25, and no significant bias may be of order 0 for all that is known. The floor ends a
/// ladder where it exceeds the larger part: a bias is seen however small the scatter. Replicas that are all equal confirm nothing.
///
/// Measured (`tests/orders/convergence/replicas/truth.rs`): the rates of wrong firm verdicts, family by family.
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
    let moments = moments::of(levels, replicas);
    let mut fit = StochasticFit {
        verdict: Verdict::NotFinite,
        deviation: None,
        bias: None,
        larger: ErrorPart::Scatter,
        bias_may_stay: false,
        levels: moments,
        replicas,
    };
    if !finite {
        return Ok(fit);
    }
    let usable = fit.levels.iter().take_while(|l| l.above_floor).count();
    let scatter = scatter::of(&levels[..usable], &Resampled::new(&levels[..usable], seed));
    // What lies at the floor says nothing of either part.
    let seen = fit.levels.iter().rposition(|l| l.above_floor || l.biased);
    let end = seen.map_or(0, |last| last + 1);
    let bias = bias::of(&fit.levels[..end], levels, replicas);
    fit.deviation = scatter.interval;
    fit.bias = bias.interval;
    fit.bias_may_stay = bias.may_stay();
    if let Some(finest) = seen.and_then(|last| fit.levels.get(last))
        && finest.biased
        && finest.mean.abs() > finest.deviation
    {
        fit.larger = ErrorPart::Bias;
    }
    fit.verdict = judge(&fit, &scatter, &bias, expected);
    Ok(fit)
}

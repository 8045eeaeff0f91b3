//! Orders from values alone, where no exact result is known.

use super::fit::check_steps;
use super::verdict::Verdict;
use super::{Fit, FitError, Note, Sample, fit};
use crate::method::Expected;
use rug::Float;
use serde::Serialize;

/// Rounds of the fixed point before it counts as unsettled.
const ROUNDS: usize = 60;
/// A change of the order smaller than this is settled.
const SETTLED: f64 = 1e-9;
/// Orders between −this and this count as this: at order 0 differences say nothing of errors.
const SMALLEST_ORDER: f64 = 1e-3;
/// Orders looked at.
const ORDERS: (f64, f64) = (-40.0, 40.0);

/// The value of one run at one level.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueSample {
    /// Number of segments, where the step divides the ray.
    pub n: Option<u64>,
    /// Step d > 0.
    pub step: f64,
    /// The value, with all the digits it has.
    pub value: Float,
    /// Magnitude of the roundoff in the value; 0 where none is known.
    pub floor: Float,
}

/// A fit to the errors that differences of values imply.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DifferenceFit {
    /// The fit.
    pub fit: Fit,
    /// The implied errors, one fewer than the values.
    pub samples: Vec<Sample>,
}

/// Values that no fit can take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RichardsonError {
    /// As for errors.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Differences cannot show exactness: a constant wrong value has none either.
    #[error(
        "an exact method cannot be told from differences of values (allowed: an expected order, or an exact value)"
    )]
    Exact,
}

/// Fits the order to which values converge, from the differences of neighbouring levels.
///
/// With e = c·dᵖ, vᵢ − vᵢ₊₁ = eᵢ·(1 − (dᵢ₊₁/dᵢ)ᵖ). The p of the last three values starts a fixed point:
/// eᵢ from the differences and p, p from [`fit`](fit()). For a constant ratio the factor is the same at
/// every level, and the order that of the differences. One level is lost.
///
/// The limit is not seen: values that converge to a wrong limit pass. Equal values are
/// `Stalled`, never `Exact`.
///
/// # Errors
///
/// [`RichardsonError`]: the errors of [`fit`](fit()), or `Exact` expected.
pub fn fit_differences(
    values: &[ValueSample],
    expected: Option<Expected>,
) -> Result<DifferenceFit, RichardsonError> {
    if expected == Some(Expected::Exact) {
        return Err(RichardsonError::Exact);
    }
    check_steps(values.iter().map(|v| v.step))?;
    let mut order = start(values).unwrap_or(1.0);
    let mut samples = errors(values, order);
    let mut result = fit(&samples, expected)?;
    let mut settled = false;
    for _ in 0..ROUNDS {
        let next = result.order.unwrap_or(order).clamp(ORDERS.0, ORDERS.1);
        settled = (next - order).abs() <= SETTLED;
        if settled {
            break;
        }
        order = next;
        samples = errors(values, order);
        result = fit(&samples, expected)?;
    }
    if result.verdict == Verdict::Exact {
        result.verdict = if result.floor.is_zero() {
            Verdict::Stalled
        } else {
            Verdict::FloorLimited
        };
    }
    if !settled && result.order.is_some() {
        result.notes.push(Note::Unsettled);
        if result.window.is_some() {
            result.verdict = Verdict::PreAsymptotic;
        }
    }
    result.notes.push(Note::FromDifferences);
    Ok(DifferenceFit {
        fit: result,
        samples,
    })
}

/// Errors that the differences imply if the order is `order`.
fn errors(values: &[ValueSample], order: f64) -> Vec<Sample> {
    let magnitude = order.abs().max(SMALLEST_ORDER);
    let order = if order < 0.0 { -magnitude } else { magnitude };
    values
        .windows(2)
        .map(|pair| {
            let bits = pair[0].value.prec().max(pair[1].value.prec());
            // 1 − ρᵖ without cancellation near ρ = 1.
            let factor = -(order * (pair[1].step / pair[0].step).ln()).exp_m1();
            let difference = Float::with_val(bits, &pair[0].value - &pair[1].value);
            let floor = Float::with_val(bits, &pair[0].floor + &pair[1].floor);
            Sample {
                n: pair[0].n,
                step: pair[0].step,
                error: difference / factor,
                floor: floor / factor.abs(),
            }
        })
        .collect()
}

/// The order of the last three values, by bisection of
/// (d₁ᵖ − d₂ᵖ)/(d₂ᵖ − d₃ᵖ) = |v₁ − v₂|/|v₂ − v₃|, which grows with p.
#[must_use]
pub fn start(values: &[ValueSample]) -> Option<f64> {
    let [.., a, b, c] = values else { return None };
    let bits = a.value.prec().max(b.value.prec()).max(c.value.prec());
    let coarse = Float::with_val(bits, &a.value - &b.value).abs();
    let fine = Float::with_val(bits, &b.value - &c.value).abs();
    let target = (coarse / fine).to_f64().ln();
    let (x, y) = ((b.step / a.step).ln(), (c.step / b.step).ln());
    if !target.is_finite() || !x.is_normal() || !y.is_normal() {
        return None;
    }
    // ln of the left side: ln(1 − ρ₁ᵖ) − ln(1 − ρ₂ᵖ) − p·ln ρ₁.
    let left = |p: f64| (-(p * x).exp_m1() / -(p * y).exp_m1()).ln() - p * x;
    let (mut low, mut high) = ORDERS;
    for _ in 0..100 {
        let middle = low + (high - low) / 2.0;
        // At p = 0 both factors vanish; their quotient does not.
        let at = if middle.abs() < 1e-12 { 1e-12 } else { middle };
        if left(at) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

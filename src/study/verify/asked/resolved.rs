//! Whether a ladder resolves a case: of a claimed order alone, what no ladder shows contradicts nobody.

use crate::convergence::{Sample, Verdict, fit};
use crate::method::Expected;
use rug::Float;

/// The order of samples in the middles of segments.
const MIDDLES: f64 = 2.0;

/// The errors of samples in the middles of segments.
#[derive(Default)]
pub(super) struct Middles(Vec<Sample>);

impl Middles {
    pub(super) fn push(
        &mut self,
        n: Option<u64>,
        step: f64,
        radiance: f64,
        exact: &Float,
        floor: &Float,
    ) {
        if self.0.last().is_some_and(|last| last.step <= step) {
            return;
        }
        self.0.push(Sample {
            n,
            step,
            error: Float::with_val(exact.prec(), radiance - exact),
            floor: floor.clone(),
        });
    }

    /// Whether they have found their order, or converge faster, or are down to rounding already.
    pub(super) fn are_resolved(&self) -> bool {
        let verdict = fit(&self.0, Some(Expected::Order(MIDDLES))).map(|fit| fit.verdict);
        !matches!(
            verdict,
            Ok(Verdict::PreAsymptotic
                | Verdict::TooLow
                | Verdict::Stalled
                | Verdict::Oscillatory
                | Verdict::Diverged
                | Verdict::NotFinite)
        )
    }
}

//! What became of one scenario under one method in one format.

use super::Verdict;
use serde::Serialize;

/// Correct significant decimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Digits {
    /// All: there is no error.
    Exact,
    /// −log₁₀ of the relative error, at least 0.
    Of(f64),
}

impl Digits {
    /// Whether these are so many at least.
    #[must_use]
    pub fn reach(self, promised: f64) -> bool {
        match self {
            Digits::Exact => true,
            Digits::Of(digits) => digits >= promised,
        }
    }
}

/// One scenario under one method in one format.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cell {
    /// The scenario's name.
    pub scenario: String,
    /// The method's name.
    pub method: String,
    /// The format's name.
    pub format: String,
    /// n.
    pub n: u64,
    /// Digits of `Q_f` against Q_∞, roundoff alone; `None` where one of them is no number.
    pub digits: Option<Digits>,
    /// Digits of `Q_f` against I; `None` also where I is unknown.
    pub against_radiance: Option<Digits>,
    /// The digits that the bound of roundoff promises.
    pub promised: f64,
    /// What the run is said to be, where it is more than its digits.
    pub verdict: Option<Verdict>,
    /// Why, where the method cannot run or was left out.
    pub reason: Option<String>,
}

impl Cell {
    /// Whether it has fewer digits than promised and nothing says so.
    #[must_use]
    pub fn is_silently_wrong(&self) -> bool {
        let kept = self
            .digits
            .is_some_and(|digits| digits.reach(self.promised));
        self.verdict.is_none() && !kept
    }
}

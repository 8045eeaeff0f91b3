//! A method on the levels that a kernel was asked.

use crate::convergence::{FitError, Sample, Verdict, fit};
use crate::method::Expected;

/// A method on the levels of a kernel.
#[derive(Clone, Debug)]
pub(super) struct Peer {
    /// Its signed errors.
    pub(super) samples: Vec<Sample>,
    /// What they say of the order expected.
    pub(super) verdict: Verdict,
}

impl Peer {
    pub(super) fn new(samples: Vec<Sample>, expected: Option<Expected>) -> Result<Peer, FitError> {
        let verdict = fit(&samples, expected)?.verdict;
        Ok(Peer { samples, verdict })
    }
}

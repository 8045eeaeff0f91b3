//! What is not proved of a case.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A statement that a case rests on and that is not proved.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Unproved {
    /// The statement: "tau defined".
    pub claim: String,
    /// What became of it: "undecided near lambda = 11/7".
    pub reason: String,
}

impl Unproved {
    /// Whether it is a value at the end of the ray that is an estimate, and no statement of the case.
    #[must_use]
    pub(crate) fn is_of_value(&self) -> bool {
        self.claim.ends_with("(D)")
    }
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.claim, self.reason)
    }
}

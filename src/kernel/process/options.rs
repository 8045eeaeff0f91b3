//! How long a child is waited for, and where it is kept what is said.

use super::Log;
use std::time::Duration;

/// When a kernel is given up, and what is kept of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// How long the child may take from its start to its greeting.
    pub start_timeout: Duration,
    /// How long it may take over one request, however many tasks that has.
    pub timeout: Duration,
    /// After so many failures one after the other it is not started again; 0 is taken as 1.
    pub max_failures: u32,
    /// Where all that goes over its descriptors is kept.
    pub log: Option<Log>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            start_timeout: Duration::from_secs(60),
            timeout: Duration::from_secs(60),
            max_failures: 3,
            log: None,
        }
    }
}

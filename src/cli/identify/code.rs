//! A rule as code.

use clap::ValueEnum;
use volver::identify::Rule;

/// In what.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Code {
    /// C99, with math.h alone
    C,
    /// Python, without any package
    Python,
}

impl Code {
    pub(super) fn of(self, rule: &Rule) -> String {
        match self {
            Code::C => rule.c(),
            Code::Python => rule.python(),
        }
    }
}

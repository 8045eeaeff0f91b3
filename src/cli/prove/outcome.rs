//! What became of each case, and how it is said.

use std::fmt;
use volver::report::text::wrap;

/// Columns that a case's name takes.
const NAME: usize = 24;

/// A case and what became of its theorem.
pub(super) struct Proof {
    /// The case's name.
    pub(super) case: String,
    /// The file for Coq, where there is one.
    pub(super) file: Option<String>,
    /// The theorems in it.
    pub(super) theorems: Vec<String>,
    /// What became of them.
    pub(super) fate: Fate,
}

/// What became of a case's theorem.
pub(super) enum Fate {
    /// Coq accepts it.
    Proved,
    /// Coq does not, and says why.
    Failed(String),
    /// Nobody looked, and why.
    NotChecked(String),
    /// There is none, and why.
    NotStated(String),
}

impl Fate {
    pub(super) fn name(&self) -> &'static str {
        match self {
            Fate::Proved => "proved",
            Fate::Failed(_) => "failed",
            Fate::NotChecked(_) => "not checked",
            Fate::NotStated(_) => "not stated",
        }
    }

    /// Why it is not proved.
    pub(super) fn reason(&self) -> Option<&str> {
        match self {
            Fate::Proved => None,
            Fate::Failed(reason) | Fate::NotChecked(reason) | Fate::NotStated(reason) => {
                Some(reason)
            }
        }
    }
}

impl Proof {
    pub(super) fn new(case: &str, fate: Fate) -> Self {
        Proof {
            case: case.into(),
            file: None,
            theorems: Vec::new(),
            fate,
        }
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:<NAME$} ", self.case)?;
        match &self.file {
            Some(file) => writeln!(f, "{:<11}  {file}", self.fate.name())?,
            None => writeln!(f, "{}", self.fate.name())?,
        }
        let reason = self.fate.reason().unwrap_or_default();
        for line in reason.lines().filter(|line| !line.trim().is_empty()) {
            for line in wrap(line, crate::cli::width(), "    ", "      ") {
                writeln!(f, "{line}")?;
            }
        }
        Ok(())
    }
}

/// How many of each.
pub(super) fn summary(proofs: &[Proof]) -> String {
    let count = |name: &str| proofs.iter().filter(|p| p.fate.name() == name).count();
    let counts = ["proved", "failed", "not checked", "not stated"];
    let counts = counts.map(|name| format!("{} {name}", count(name)));
    format!("{} cases: {}\n", proofs.len(), counts.join(", "))
}

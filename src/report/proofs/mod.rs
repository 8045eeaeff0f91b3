//! Cases as theorems, and what became of each.

mod json;

pub use json::json;

use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Section, Table, Tone,
};

/// A case and what became of its theorem.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The case's name.
    pub case: String,
    /// The file for Coq, where there is one.
    pub file: Option<String>,
    /// The theorems in it.
    pub theorems: Vec<String>,
    /// What became of them.
    pub fate: Fate,
}

/// What became of a case's theorem.
#[derive(Clone, Debug)]
pub enum Fate {
    /// Coq accepts it.
    Proved,
    /// Coq does not, and says why.
    Failed(String),
    /// Nobody looked, and why.
    NotChecked(String),
    /// There is none, and why.
    NotStated(String),
}

/// All names of a [`Fate`].
const NAMES: [&str; 4] = ["proved", "failed", "not checked", "not stated"];

impl Fate {
    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let [proved, failed, not_checked, not_stated] = NAMES;
        match self {
            Fate::Proved => proved,
            Fate::Failed(_) => failed,
            Fate::NotChecked(_) => not_checked,
            Fate::NotStated(_) => not_stated,
        }
    }

    /// Why it is not proved.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        match self {
            Fate::Proved => None,
            Fate::Failed(reason) | Fate::NotChecked(reason) | Fate::NotStated(reason) => {
                Some(reason)
            }
        }
    }

    fn tone(&self) -> Tone {
        match self {
            Fate::Proved => Tone::Good,
            Fate::Failed(_) => Tone::Bad,
            Fate::NotChecked(_) | Fate::NotStated(_) => Tone::Open,
        }
    }
}

impl Proof {
    /// A case without a file.
    #[must_use]
    pub fn new(case: &str, fate: Fate) -> Self {
        Proof {
            case: case.into(),
            file: None,
            theorems: Vec::new(),
            fate,
        }
    }
}

/// All cases, and how many of each.
#[must_use]
pub fn document(proofs: &[Proof], about: &About) -> Document {
    let mut document = Document::new("proofs", "Cases as theorems", about.clone());
    let count = |name: &str| proofs.iter().filter(|p| p.fate.name() == name).count();
    let counts = NAMES.map(|name| (name, count(name)));
    document.summary = counts
        .map(|(name, n)| Fact::new(name, n.to_string()))
        .into();
    let counts = counts.map(|(name, count)| format!("{count} {name}"));
    let words = format!("{} cases: {}", proofs.len(), counts.join(", "));
    document.conclusion = Some(Conclusion::new(words));
    let table = Block::Table(table().with(proofs.iter().map(row)));
    document.sections = vec![Section::of("proofs", "", [table])];
    document
}

/// The columns of a case: its rows can be shown one by one.
#[must_use]
pub fn table() -> Table {
    let columns = [
        Column::text("case").wide(24),
        Column::verdict("outcome").wide(11),
        Column::text("file"),
        Column::text("reason").below(),
    ];
    Table::new("What became of each case", columns)
}

/// The row of a case.
#[must_use]
pub fn row(proof: &Proof) -> Vec<Cell> {
    let reason = proof.fate.reason().unwrap_or_default();
    let reason = reason.lines().filter(|line| !line.trim().is_empty());
    let reason: Vec<&str> = reason.collect();
    vec![
        Cell::text(&proof.case),
        Cell::verdict(proof.fate.name(), proof.fate.tone()),
        Cell::text(proof.file.clone().unwrap_or_default()),
        Cell::text(reason.join("\n")),
    ]
}

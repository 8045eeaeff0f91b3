//! What is kept of a study: one line a unit, everything else follows from it.

use super::{Block, Errors, Sweep, number};
use crate::case::Unproved;
use crate::convergence::{Cell, Split};
use crate::method::{Expected, Method};
use crate::study::shards::Key;
use rug::Float;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What a study is of, said once at the head of its journal: units of different studies never mix.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// The version of the program, whose numbers these are.
    pub volver: String,
    /// The cases: name, length, and the formulas of field, extinction, emission.
    pub cases: Vec<[String; 5]>,
    /// The methods by name.
    pub methods: Vec<String>,
    /// The formats by name.
    pub formats: Vec<String>,
    /// Numbers of segments.
    pub levels: Vec<u64>,
    /// Whether errors are split; what is not said is.
    #[serde(default, skip_serializing_if = "Errors::is_split")]
    pub errors: Errors,
}

impl Header {
    /// The head of a journal of this study.
    #[must_use]
    pub fn new(sweep: &Sweep) -> Header {
        let cases = sweep.cases.iter().map(|(name, case)| {
            let formulas = case.formulas();
            [
                name.clone(),
                crate::case::Case::length(case).to_string(),
                formulas.field.to_string(),
                formulas.extinction.to_string(),
                formulas.emission.to_string(),
            ]
        });
        Header {
            volver: env!("CARGO_PKG_VERSION").into(),
            cases: cases.collect(),
            methods: sweep.methods.iter().map(Method::name).collect(),
            formats: sweep.formats.iter().map(ToString::to_string).collect(),
            levels: sweep.levels.clone(),
            errors: sweep.errors,
        }
    }

    /// What another study has otherwise: what that is, this one's, and the other's.
    #[must_use]
    pub fn difference(&self, other: &Header) -> Option<(&'static str, String, String)> {
        let cases = |h: &Header| h.cases.iter().map(|c| c.join(" ")).collect::<Vec<_>>();
        let levels = |h: &Header| h.levels.iter().map(ToString::to_string).collect::<Vec<_>>();
        let version = |h: &Header| vec![h.volver.clone()];
        let errors = |h: &Header| vec![h.errors.to_string()];
        let compared = [
            ("version", version(self), version(other)),
            ("errors", errors(self), errors(other)),
            ("cases", cases(self), cases(other)),
            ("methods", self.methods.clone(), other.methods.clone()),
            ("formats", self.formats.clone(), other.formats.clone()),
            ("levels", levels(self), levels(other)),
        ];
        let mut compared = compared.into_iter();
        let (what, ours, theirs) = compared.find(|(_, ours, theirs)| ours != theirs)?;
        Some((what, ours.join(", "), theirs.join(", ")))
    }

    /// All levels of a unit, those for models alone behind the others.
    #[must_use]
    pub fn every_level(&self) -> Vec<u64> {
        let between = self.errors.between(&self.levels);
        self.levels.iter().copied().chain(between).collect()
    }

    /// What a block is known by: a digest of all that its results depend on, of case, format, methods, levels, kind of errors
    /// and version. Theory has the whole ladder before it.
    #[must_use]
    pub fn key(&self, block: &Block) -> Key {
        let formats = self.formats.len().max(1);
        let case = self.cases.get(block.unit / formats).into_iter().flatten();
        let format = self.formats.get(block.unit % formats);
        let methods = self.methods.get(block.methods.clone()).unwrap_or_default();
        let all = self.every_level();
        let levels = all.get(block.levels.clone()).unwrap_or_default();
        let list = |levels: &[u64]| {
            let levels: Vec<String> = levels.iter().map(ToString::to_string).collect();
            levels.join(",")
        };
        let of_study = [
            self.volver.clone(),
            self.errors.to_string(),
            methods.join(","),
            list(&self.levels),
            list(levels),
        ];
        Key::of(case.chain(format).chain(&of_study).map(String::as_str))
    }

    /// The names of all units, in the order in which they are reported.
    pub fn units(&self) -> impl Iterator<Item = (&str, &str)> {
        let formats = &self.formats;
        self.cases
            .iter()
            .flat_map(move |[case, ..]| formats.iter().map(move |f| (case.as_str(), f.as_str())))
    }
}

/// One case in one format.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unit {
    /// The case's name.
    pub case: String,
    /// The format's name.
    pub format: String,
    /// Significant bits of the format.
    pub bits: u32,
    /// I.
    #[serde(with = "number")]
    pub radiance: Float,
    /// What I rests on and is not proved.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unproved: Vec<Unproved>,
    /// The methods, in the order of the header.
    pub rows: Vec<Row>,
}

/// One method on one case in one format.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The method's name.
    pub method: String,
    /// The order that theory gives it on this case.
    pub expected: Theory,
    /// What came out, coarse to fine.
    pub levels: Vec<LevelRecord>,
    /// The same at the levels [`between`](super::between), which models alone are made from.
    pub between: Vec<LevelRecord>,
}

/// [`Expected`], as it is kept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theory {
    /// |e| = O(d^p).
    Order(f64),
    /// No discretization error.
    Exact,
    /// The order in general, and the one that this case shows.
    Blind(f64, f64),
    /// Theory does not say.
    Unknown,
}

impl From<Expected> for Theory {
    fn from(expected: Expected) -> Theory {
        match expected {
            Expected::Order(p) => Theory::Order(p),
            Expected::Exact => Theory::Exact,
            Expected::Blind { general, here } => Theory::Blind(general, here),
            Expected::Unknown => Theory::Unknown,
        }
    }
}

impl From<Theory> for Expected {
    fn from(theory: Theory) -> Expected {
        match theory {
            Theory::Order(p) => Expected::Order(p),
            Theory::Exact => Expected::Exact,
            Theory::Blind(general, here) => Expected::Blind { general, here },
            Theory::Unknown => Expected::Unknown,
        }
    }
}

/// What became of a level.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// The error is split.
    Split,
    /// The error is known, and nobody asked for its parts.
    Total,
    /// The run took another branch than the same code in MPFR.
    BranchDiverged,
    /// NaN or ∞.
    NotFinite,
    /// Doubling the oracle's bits went on changing a part.
    Unsettled,
    /// The method does not run there, and why.
    Refused(String),
}

impl State {
    /// In a word, the same in every report.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            State::Split => "split",
            State::Total => "total",
            State::BranchDiverged => "branch-diverged",
            State::NotFinite => "not-finite",
            State::Unsettled => "unsettled",
            State::Refused(_) => "refused",
        }
    }
}

/// A part of an error, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of it.
    Total,
    /// Discretization.
    Discretization,
    /// Truncation.
    Truncation,
    /// Input rounding.
    Input,
    /// Arithmetic rounding.
    Arithmetic,
}

/// One method at one level. Parts are missing where the error is not split; where nobody asked for them a journal does not
/// name them either.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, remote = "Self")]
pub struct LevelRecord {
    /// Segments.
    pub n: u64,
    /// What became of it.
    pub state: State,
    /// `Q_f` − I.
    #[serde(with = "number::optional")]
    pub total: Option<Float>,
    /// What of it may be rounding, foreseen where that is not measured.
    #[serde(
        with = "number::optional",
        default,
        skip_serializing_if = "Option::is_none"
    )]
    pub floor: Option<Float>,
    /// `Q_∞` − I.
    #[serde(with = "number::optional", default)]
    pub discretization: Option<Float>,
    /// `Q_∞` stopped early − `Q_∞`.
    #[serde(with = "number::optional", default)]
    pub truncation: Option<Float>,
    /// `Q_∞`(inputs of f) − `Q_∞`.
    #[serde(with = "number::optional", default)]
    pub input: Option<Float>,
    /// `Q_f` − `Q_∞`(inputs of f).
    #[serde(with = "number::optional", default)]
    pub arithmetic: Option<Float>,
    /// The share of it that comes of the transmittances.
    #[serde(with = "number::optional", default)]
    pub of_depth: Option<Float>,
    /// What the oracle's own rounding may hide.
    #[serde(with = "number::optional", default)]
    pub resolution: Option<Float>,
    /// Bits of the oracle.
    #[serde(default)]
    pub oracle_bits: Option<u32>,
}

/// What a journal keeps of a level whose error is known as a whole.
#[derive(Serialize)]
struct WholeError<'a> {
    n: u64,
    state: &'a State,
    #[serde(with = "number::optional")]
    total: &'a Option<Float>,
    #[serde(with = "number::optional")]
    floor: &'a Option<Float>,
}

impl Serialize for LevelRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.floor.is_none() {
            return LevelRecord::serialize(self, serializer);
        }
        let whole = WholeError {
            n: self.n,
            state: &self.state,
            total: &self.total,
            floor: &self.floor,
        };
        whole.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for LevelRecord {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        LevelRecord::deserialize(deserializer)
    }
}

impl LevelRecord {
    /// A level where the method does not run.
    pub(super) fn refused(n: u64, reason: String) -> Self {
        LevelRecord::without(n, State::Refused(reason))
    }

    /// Nothing known yet.
    fn without(n: u64, state: State) -> Self {
        LevelRecord {
            n,
            state,
            total: None,
            floor: None,
            discretization: None,
            truncation: None,
            input: None,
            arithmetic: None,
            of_depth: None,
            resolution: None,
            oracle_bits: None,
        }
    }

    /// A level whose error is known as a whole, with what of it may be rounding.
    pub(super) fn whole(n: u64, total: &Float, floor: &Float) -> Self {
        let state = if total.is_finite() {
            State::Total
        } else {
            State::NotFinite
        };
        LevelRecord {
            total: Some(number::rounded(total)),
            floor: Some(number::rounded(floor)),
            ..LevelRecord::without(n, state)
        }
    }

    pub(super) fn of(n: u64, cell: &Cell) -> Self {
        let (state, split, oracle_bits) = match cell {
            Cell::Split(split) => (State::Split, Some(split), Some(split.bits)),
            Cell::BranchDiverged { .. } => (State::BranchDiverged, None, None),
            Cell::NotFinite { .. } => (State::NotFinite, None, None),
            Cell::Unsettled { bits, .. } => (State::Unsettled, None, Some(*bits)),
        };
        let part = |part: fn(&Split) -> &Float| split.map(part).map(number::rounded);
        LevelRecord {
            n,
            state,
            total: Some(number::rounded(cell.total())),
            floor: None,
            discretization: part(|s| &s.discretization),
            truncation: part(|s| &s.truncation),
            input: part(|s| &s.input),
            arithmetic: part(|s| &s.arithmetic),
            of_depth: split.and_then(|s| s.of_depth.as_ref()).map(number::rounded),
            resolution: part(|s| &s.resolution),
            oracle_bits,
        }
    }

    /// A part, where it is known.
    #[must_use]
    pub fn part(&self, part: Part) -> Option<&Float> {
        match part {
            Part::Total => self.total.as_ref(),
            Part::Discretization => self.discretization.as_ref(),
            Part::Truncation => self.truncation.as_ref(),
            Part::Input => self.input.as_ref(),
            Part::Arithmetic => self.arithmetic.as_ref(),
        }
    }

    /// The split, where the error is split.
    #[must_use]
    pub fn split(&self) -> Option<Split> {
        Some(Split {
            total: self.total.clone()?,
            discretization: self.discretization.clone()?,
            truncation: self.truncation.clone()?,
            input: self.input.clone()?,
            arithmetic: self.arithmetic.clone()?,
            of_depth: self.of_depth.clone(),
            resolution: self.resolution.clone()?,
            bits: self.oracle_bits?,
        })
    }
}

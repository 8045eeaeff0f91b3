//! One entry of a reproduced table.

use super::Table;
use crate::convergence::{Sample, Verdict, serialize_float};
use crate::method::{Expected, Theorem};
use rug::Float;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// One entry: the paper's figure, the paper's protocol here, and the order itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Which table.
    pub table: Table,
    /// The inner rule, or how the color is computed.
    pub row: &'static str,
    /// The outer rule, or how the opacity is computed.
    pub column: &'static str,
    /// The format that the asymptotic order was measured in.
    pub format: String,
    /// The figure the paper prints, if it prints one.
    pub paper: Option<f64>,
    /// The paper's protocol in binary64: least squares over all of n = 8 … 1024.
    pub protocol_order: Option<f64>,
    /// What theory expects.
    pub expected: Expected,
    /// The proof of that order, where there is one.
    pub theorem: Option<Theorem>,
    /// The order measured.
    pub asymptotic_order: Option<f64>,
    /// Half of its interval; without a window, a spread.
    pub asymptotic_half_width: Option<f64>,
    /// First and last n of the window, if there is one.
    pub window: Option<(u64, u64)>,
    /// What the measurement says of the expectation.
    pub verdict: Verdict,
    /// Why paper and order differ, from the measured errors.
    pub note: Option<String>,
    /// Orders between neighbouring levels.
    pub pairwise: Vec<f64>,
    /// The errors; for Monte Carlo the standard deviations over replicas.
    pub levels: Vec<Level>,
    /// How many replicas, for Monte Carlo.
    pub replicas: Option<usize>,
}

impl Entry {
    /// Whether the measurement says something else than theory, which no lack of levels, precision or
    /// sensitivity excuses.
    #[must_use]
    pub fn contradicts_theory(&self) -> bool {
        match self.verdict {
            Verdict::Diverged | Verdict::NotFinite => true,
            _ if self.expected == Expected::Unknown => false,
            Verdict::TooLow | Verdict::TooHigh | Verdict::Oscillatory => true,
            Verdict::Stalled => self.expected != Expected::Order(0.0),
            Verdict::Exact => self.expected != Expected::Exact,
            Verdict::Confirmed
            | Verdict::PreAsymptotic
            | Verdict::FloorLimited
            | Verdict::TooFewLevels
            | Verdict::Blind
            | Verdict::Fitted => false,
        }
    }
}

/// The error at one level.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Level {
    /// Number of segments.
    pub n: u64,
    /// Signed error, or standard deviation.
    #[serde(serialize_with = "serialize_float")]
    pub error: Float,
    /// Mean error over replicas, for Monte Carlo.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bias: Option<f64>,
    /// Roundoff floor.
    #[serde(serialize_with = "serialize_float")]
    pub floor: Float,
}

impl From<&Sample> for Level {
    fn from(sample: &Sample) -> Self {
        Level {
            n: sample.n.unwrap_or(0),
            error: Float::with_val(64, &sample.error),
            bias: None,
            floor: sample.floor.clone(),
        }
    }
}

impl Serialize for Entry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (row, column) = self.table.axes();
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("table", &self.table)?;
        map.serialize_entry(row, self.row)?;
        map.serialize_entry(column, self.column)?;
        map.serialize_entry("format", &self.format)?;
        map.serialize_entry("paper", &self.paper)?;
        map.serialize_entry("protocol_order", &self.protocol_order.map(rounded))?;
        match self.expected {
            Expected::Order(order) => map.serialize_entry("expected_order", &order)?,
            Expected::Blind { general, .. } => map.serialize_entry("expected_order", &general)?,
            Expected::Exact => map.serialize_entry("expected_order", "exact")?,
            Expected::Unknown => map.serialize_entry("expected_order", &None::<f64>)?,
        }
        map.serialize_entry("theorem", &self.theorem)?;
        map.serialize_entry("asymptotic_order", &self.asymptotic_order.map(rounded))?;
        map.serialize_entry(
            "asymptotic_half_width",
            &self.asymptotic_half_width.map(rounded),
        )?;
        map.serialize_entry("window", &self.window)?;
        map.serialize_entry("verdict", &self.verdict)?;
        map.serialize_entry("note", &self.note)?;
        let pairwise: Vec<f64> = self.pairwise.iter().copied().map(rounded).collect();
        map.serialize_entry("pairwise_orders", &pairwise)?;
        map.serialize_entry("levels", &self.levels)?;
        if let Some(replicas) = self.replicas {
            map.serialize_entry("replicas", &replicas)?;
        }
        map.end()
    }
}

/// Six decimals: more than an order has, and the same on every platform.
fn rounded(order: f64) -> f64 {
    (order * 1e6).round() / 1e6
}

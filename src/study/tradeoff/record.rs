//! What is kept of each run.

use super::{Calibration, Timing};
use crate::case::Unproved;
use crate::convergence::serialize_float;
use crate::method::Method;
use crate::real::Counts;
use crate::real::FormatName;
use crate::real::{MpfrReal, Real};
use rug::Float;
use serde::{Serialize, Serializer};
use std::f64::consts::LOG10_2;

/// What became of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "state")]
pub enum Outcome {
    /// |Q − I|, relative to |I| where that is not 0.
    Error {
        /// The error, above 0.
        #[serde(serialize_with = "serialize_float")]
        error: Float,
    },
    /// No error that could be told from 0.
    Exact,
    /// NaN or ∞.
    NotFinite,
    /// The method does not run there.
    Refused {
        /// Why.
        reason: String,
    },
}

impl Outcome {
    /// The error, 0 where there is none to be seen; `None` without a finite radiance.
    #[must_use]
    pub fn error(&self) -> Option<Float> {
        match self {
            Outcome::Error { error } => Some(error.clone()),
            Outcome::Exact => Some(Float::new(64)),
            Outcome::NotFinite | Outcome::Refused { .. } => None,
        }
    }

    /// log₁₀ of the error, where there is one to draw.
    #[must_use]
    pub fn log10(&self) -> Option<f64> {
        match self {
            Outcome::Error { error } => {
                let log = MpfrReal::from(error.clone()).log2_abs() * LOG10_2;
                log.is_finite().then_some(log)
            }
            _ => None,
        }
    }

    /// In a word, the same in every report.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Outcome::Error { .. } => "error",
            Outcome::Exact => "exact",
            Outcome::NotFinite => "not-finite",
            Outcome::Refused { .. } => "refused",
        }
    }
}

/// One method at one n.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// The method.
    #[serde(serialize_with = "by_name")]
    pub method: Method,
    /// Segments.
    pub n: u64,
    /// What came out.
    pub outcome: Outcome,
    /// What was done for it.
    pub counts: Counts,
    /// Nanoseconds by the model.
    pub modelled: Option<f64>,
    /// Nanoseconds, measured.
    pub measured: Option<Timing>,
    /// Not asked for: there to compare with what is usual.
    pub only_usual: bool,
}

fn by_name<S: Serializer>(method: &Method, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&method.name())
}

/// One case in one format.
#[derive(Clone, Debug, Serialize)]
pub struct Unit {
    /// The case.
    pub case: String,
    /// The format's name.
    #[serde(serialize_with = "as_text")]
    pub format: FormatName,
    /// Significant bits of the format.
    pub bits: u32,
    /// I.
    #[serde(serialize_with = "serialize_float")]
    pub radiance: Float,
    /// What I rests on and is not proved.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unproved: Vec<Unproved>,
    /// By method, then by n.
    pub points: Vec<Point>,
    /// What operations cost in this format here.
    pub calibration: Option<Calibration>,
}

fn as_text<S: Serializer>(format: &FormatName, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(format)
}

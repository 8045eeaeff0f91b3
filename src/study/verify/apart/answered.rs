//! Answers as files keep them: to the last bit.

use crate::kernel::{KernelError, Rendering};
use crate::study::shards::Key;
use rug::Float;
use serde::{Deserialize, Serialize};

/// What was answered to a ray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Of the ray, and of what it was asked.
    pub(super) task: Key,
    /// What came.
    pub(super) answer: Answer,
}

/// An answer, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Answer {
    Rendering(Box<Kept>),
    Error(String),
}

/// A [`Rendering`]; a kernel is asked for no gradients here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Kept {
    radiance: Vec<Exact>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    opacity: Option<Exact>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    optical_depth: Option<Exact>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    expected_depth: Option<Exact>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    emission: Option<Exact>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    step: Option<Exact>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    segments: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    edges: Option<Vec<Exact>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    standard_error: Option<Vec<Exact>>,
}

/// A number in hexadecimal, behind its bits: `53:1.8@0`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
struct Exact(String);

impl Exact {
    fn new(x: &Float) -> Self {
        Exact(format!("{}:{}", x.prec(), x.to_string_radix(16, None)))
    }

    fn of(x: f64) -> Self {
        Exact::new(&Float::with_val(f64::MANTISSA_DIGITS, x))
    }

    fn value(&self) -> Option<Float> {
        let (bits, digits) = self.0.split_once(':')?;
        let bits: u32 = bits.parse().ok()?;
        let allowed = rug::float::prec_min()..=MOST_BITS;
        let digits = Float::parse_radix(digits, 16).ok()?;
        allowed
            .contains(&bits)
            .then(|| Float::with_val(bits, digits))
    }
}

/// More than any answer has: kernels write a line of 1 MiB at the most.
const MOST_BITS: u32 = 1 << 23;

impl Answer {
    pub(super) fn new(result: &Result<Rendering, KernelError>) -> Self {
        let rendering = match result {
            Ok(rendering) => rendering,
            Err(error) => return Answer::Error(error.to_string()),
        };
        let one = |x: &Option<Float>| x.as_ref().map(Exact::new);
        let row = |row: &[f64]| row.iter().copied().map(Exact::of).collect();
        Answer::Rendering(Box::new(Kept {
            radiance: rendering.radiance.iter().map(Exact::new).collect(),
            opacity: one(&rendering.opacity),
            optical_depth: one(&rendering.optical_depth),
            expected_depth: one(&rendering.expected_depth),
            emission: one(&rendering.emission),
            step: rendering.step.map(Exact::of),
            segments: rendering.segments,
            edges: rendering.edges.as_deref().map(row),
            standard_error: rendering.standard_error.as_deref().map(row),
        }))
    }

    /// The same again; `None` where a number is none.
    pub(super) fn result(&self) -> Option<Result<Rendering, KernelError>> {
        let kept = match self {
            Answer::Rendering(kept) => kept,
            Answer::Error(words) => {
                let words = words.clone();
                return Some(Err(KernelError::Kept { words }));
            }
        };
        let rows = |row: &[Exact]| -> Option<Vec<f64>> {
            let row = row.iter();
            row.map(|x| x.value().map(|x| x.to_f64())).collect()
        };
        let one = |x: &Option<Exact>| match x {
            Some(x) => x.value().map(Some),
            None => Some(None),
        };
        let row = |row: &Option<Vec<Exact>>| match row {
            Some(row) => rows(row).map(Some),
            None => Some(None),
        };
        let radiance: Option<Vec<Float>> = kept.radiance.iter().map(Exact::value).collect();
        Some(Ok(Rendering {
            radiance: radiance?,
            opacity: one(&kept.opacity)?,
            optical_depth: one(&kept.optical_depth)?,
            expected_depth: one(&kept.expected_depth)?,
            emission: one(&kept.emission)?,
            gradient: None,
            step: one(&kept.step)?.map(|step| step.to_f64()),
            segments: kept.segments,
            edges: row(&kept.edges)?,
            standard_error: row(&kept.standard_error)?,
        }))
    }
}

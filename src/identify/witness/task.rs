//! A witness as a task, in the words of `docs/protocol.md`, and back.

use super::super::ray::Emission;
use super::super::ray::{Layers, Ray};
use serde::{Deserialize, Serialize};

/// Why a file holds no task that can be asked.
#[derive(Debug, thiserror::Error)]
pub enum TaskError {
    /// It is no JSON, or another one.
    #[error("no task: {0} (allowed: what --json writes, or a task of docs/protocol.md)")]
    Json(#[from] serde_json::Error),
    /// Its rows do not fit each other.
    #[error("no task: {0} (allowed: n + 1 ends, n middles, and every channel at all of them)")]
    Rows(&'static str),
}

#[derive(Serialize, Deserialize)]
struct Written {
    case: String,
    channels: Vec<String>,
    length: f64,
    step: f64,
    segments: usize,
    #[serde(default)]
    seed: u64,
    data: Data,
}

#[derive(Serialize, Deserialize)]
struct Data {
    form: String,
    edges: Row,
    middles: Row,
}

#[derive(Serialize, Deserialize)]
struct Row {
    lambda: Vec<f64>,
    extinction: Vec<f64>,
    emission: Vec<Vec<f64>>,
}

impl Ray {
    /// The task that asks for this ray, of the form `segments`.
    ///
    /// # Errors
    /// [`serde_json::Error`] where a value of the ray is not finite.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        let row = |samples: &crate::kernel::Samples| Row {
            lambda: samples.lambda.clone(),
            extinction: samples.extinction.clone(),
            emission: samples.emission.clone(),
        };
        serde_json::to_string(&Written {
            case: self.name.clone(),
            channels: self.channels.clone(),
            length: self.length.to_f64(),
            step: self.step,
            segments: self.segments.count(),
            seed: self.seed,
            data: Data {
                form: "segments".into(),
                edges: row(&self.segments.edges),
                middles: row(&self.segments.middles),
            },
        })
    }

    /// The ray of a task of the form `segments`.
    ///
    /// # Errors
    /// [`TaskError`] where there is none.
    pub fn from_json(text: &str) -> Result<Self, TaskError> {
        let written: Written = serde_json::from_str(text)?;
        let Data { edges, middles, .. } = written.data;
        let n = written.segments;
        let fits = |row: &Row, count: usize| {
            row.lambda.len() == count
                && row.extinction.len() == count
                && row.emission.len() == written.channels.len()
                && row.emission.iter().all(|c| c.len() == count)
        };
        if n == 0 || !fits(&edges, n + 1) || !fits(&middles, n) {
            return Err(TaskError::Rows("rows of other lengths"));
        }
        let length = edges.lambda[n];
        let full = (n - 1) as f64 * written.step;
        let layers = Layers {
            step: written.step,
            last: ((length - full) / written.step).min(1.0),
            edges: edges.extinction,
            middles: middles.extinction,
        };
        let emission: Vec<Emission> = edges
            .emission
            .into_iter()
            .zip(middles.emission)
            .map(|(edges, middles)| Emission { edges, middles })
            .collect();
        let mut ray = layers.ray(written.case, &emission);
        ray.channels = written.channels;
        ray.seed = written.seed;
        // As they were written: no rounding is to come between.
        ray.segments.edges.lambda = edges.lambda;
        ray.segments.middles.lambda = middles.lambda;
        ray.length = rug::Rational::from_f64(written.length).unwrap_or_default();
        Ok(ray)
    }
}

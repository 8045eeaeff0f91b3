//! Transfer functions as JSON: ours, and colour maps of ParaView.

use super::color_map::{self, ColorMap};
use super::text::{json, unreadable};
use crate::binary::{FileError, Trouble, refused};
use crate::input;
use crate::output;
use crate::volume::{ControlPoint, TransferFunction};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// A transfer function as JSON has it.
///
/// `{"channels": ["r", "g", "b"], "points": [{"s": 0, "extinction": 0.5, "emission": [1, 0, 0]}, …]}`
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TransferFile {
    /// The names of the channels.
    pub channels: Vec<String>,
    /// By rising s; two of the same s are a jump.
    pub points: Vec<PointFile>,
}

/// A control point as JSON has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointFile {
    /// s.
    pub s: f64,
    /// τ(s) ≥ 0, per unit of length.
    pub extinction: f64,
    /// C(s), a number a channel.
    pub emission: Vec<f64>,
}

impl TransferFile {
    /// The JSON Schema of the file.
    #[must_use]
    pub fn schema() -> Value {
        schemars::schema_for!(TransferFile).to_value()
    }
}

/// The transfer function of a file, and how far its extinction may be from the one that the file says, relative to the
/// largest: 0 of a file of ours. A colour map of ParaView is converted as `map` says, see [`ColorMap`].
///
/// # Errors
/// [`FileError`] where it cannot be read, is neither, or has values that a transfer function has not.
pub fn read_transfer(path: &Path, map: &ColorMap) -> Result<(TransferFunction, f64), FileError> {
    let read = || {
        let text = input::text(path, input::DATA).map_err(unreadable)?;
        let value: Value = serde_json::from_str(&text).map_err(json)?;
        if value.is_array() {
            return color_map::read(&value, map);
        }
        let file: TransferFile = serde_json::from_value(value).map_err(json)?;
        Ok((checked(file)?, 0.0))
    };
    read().map_err(|trouble| trouble.at(path))
}

/// Writes a transfer function as JSON of ours, every number with the digits that bring it back.
///
/// # Errors
/// [`FileError`] where it cannot be written, or is none.
pub fn write_transfer(path: &Path, transfer: &TransferFunction) -> Result<(), FileError> {
    let written = || {
        let points = transfer.points.iter().map(|point| PointFile {
            s: point.s,
            extinction: point.extinction,
            emission: point.emission.clone(),
        });
        let file = TransferFile {
            channels: transfer.channels.clone(),
            points: points.collect(),
        };
        let text = serde_json::to_string_pretty(&file).map_err(json)?;
        checked(file)?;
        output::replace(path, |to| Ok(writeln!(to, "{text}")?))
    };
    written().map_err(|trouble: Trouble| trouble.at(path))
}

/// The transfer function that a file says, where it is one.
fn checked(file: TransferFile) -> Result<TransferFunction, Trouble> {
    let mut seen = std::collections::BTreeSet::new();
    if let Some(name) = file
        .channels
        .iter()
        .find(|name| name.is_empty() || !seen.insert(*name))
    {
        return Err(refused(
            format!(
                "the channel '{}' twice, or without a name",
                name.escape_debug()
            ),
            "names, each once",
        ));
    }
    if file.channels.is_empty() || file.points.is_empty() {
        return Err(refused(
            format!(
                "{} channels and {} points",
                file.channels.len(),
                file.points.len()
            ),
            "one of each or more",
        ));
    }
    for (i, point) in file.points.iter().enumerate() {
        let numbers = [point.s, point.extinction];
        let all = numbers.iter().chain(&point.emission);
        if !all.clone().all(|number| number.is_finite()) || point.extinction < 0.0 {
            return Err(refused(
                format!(
                    "point {i}: s {}, extinction {}, emission {:?}",
                    point.s, point.extinction, point.emission
                ),
                "finite numbers, an extinction of 0 or more",
            ));
        }
        if point.emission.len() != file.channels.len() {
            return Err(refused(
                format!("point {i}: {} numbers of emission", point.emission.len()),
                format!("{}, one a channel", file.channels.len()),
            ));
        }
    }
    let s = |i: usize| file.points.get(i).map(|point| point.s);
    for i in 1..file.points.len() {
        if s(i) < s(i - 1) || (i > 1 && s(i) == s(i - 2)) {
            return Err(refused(
                format!(
                    "point {i}: s {:?} behind {:?}",
                    s(i).unwrap_or_default(),
                    s(i - 1).unwrap_or_default()
                ),
                "s that rises, and at most two points of the same s",
            ));
        }
    }
    let points = file.points.into_iter().map(|point| ControlPoint {
        s: point.s,
        extinction: point.extinction,
        emission: point.emission,
    });
    Ok(TransferFunction {
        channels: file.channels,
        points: points.collect(),
    })
}

//! Cameras as JSON.

use super::text::{json, unreadable};
use crate::binary::{FileError, Trouble, refused};
use crate::input;
use crate::output;
use crate::volume::{Camera, Lens};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// A camera as JSON has it: with one lens.
///
/// `{"position": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "orthographic": {"height": 2}}`
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    /// Where it stands.
    pub position: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
    /// What is above in the picture.
    pub up: [f64; 3],
    /// Rays along one direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orthographic: Option<OrthographicFile>,
    /// Rays from one place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub perspective: Option<PerspectiveFile>,
}

/// [`Lens::Orthographic`] as JSON has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrthographicFile {
    /// From the lower edge of the picture to the upper, above 0.
    pub height: f64,
}

/// [`Lens::Perspective`] as JSON has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PerspectiveFile {
    /// Between the lower edge of the picture and the upper, above 0, below 180.
    pub angle_degrees: f64,
}

impl CameraFile {
    /// The JSON Schema of the file.
    #[must_use]
    pub fn schema() -> Value {
        schemars::schema_for!(CameraFile).to_value()
    }
}

/// The camera of a file of ours; see [`read_gltf_camera`](super::read_gltf_camera) for others.
///
/// # Errors
/// [`FileError`] where it cannot be read, is none, or looks nowhere or up.
pub fn read_camera(path: &Path) -> Result<Camera, FileError> {
    let read = || {
        let text = input::text(path, input::WRITTEN).map_err(unreadable)?;
        let file: CameraFile = serde_json::from_str(&text).map_err(json)?;
        let lens = match (file.orthographic, file.perspective) {
            (Some(OrthographicFile { height }), None) => Lens::Orthographic { height },
            (None, Some(PerspectiveFile { angle_degrees })) => Lens::Perspective {
                angle: angle_degrees.to_radians(),
            },
            _ => {
                return Err(refused(
                    "no lens, or two",
                    "one of orthographic and perspective",
                ));
            }
        };
        checked(Camera {
            position: file.position,
            target: file.target,
            up: file.up,
            lens,
        })
    };
    read().map_err(|trouble| trouble.at(path))
}

/// Writes a camera as JSON of ours; the angle is rounded to degrees of binary64.
///
/// # Errors
/// [`FileError`] where it cannot be written, or looks nowhere or up.
pub fn write_camera(path: &Path, camera: &Camera) -> Result<(), FileError> {
    let written = || {
        checked(*camera)?;
        let (orthographic, perspective) = match camera.lens {
            Lens::Orthographic { height } => (Some(OrthographicFile { height }), None),
            Lens::Perspective { angle } => {
                let angle_degrees = angle.to_degrees();
                (None, Some(PerspectiveFile { angle_degrees }))
            }
        };
        let file = CameraFile {
            position: camera.position,
            target: camera.target,
            up: camera.up,
            orthographic,
            perspective,
        };
        let text = serde_json::to_string_pretty(&file).map_err(json)?;
        output::replace(path, |to| Ok(writeln!(to, "{text}")?))
    };
    written().map_err(|trouble: Trouble| trouble.at(path))
}

/// A camera that sees something.
pub(super) fn checked(camera: Camera) -> Result<Camera, Trouble> {
    let lens = match camera.lens {
        Lens::Orthographic { height } => height > 0.0 && height.is_finite(),
        Lens::Perspective { angle } => angle > 0.0 && angle < std::f64::consts::PI,
    };
    if !lens {
        return Err(refused(
            format!("the lens {:?}", camera.lens),
            "a height above 0, or an angle above 0 and below 180 degrees",
        ));
    }
    let finite = [camera.position, camera.target, camera.up].concat();
    if !finite.iter().all(|part| part.is_finite()) || camera.axes().is_none() {
        return Err(refused(
            format!(
                "a camera at {:?} that looks at {:?} with {:?} above",
                camera.position, camera.target, camera.up
            ),
            "finite numbers, a target that is not its place, and up across the line of sight",
        ));
    }
    Ok(camera)
}

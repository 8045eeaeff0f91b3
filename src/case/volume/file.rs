//! A volume by formulas from its file.

use super::VolumeCase;
use super::field::{Field, Shape};
use crate::case::file::{deepest_dot, said};
use crate::volume::file::{CameraFile, OrthographicFile, PerspectiveFile, PointFile};
use crate::volume::{Camera, ControlPoint, Lens, TransferFunction};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// The largest file that is read, in bytes.
const MAX_FILE: usize = 1 << 20;
/// The most control points.
const MAX_POINTS: usize = 4096;
/// The most channels.
const MAX_CHANNELS: usize = 8;

/// A volume by a formula, transfer functions by control points, and a camera.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VolumeFile {
    /// In kebab-case.
    pub name: String,
    /// In a few words.
    #[serde(default)]
    pub title: String,
    /// The box; outside there is nothing.
    #[serde(rename = "box")]
    #[schemars(with = "BoxFile")]
    pub corners: Spanned<BoxFile>,
    /// s(x).
    #[schemars(with = "FieldFile")]
    pub field: Spanned<FieldFile>,
    /// Names of the channels; one without a name unless given.
    #[serde(default)]
    #[schemars(with = "Option<Vec<String>>")]
    pub channels: Option<Spanned<Vec<String>>>,
    /// τ(s) and C(s), by rising s: linear between, held beyond.
    #[schemars(with = "Vec<PointFile>")]
    pub transfer: Spanned<Vec<PointFile>>,
    /// Who looks at it.
    #[schemars(with = "CameraFile")]
    pub camera: Spanned<CameraFile>,
}

impl VolumeFile {
    /// The JSON Schema of such files.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(VolumeFile).to_value()
    }
}

/// Two corners.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// The least coordinates.
    pub from: [f64; 3],
    /// The largest.
    pub to: [f64; 3],
}

/// s = offset + height · shape(x).
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum FieldFile {
    /// g · x.
    Ramp {
        /// g.
        slope: [f64; 3],
        /// Added; 0 unless given.
        #[serde(default)]
        offset: f64,
        /// Multiplied; 1 unless given.
        #[serde(default = "one")]
        height: f64,
    },
    /// |x − c|.
    Radial {
        /// c.
        center: [f64; 3],
        /// Added; 0 unless given.
        #[serde(default)]
        offset: f64,
        /// Multiplied; 1 unless given.
        #[serde(default = "one")]
        height: f64,
    },
    /// sin(k · x + φ).
    Wave {
        /// k, in radians per unit of length.
        wave: [f64; 3],
        /// φ, in radians; 0 unless given.
        #[serde(default)]
        phase: f64,
        /// Added; 0 unless given.
        #[serde(default)]
        offset: f64,
        /// Multiplied; 1 unless given.
        #[serde(default = "one")]
        height: f64,
    },
    /// exp(−|x − c|²/w²).
    Blob {
        /// c.
        center: [f64; 3],
        /// w.
        width: f64,
        /// Added; 0 unless given.
        #[serde(default)]
        offset: f64,
        /// Multiplied; 1 unless given.
        #[serde(default = "one")]
        height: f64,
    },
    /// |n · x − o|.
    Kink {
        /// n.
        normal: [f64; 3],
        /// o; 0 unless given.
        #[serde(default)]
        place: f64,
        /// Added; 0 unless given.
        #[serde(default)]
        offset: f64,
        /// Multiplied; 1 unless given.
        #[serde(default = "one")]
        height: f64,
    },
    /// 1 where |x − c| < r, and 0 elsewhere.
    Jump {
        /// c.
        center: [f64; 3],
        /// r.
        radius: f64,
        /// Added; 0 unless given.
        #[serde(default)]
        offset: f64,
        /// Multiplied; 1 unless given.
        #[serde(default = "one")]
        height: f64,
    },
}

fn one() -> f64 {
    1.0
}

/// What is wrong with the file of a volume, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct VolumeFileError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub problem: VolumeProblem,
}

/// What can be wrong with the file of a volume.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VolumeProblem {
    /// No TOML, a key that means nothing, or a value of another type.
    #[error("{message}")]
    Content {
        /// What the reader said, and what is allowed.
        message: String,
    },
    /// A number that is none, or out of range.
    #[error("{what} is {value} (allowed: {allowed})")]
    Number {
        /// Which.
        what: String,
        /// What it is.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// Too many or too few.
    #[error("{count} {what} (allowed: {allowed})")]
    Count {
        /// Of what.
        what: &'static str,
        /// How many.
        count: usize,
        /// How many there may be.
        allowed: String,
    },
    /// A name that is none, or there twice.
    #[error("'{name}' is no name of its own (allowed: letters, digits and -, each name once)")]
    Name {
        /// As it stands there.
        name: String,
    },
    /// A camera of no lens, or of two.
    #[error("a camera with {which} (allowed: one of orthographic and perspective)")]
    Lens {
        /// Of which.
        which: &'static str,
    },
    /// A camera that looks nowhere.
    #[error(
        "a camera at what it looks at, or that looks along 'up' (allowed: another target, another 'up')"
    )]
    Blind,
}

/// Reads the text of a volume's file.
///
/// # Errors
/// [`VolumeFileError`] with the line, the problem and what is allowed.
pub fn read(text: &str) -> Result<VolumeCase, VolumeFileError> {
    let reader = Reader { text };
    let content = |at: usize, message: String| reader.at(at, VolumeProblem::Content { message });
    if text.len() > MAX_FILE {
        let message = format!("{} bytes (allowed: at most {MAX_FILE})", text.len());
        return Err(content(0, message));
    }
    if let Some(dot) = deepest_dot(text) {
        let message = "too many parts of a key (allowed: keys without dots)".into();
        return Err(content(dot, message));
    }
    let file: VolumeFile = toml::from_str(text).map_err(|error| {
        let at = error.span().unwrap_or_default().start;
        content(
            at,
            said(
                error.message(),
                "TOML with the keys of 'volver schema volume'",
            ),
        )
    })?;
    reader.names(0, std::slice::from_ref(&file.name))?;
    let channels = match &file.channels {
        None => vec!["radiance".to_string()],
        Some(names) => {
            let at = names.span().start;
            reader.count(at, "channels", names.get_ref().len(), MAX_CHANNELS)?;
            reader.names(at, names.get_ref())?;
            names.get_ref().clone()
        }
    };
    let corners = reader.corners(&file.corners)?;
    let field = reader.field(&file.field)?;
    let points = reader.points(&file.transfer, channels.len())?;
    Ok(VolumeCase {
        name: file.name,
        title: file.title,
        corners,
        field,
        transfer: TransferFunction { channels, points },
        camera: reader.camera(&file.camera)?,
    })
}

struct Reader<'t> {
    text: &'t str,
}

impl Reader<'_> {
    fn at(&self, at: usize, problem: VolumeProblem) -> VolumeFileError {
        let before = self.text.get(..at).unwrap_or_default();
        VolumeFileError {
            line: before.matches('\n').count() + 1,
            problem,
        }
    }

    fn finite(&self, at: usize, what: &str, values: &[f64]) -> Result<(), VolumeFileError> {
        match values.iter().find(|value| !value.is_finite()) {
            None => Ok(()),
            Some(&value) => Err(self.number(at, what, value, "finite numbers")),
        }
    }

    fn number(&self, at: usize, what: &str, value: f64, allowed: &'static str) -> VolumeFileError {
        let what = what.to_string();
        self.at(
            at,
            VolumeProblem::Number {
                what,
                value,
                allowed,
            },
        )
    }

    fn count(
        &self,
        at: usize,
        what: &'static str,
        count: usize,
        most: usize,
    ) -> Result<(), VolumeFileError> {
        if (1..=most).contains(&count) {
            return Ok(());
        }
        let allowed = format!("1 to {most}");
        Err(self.at(
            at,
            VolumeProblem::Count {
                what,
                count,
                allowed,
            },
        ))
    }

    fn names(&self, at: usize, names: &[String]) -> Result<(), VolumeFileError> {
        for (i, name) in names.iter().enumerate() {
            let is_good = (1..=64).contains(&name.len())
                && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-');
            if !is_good || names[..i].contains(name) || ["s", "lambda"].contains(&name.as_str()) {
                let name = name.escape_debug().to_string();
                return Err(self.at(at, VolumeProblem::Name { name }));
            }
        }
        Ok(())
    }

    fn corners(&self, file: &Spanned<BoxFile>) -> Result<[[f64; 3]; 2], VolumeFileError> {
        let at = file.span().start;
        let BoxFile { from, to } = *file.get_ref();
        self.finite(at, "a corner of the box", &[from, to].concat())?;
        for axis in 0..3 {
            let size = to[axis] - from[axis];
            if size.is_nan() || size <= 0.0 || size.is_infinite() {
                return Err(self.number(at, "a side of the box", size, "lengths above 0"));
            }
        }
        Ok([from, to])
    }

    fn field(&self, file: &Spanned<FieldFile>) -> Result<Field, VolumeFileError> {
        let at = file.span().start;
        let (offset, height, shape) = match file.get_ref().clone() {
            FieldFile::Ramp {
                slope,
                offset,
                height,
            } => (offset, height, Shape::Ramp { slope }),
            FieldFile::Radial {
                center,
                offset,
                height,
            } => (offset, height, Shape::Radial { center }),
            FieldFile::Wave {
                wave,
                phase,
                offset,
                height,
            } => (offset, height, Shape::Wave { wave, phase }),
            FieldFile::Blob {
                center,
                width,
                offset,
                height,
            } => (offset, height, Shape::Blob { center, width }),
            FieldFile::Kink {
                normal,
                place,
                offset,
                height,
            } => (offset, height, Shape::Kink { normal, place }),
            FieldFile::Jump {
                center,
                radius,
                offset,
                height,
            } => (offset, height, Shape::Jump { center, radius }),
        };
        let numbers: Vec<f64> = match &shape {
            Shape::Ramp { slope: vector } | Shape::Radial { center: vector } => vector.to_vec(),
            Shape::Wave {
                wave: vector,
                phase: one,
            }
            | Shape::Blob {
                center: vector,
                width: one,
            }
            | Shape::Kink {
                normal: vector,
                place: one,
            }
            | Shape::Jump {
                center: vector,
                radius: one,
            } => [&vector[..], &[*one]].concat(),
        };
        self.finite(at, "a number of the field", &numbers)?;
        self.finite(at, "offset or height", &[offset, height])?;
        match shape {
            Shape::Blob { width: size, .. } | Shape::Jump { radius: size, .. } if size <= 0.0 => {
                return Err(self.number(at, "the size of the field", size, "lengths above 0"));
            }
            _ => {}
        }
        Ok(Field {
            offset,
            height,
            shape,
        })
    }

    fn points(
        &self,
        file: &Spanned<Vec<PointFile>>,
        channels: usize,
    ) -> Result<Vec<ControlPoint>, VolumeFileError> {
        let at = file.span().start;
        self.count(at, "control points", file.get_ref().len(), MAX_POINTS)?;
        let mut points: Vec<ControlPoint> = Vec::new();
        for PointFile {
            s,
            extinction,
            emission,
        } in file.get_ref()
        {
            self.finite(at, "s", &[*s])?;
            self.finite(at, "an emission", emission)?;
            if !extinction.is_finite() || *extinction < 0.0 {
                return Err(self.number(at, "an extinction", *extinction, "at least 0, finite"));
            }
            if emission.len() != channels {
                let allowed = format!("{channels}, one a channel");
                let (what, count) = ("emissions of a control point", emission.len());
                return Err(self.at(
                    at,
                    VolumeProblem::Count {
                        what,
                        count,
                        allowed,
                    },
                ));
            }
            if points.last().is_some_and(|last| last.s > *s) {
                return Err(self.number(at, "s", *s, "not below that of the point before"));
            }
            points.push(ControlPoint {
                s: *s,
                extinction: *extinction,
                emission: emission.clone(),
            });
        }
        Ok(points)
    }

    fn camera(&self, file: &Spanned<CameraFile>) -> Result<Camera, VolumeFileError> {
        let at = file.span().start;
        let CameraFile {
            position,
            target,
            up,
            orthographic,
            perspective,
        } = file.get_ref().clone();
        self.finite(
            at,
            "a number of the camera",
            &[position, target, up].concat(),
        )?;
        let lens = match (orthographic, perspective) {
            (Some(OrthographicFile { height }), None) => {
                if !height.is_finite() || height <= 0.0 {
                    return Err(self.number(at, "height", height, "lengths above 0"));
                }
                Lens::Orthographic { height }
            }
            (None, Some(PerspectiveFile { angle_degrees })) => {
                if !(angle_degrees > 0.0 && angle_degrees < 180.0) {
                    let allowed = "above 0, below 180";
                    return Err(self.number(at, "angle_degrees", angle_degrees, allowed));
                }
                Lens::Perspective {
                    angle: angle_degrees.to_radians(),
                }
            }
            (None, None) => return Err(self.at(at, VolumeProblem::Lens { which: "neither" })),
            (Some(_), Some(_)) => return Err(self.at(at, VolumeProblem::Lens { which: "both" })),
        };
        let camera = Camera {
            position,
            target,
            up,
            lens,
        };
        if camera.axes().is_none() {
            return Err(self.at(at, VolumeProblem::Blind));
        }
        Ok(camera)
    }
}

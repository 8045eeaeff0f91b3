//! Cameras of glTF 2.0 (`.gltf`), in binary64: it looks along −z of its node, y above.

use super::camera::checked;
use super::text::{json, unreadable};
use crate::binary::{FileError, Trouble, refused};
use crate::input;
use crate::output;
use crate::volume::{Camera, Lens};
use serde::Deserialize;
use serde_json::json as value;
use std::path::Path;

/// How far from orthogonal the axes of a node may be, relative to their lengths: files are often written in binary32.
const ORTHOGONAL: f64 = 1e-5;

/// A camera of glTF, and what volver's cameras do not have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadCamera {
    /// The camera; its target is one length before it.
    pub camera: Camera,
    /// The width of the picture over its height, where the file says one.
    pub aspect: Option<f64>,
}

/// What glTF asks for and a camera does not have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The width of the picture over its height.
    pub aspect: f64,
    /// From where on things are drawn, and how far.
    pub depth: [f64; 2],
}

#[derive(Deserialize)]
struct File {
    #[serde(default)]
    nodes: Vec<NodeFile>,
    #[serde(default)]
    cameras: Vec<LensFile>,
}

#[derive(Deserialize)]
struct NodeFile {
    #[serde(default)]
    children: Vec<usize>,
    camera: Option<usize>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct LensFile {
    orthographic: Option<OrthographicLens>,
    perspective: Option<PerspectiveLens>,
}

#[derive(Deserialize)]
struct OrthographicLens {
    xmag: f64,
    ymag: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct PerspectiveLens {
    yfov: f64,
    aspect_ratio: Option<f64>,
}

/// Columns of a linear map, and where the origin goes.
#[derive(Clone, Copy)]
struct Affine {
    columns: [[f64; 3]; 3],
    moved: [f64; 3],
}

/// The camera of a `.gltf`: of its one node that has one, moved by the nodes above it, whose scale moves the camera and
/// does not change what it sees, as glTF has it. Planes of clipping are not read.
///
/// # Errors
/// [`FileError`] where it cannot be read, has no node with a camera or several, or axes that are sheared or mirrored.
pub fn read_gltf_camera(path: &Path) -> Result<ReadCamera, FileError> {
    let read = || {
        let text = input::text(path, input::COMPUTED).map_err(unreadable)?;
        let file: File = serde_json::from_str(&text).map_err(json)?;
        let mut with_camera = (0..)
            .zip(&file.nodes)
            .filter_map(|(i, node)| Some((i, node.camera?)));
        let (Some((node, lens)), None) = (with_camera.next(), with_camera.next()) else {
            let many = file
                .nodes
                .iter()
                .filter(|node| node.camera.is_some())
                .count();
            return Err(refused(format!("{many} nodes with a camera"), "one"));
        };
        let lens = file.cameras.get(lens);
        let lens = lens.ok_or_else(|| {
            refused(
                "a node with a camera that is not there",
                "an index into cameras",
            )
        })?;
        seen(&placed(&file.nodes, node)?, lens)
    };
    read().map_err(|trouble| trouble.at(path))
}

/// What moves a node, with all that are above it.
fn placed(nodes: &[NodeFile], mut node: usize) -> Result<Affine, Trouble> {
    let mut place = local(&nodes[node])?;
    // A tree has no path longer than this.
    for _ in 0..nodes.len() {
        let mut above = (0..)
            .zip(nodes)
            .filter(|(_, other)| other.children.contains(&node));
        let Some((parent, one)) = above.next() else {
            return Ok(place);
        };
        if above.next().is_some() {
            break;
        }
        place = local(one)?.then(&place);
        node = parent;
    }
    Err(refused(
        format!("node {node} below several nodes, or below itself"),
        "nodes that are a tree",
    ))
}

fn local(node: &NodeFile) -> Result<Affine, Trouble> {
    if let Some([a, b, c, p, d, e, f, q, g, h, i, r, x, y, z, w]) = node.matrix {
        // What it adds to the last part of a place, which is 1.
        let last = [p, q, r, w - 1.0];
        if !last.iter().all(|&part| part == 0.0) {
            return Err(refused(
                "a matrix that is not affine",
                "0, 0, 0, 1 as its last row",
            ));
        }
        return Ok(Affine {
            columns: [[a, b, c], [d, e, f], [g, h, i]],
            moved: [x, y, z],
        });
    }
    let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let square = x * x + y * y + z * z + w * w;
    if square.is_nan() || (square - 1.0).abs() > ORTHOGONAL {
        return Err(refused(
            format!("a rotation {:?}", [x, y, z, w]),
            "a quaternion of length 1",
        ));
    }
    // Divided by the square of its length, so that the rotation is one whatever the digits were.
    let two = 2.0 / square;
    let columns = [
        [
            1.0 - two * (y * y + z * z),
            two * (x * y + w * z),
            two * (x * z - w * y),
        ],
        [
            two * (x * y - w * z),
            1.0 - two * (x * x + z * z),
            two * (y * z + w * x),
        ],
        [
            two * (x * z + w * y),
            two * (y * z - w * x),
            1.0 - two * (x * x + y * y),
        ],
    ];
    let scale = node.scale.unwrap_or([1.0; 3]);
    Ok(Affine {
        columns: [0, 1, 2].map(|axis| columns[axis].map(|part| part * scale[axis])),
        moved: node.translation.unwrap_or_default(),
    })
}

impl Affine {
    /// A vector, moved by no translation.
    fn turned(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.columns;
        [0, 1, 2].map(|part| a[part] * x + b[part] * y + c[part] * z)
    }

    /// First the inner map, then this one.
    fn then(&self, inner: &Affine) -> Affine {
        let moved = self.turned(inner.moved);
        Affine {
            columns: inner.columns.map(|column| self.turned(column)),
            moved: [0, 1, 2].map(|part| moved[part] + self.moved[part]),
        }
    }
}

fn seen(place: &Affine, lens: &LensFile) -> Result<ReadCamera, Trouble> {
    let (lens, aspect) = match (&lens.orthographic, &lens.perspective) {
        (Some(lens), None) => {
            let height = 2.0 * lens.ymag;
            (Lens::Orthographic { height }, Some(lens.xmag / lens.ymag))
        }
        (None, Some(lens)) => (Lens::Perspective { angle: lens.yfov }, lens.aspect_ratio),
        _ => {
            return Err(refused(
                "a camera with no lens, or two",
                "one of orthographic and perspective",
            ));
        }
    };
    if let Some(aspect) = aspect.filter(|aspect| !(*aspect > 0.0 && aspect.is_finite())) {
        return Err(refused(
            format!("width over height {aspect}"),
            "a number above 0",
        ));
    }
    let [x, y, z] = place.columns;
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let near = |a, b| dot(a, b).abs() <= ORTHOGONAL * (dot(a, a) * dot(b, b)).sqrt();
    let volume = dot(
        x,
        [
            y[1] * z[2] - y[2] * z[1],
            y[2] * z[0] - y[0] * z[2],
            y[0] * z[1] - y[1] * z[0],
        ],
    );
    if !(near(x, y) && near(y, z) && near(z, x) && volume > 0.0) {
        return Err(refused(
            format!("axes of the camera {:?}", place.columns),
            "orthogonal, right-handed",
        ));
    }
    let length = dot(z, z).sqrt();
    let camera = checked(Camera {
        position: place.moved,
        target: [0, 1, 2].map(|part| place.moved[part] - z[part] / length),
        up: y,
        lens,
    })?;
    Ok(ReadCamera { camera, aspect })
}

/// Writes a camera as a `.gltf` of one node, for a picture of the width and the depth that glTF asks for. Where it looks is
/// kept, how far away its target is not.
///
/// # Errors
/// [`FileError`] where it cannot be written, looks nowhere or up, or the view is none of 0 < depth, near before far (0 ≤ depth of
/// an orthographic camera) and a width above 0.
pub fn write_gltf_camera(path: &Path, camera: &Camera, view: &View) -> Result<(), FileError> {
    let written = || {
        let axes = checked(*camera)?.axes();
        let [right, up, forward] =
            axes.ok_or_else(|| refused("a camera that looks nowhere", "a target"))?;
        let View {
            aspect,
            depth: [near, far],
        } = *view;
        let orthographic = matches!(camera.lens, Lens::Orthographic { .. });
        let first = near > 0.0 || (orthographic && near == 0.0);
        if !(first && near < far && far.is_finite() && aspect > 0.0 && aspect.is_finite()) {
            return Err(refused(
                format!("a depth from {near} to {far}, and a width over height of {aspect}"),
                "a depth above 0 (from 0 on of an orthographic camera) up to a larger one, a width above 0",
            ));
        }
        let lens = match camera.lens {
            Lens::Orthographic { height } => value!({
                "type": "orthographic",
                "orthographic": {
                    "xmag": height / 2.0 * aspect, "ymag": height / 2.0, "znear": near, "zfar": far,
                },
            }),
            Lens::Perspective { angle } => value!({
                "type": "perspective",
                "perspective": { "yfov": angle, "aspectRatio": aspect, "znear": near, "zfar": far },
            }),
        };
        let ([a, b, c], [d, e, f]) = (right, up);
        let [g, h, i] = forward.map(|part| 0.0 - part);
        let [x, y, z] = camera.position;
        let file = value!({
            "asset": { "version": "2.0", "generator": "volver" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{
                "camera": 0,
                "matrix": [a, b, c, 0.0, d, e, f, 0.0, g, h, i, 0.0, x, y, z, 1.0],
            }],
            "cameras": [lens],
        });
        let text = serde_json::to_string_pretty(&file).map_err(json)?;
        output::replace(path, |to| Ok(writeln!(to, "{text}")?))
    };
    written().map_err(|trouble: Trouble| trouble.at(path))
}

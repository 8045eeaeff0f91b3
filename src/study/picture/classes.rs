//! What a pixel's ray meets: where orders are lost, and why.

use crate::case::volume::{Break, VolumeCase};
use crate::reference::ExactPicture;
use serde::Serialize;

/// What is special in a pixel, the most special first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// The ray through its middle misses the volume.
    Outside,
    /// The edge of the volume: some rays of the pixel enter or leave it by another face than others, or miss it.
    Edge,
    /// A ray crosses a jump of the field.
    Jump,
    /// A ray crosses a kink of the field.
    Kink,
    /// A ray crosses a control point of the transfer functions.
    ControlPoint,
    /// Nothing: everything is analytic.
    Smooth,
}

impl Class {
    /// All of them.
    pub const ALL: [Class; 6] = [
        Class::Smooth,
        Class::ControlPoint,
        Class::Kink,
        Class::Jump,
        Class::Edge,
        Class::Outside,
    ];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Class::Outside => "outside the volume",
            Class::Edge => "at an edge of the volume",
            Class::Jump => "a jump of the field",
            Class::Kink => "a kink of the field",
            Class::ControlPoint => "a control point of the transfer functions",
            Class::Smooth => "nothing: smooth",
        }
    }
}

/// The class of every pixel, from the upper left corner, row by row. Edges count where pixels are means, or `with_edges`.
#[must_use]
pub fn classes(case: &VolumeCase, size: [usize; 2], with_edges: bool) -> Vec<Class> {
    let exact = ExactPicture::new(case);
    let [width, height] = size;
    let mut all = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            all.push(of_pixel(case, &exact, size, [x, y], with_edges));
        }
    }
    all
}

fn of_pixel(
    case: &VolumeCase,
    exact: &ExactPicture<'_>,
    size: [usize; 2],
    [x, y]: [usize; 2],
    with_edges: bool,
) -> Class {
    let at = |across: f64, down: f64| {
        let ray = case
            .camera
            .ray(size, [x as f64 + across, y as f64 + down])?;
        let chord = case.chord(&ray)?;
        Some((ray, chord))
    };
    let Some((ray, chord)) = at(0.5, 0.5) else {
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let is_edge = corners.iter().any(|(a, b)| at(*a, *b).is_some());
        return if is_edge && with_edges {
            Class::Edge
        } else {
            Class::Outside
        };
    };
    if with_edges {
        let faces = |ray: &crate::volume::Ray, chord: crate::case::volume::Chord| {
            [chord.from, chord.to].map(|lambda| face(case, ray.at(lambda)))
        };
        let own = faces(&ray, chord);
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let same =
            |(a, b): (f64, f64)| at(a, b).is_some_and(|(ray, chord)| faces(&ray, chord) == own);
        if !corners.into_iter().all(same) {
            return Class::Edge;
        }
    }
    let met = exact.ray(&ray).breaks;
    let worst = met.iter().filter_map(|(_, kind)| match kind {
        Break::FieldJump => Some(Class::Jump),
        Break::FieldKink => Some(Class::Kink),
        Break::ControlPoint => Some(Class::ControlPoint),
        Break::Turn => None,
    });
    worst.min().unwrap_or(Class::Smooth)
}

/// The face of the box that a place on its surface is nearest to: 0 to 5.
fn face(case: &VolumeCase, place: [f64; 3]) -> usize {
    let [low, high] = case.corners;
    let mut nearest = (f64::INFINITY, 0);
    for axis in 0..3 {
        let size = high[axis] - low[axis];
        for (side, wall) in [low[axis], high[axis]].into_iter().enumerate() {
            let off = (place[axis] - wall).abs() / size;
            if off < nearest.0 {
                nearest = (off, 2 * axis + side);
            }
        }
    }
    nearest.1
}

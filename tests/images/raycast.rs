//! The renderer beside closed forms, the crate's methods on the same rays, and plain loops.

// Numbers of segments are small.
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

mod box_of_samples;
mod floor;
mod interpolation;
mod memory;
mod methods;
mod refused;
mod same_bits;
mod transfer;
mod turned;

use volver::raycast::{Interpolation, LastStep, Picture, Precision, Raycaster};
use volver::volume::{Camera, ControlPoint, Grid, Lens, Ray, Samples, TransferFunction};

/// Samples of a function of the place along axes from 0 to 1.
fn sampled(dimensions: [usize; 3], field: impl Fn([f64; 3]) -> f64) -> Grid {
    let spacing = dimensions.map(|count| 1.0 / (count - 1) as f64);
    let mut grid = Grid {
        dimensions,
        origin: [0.0; 3],
        spacing,
        direction: Grid::ALONG_AXES,
        samples: Samples::F64(Vec::new()),
    };
    let [width, height, depth] = dimensions;
    let mut samples = Vec::new();
    for k in 0..depth {
        for j in 0..height {
            for i in 0..width {
                samples.push(field(grid.place([i, j, k].map(|index| index as f64))));
            }
        }
    }
    grid.samples = Samples::F64(samples);
    grid
}

/// τ and C of one channel, at each s.
fn transfer(points: &[[f64; 3]]) -> TransferFunction {
    let point = |&[s, extinction, emission]: &[f64; 3]| ControlPoint {
        s,
        extinction,
        emission: vec![emission],
    };
    TransferFunction {
        channels: vec!["light".into()],
        points: points.iter().map(point).collect(),
    }
}

/// Of a cube from 0 to 1, seen along `forward`.
fn orthographic(forward: [f64; 3], up: [f64; 3], height: f64) -> Camera {
    Camera {
        position: forward.map(|part| 0.5 - 4.0 * part),
        target: [0.5; 3],
        up,
        lens: Lens::Orthographic { height },
    }
}

fn raycaster<'v>(
    grid: &'v Grid,
    transfer: &'v TransferFunction,
    camera: Camera,
    method: &str,
) -> Raycaster<'v> {
    Raycaster {
        grid,
        transfer,
        camera,
        size: [5, 5],
        step: 1.0 / 64.0,
        last_step: LastStep::Equal,
        interpolation: Interpolation::Linear,
        method: method.parse().expect("a method"),
        precision: Precision::Binary64,
        opacity: false,
    }
}

fn render(raycaster: &Raycaster<'_>) -> Picture {
    raycaster.render().expect("a picture")
}

/// The pixels, each with its ray.
fn pixels(raycaster: &Raycaster<'_>, picture: &Picture) -> Vec<(Ray, f64)> {
    let [width, height] = raycaster.size;
    (0..width * height)
        .map(|pixel| {
            let (x, y) = (pixel % width, pixel / width);
            let middle = [x as f64 + 0.5, y as f64 + 0.5];
            let ray = raycaster.camera.ray(raycaster.size, middle).expect("a ray");
            (ray, picture.image.pixel(x, y)[0])
        })
        .collect()
}

/// Where a ray is in a box from 0 to `far`: by all six planes, each met within the other four or not. `None` where it is not.
fn inside(ray: &Ray, far: [f64; 3]) -> Option<[f64; 2]> {
    let near = 1e-9;
    let is_in = |place: [f64; 3]| {
        (0..3).all(|axis| place[axis] >= -near && place[axis] <= far[axis] + near)
    };
    let mut met: Vec<f64> = (0..3)
        .filter(|&axis| ray.direction[axis].abs() > near)
        .flat_map(|axis| {
            [0.0, far[axis]].map(|face| (face - ray.origin[axis]) / ray.direction[axis])
        })
        .filter(|&lambda| is_in(ray.at(lambda)))
        .collect();
    met.sort_by(f64::total_cmp);
    // What lies behind is not seen.
    let leave = *met.last().filter(|&&lambda| lambda >= 0.0)?;
    Some([met.first()?.max(0.0), leave])
}

/// Front to back on n segments, the sample of each at this part of it.
fn composited(length: f64, n: usize, part: f64, medium: impl Fn(f64) -> [f64; 2]) -> f64 {
    let step = length / n as f64;
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    for j in 0..n {
        let [extinction, emission] = medium((j as f64 + part) * step);
        let opacity = -(-extinction * step).exp_m1();
        radiance += emission * opacity * transmittance;
        transmittance *= 1.0 - opacity;
    }
    radiance
}

fn close(found: f64, expected: f64, within: f64) {
    assert!(
        (found - expected).abs() <= within * expected.abs().max(1e-3),
        "{found} and {expected}"
    );
}

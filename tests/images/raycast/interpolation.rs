//! The field between samples: exact where it has to be, and of the order that is said.

use super::{
    close, composited, inside, orthographic, pixels, raycaster, render, sampled, transfer,
};
use volver::raycast::{Interpolation, Raycaster};
use volver::volume::{Camera, Lens};

const ALL: [Interpolation; 3] = [
    Interpolation::Nearest,
    Interpolation::Linear,
    Interpolation::Cubic,
];

/// τ = 1 + s, C = 2 − s, wherever fields here are.
fn medium(s: f64) -> [f64; 2] {
    [1.0 + s, 2.0 - s]
}

fn linear_transfer() -> volver::volume::TransferFunction {
    transfer(&[[-1.0, 0.0, 3.0], [5.0, 6.0, -3.0]])
}

/// Cubic along each axis: what sixty-four samples say of it is all there is to say, up to the faces.
#[test]
fn cubic_interpolation_has_polynomials_of_degree_three() {
    let field = |[x, y, z]: [f64; 3]| {
        x.powi(3) - 2.0 * x * y * y * z + y.powi(3) * z * z - 0.5 * x * x * z.powi(3) + 0.5
    };
    let transfer = linear_transfer();
    for dimensions in [[4, 4, 4], [5, 9, 6]] {
        let grid = sampled(dimensions, field);
        let camera = Camera {
            position: [-1.5, 2.0, 3.0],
            target: [0.5; 3],
            up: [0.0, 1.0, 0.0],
            lens: Lens::Perspective { angle: 0.4 },
        };
        let raycaster = Raycaster {
            interpolation: Interpolation::Cubic,
            size: [17, 17],
            step: 10.0,
            ..raycaster(&grid, &transfer, camera, "front-to-back/front/expm1")
        };
        // One sample a ray, on a face.
        let on_faces = render(&raycaster);
        let finer = Raycaster {
            step: 0.05,
            method: "front-to-back/middle/expm1".parse().expect("a method"),
            ..raycaster
        };
        let within = render(&finer);
        for ((ray, face), (_, found)) in pixels(&raycaster, &on_faces)
            .into_iter()
            .zip(pixels(&finer, &within))
        {
            let Some([enter, leave]) = inside(&ray, [1.0; 3]) else {
                continue;
            };
            let along = |lambda: f64| medium(field(ray.at(enter + lambda)));
            let length = leave - enter;
            close(face, composited(length, 1, 0.0, along), 1e-9);
            let n = (length / 0.05).ceil() as usize;
            close(found, composited(length, n, 0.5, along), 1e-9);
        }
    }
}

/// Rays along an axis, a third or two thirds of a cell beside samples on every grid, so that errors fall evenly; the same
/// method on the same places of the field itself leaves what interpolation alone is off by.
#[test]
fn errors_fall_with_the_grid_as_is_said() {
    let field = |[x, y, z]: [f64; 3]| {
        (1.3 * x + 0.2).sin() * (0.9 * y + 0.5).cos() + 0.4 * (2.1 * z + x).sin()
    };
    let transfer = linear_transfer();
    let n = 4096;
    for interpolation in ALL {
        let errors: Vec<f64> = [64, 128]
            .map(|cells| {
                let grid = sampled([cells + 1; 3], field);
                let raycaster = Raycaster {
                    interpolation,
                    size: [3, 3],
                    step: 1.0 / f64::from(n),
                    ..raycaster(
                        &grid,
                        &transfer,
                        orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0),
                        "front-to-back/middle/expm1",
                    )
                };
                let squares =
                    pixels(&raycaster, &render(&raycaster))
                        .into_iter()
                        .map(|(ray, found)| {
                            let [x, y, _] = ray.origin;
                            let along = |z: f64| medium(field([x, y, z]));
                            (found - composited(1.0, n as usize, 0.5, along)).powi(2)
                        });
                squares.sum::<f64>().sqrt()
            })
            .to_vec();
        let expected = f64::from(interpolation.order());
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            println!("{interpolation}: {order:.3} of {errors:?}");
            assert!(
                (order - expected).abs() < 0.05,
                "{interpolation}: {order} of {errors:?}"
            );
        }
    }
}

/// Half way between two samples the nearest is that with the larger index, on even and on odd places.
#[test]
fn half_way_the_nearest_sample_is_the_next() {
    let transfer = transfer(&[[0.0, 1.0, 0.0], [8.0, 1.0, 8.0]]);
    let grid = sampled([6, 2, 2], |[x, _, _]| (5.0 * x).round());
    // Rays along z at x = 1/10, 3/10, …: half way in all five cells.
    let raycaster = Raycaster {
        interpolation: Interpolation::Nearest,
        ..raycaster(
            &grid,
            &transfer,
            orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0),
            "front-to-back/middle/expm1",
        )
    };
    let absorbed = -(-1.0_f64).exp_m1();
    for (ray, found) in pixels(&raycaster, &render(&raycaster)) {
        let place = 5.0 * ray.origin[0];
        // Places are computed, and may be a rounding to one side.
        if place.fract() == 0.5 {
            close(found, (place + 0.5) * absorbed, 1e-12);
        }
    }
}

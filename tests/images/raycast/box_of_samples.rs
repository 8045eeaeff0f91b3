//! Where rays enter and leave: a volume that is the same everywhere shows how long each was inside.

use super::{close, inside, orthographic, pixels, raycaster, render, sampled, transfer};
use volver::raycast::{Interpolation, LastStep, Raycaster};
use volver::volume::{Camera, Grid, Lens};

const EXTINCTION: f64 = 1.7;
const EMISSION: f64 = 0.6;

/// (1 − e^(−τ L)) C at every pixel, whatever the interpolation; how many rays meet the box.
fn check(camera: Camera, height: usize) -> usize {
    let grid = sampled([5, 4, 6], |_| 0.25);
    let transfer = transfer(&[[0.0, EXTINCTION, EMISSION]]);
    let mut hits = 0;
    for interpolation in [
        Interpolation::Nearest,
        Interpolation::Linear,
        Interpolation::Cubic,
    ] {
        let raycaster = Raycaster {
            interpolation,
            size: [height + 2, height],
            ..raycaster(&grid, &transfer, camera, "front-to-back/middle/expm1")
        };
        let picture = render(&raycaster);
        hits = 0;
        for (ray, found) in pixels(&raycaster, &picture) {
            let length = inside(&ray, [1.0; 3]).map_or(0.0, |[enter, leave]| leave - enter);
            let expected = -(-EXTINCTION * length).exp_m1() * EMISSION;
            assert!(
                (found - expected).abs() < 1e-11,
                "{found} and {expected} of {ray:?}"
            );
            hits += usize::from(inside(&ray, [1.0; 3]).is_some());
        }
        assert_eq!(picture.hits, hits, "{camera:?}");
    }
    hits
}

#[test]
fn rays_of_any_direction_are_as_long_as_their_way_through_the_box() {
    let directions = [
        [0.0, 0.0, 1.0],
        [0.0, -1.0, 0.0],
        [0.6, 0.0, 0.8],
        [0.48, 0.6, 0.64],
        [-0.48, 0.6, -0.64],
    ];
    for forward in directions {
        let camera = orthographic(forward, [0.3, 0.7, 0.2], 1.9);
        assert!(check(camera, 24) > 100);
        let perspective = Lens::Perspective { angle: 0.5 };
        assert!(
            check(
                Camera {
                    lens: perspective,
                    ..camera
                },
                24
            ) > 100
        );
    }
}

/// Of five pixels across 5/4 of the cube the outer ones lie on its faces and, in the corners, on its edges.
#[test]
fn rays_along_faces_and_edges_are_inside() {
    for (forward, up) in [
        ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
        ([-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
    ] {
        let camera = orthographic(forward, up, 1.25);
        assert_eq!(check(camera, 5), 25);
    }
}

/// Along the diagonals of two faces, turned by an angle that is no number of binary64.
#[test]
fn rays_along_diagonals_of_faces_are_inside() {
    let half = 0.5_f64.sqrt();
    let camera = orthographic([half, half, 0.0], [0.0, 0.0, 1.0], 1.25);
    let grid = sampled([3, 3, 3], |_| 0.25);
    let transfer = transfer(&[[0.0, EXTINCTION, EMISSION]]);
    let raycaster = raycaster(&grid, &transfer, camera, "front-to-back/middle/expm1");
    let picture = render(&raycaster);
    for row in 0..5 {
        let expected = -(-EXTINCTION * 2.0_f64.sqrt()).exp_m1() * EMISSION;
        close(picture.image.pixel(2, row)[0], expected, 1e-12);
    }
}

#[test]
fn rays_begin_at_a_camera_inside() {
    let camera = Camera {
        position: [0.25, 0.5, 0.5],
        target: [1.0, 0.6, 0.3],
        up: [0.0, 1.0, 0.0],
        lens: Lens::Perspective { angle: 2.5 },
    };
    assert_eq!(check(camera, 16), 18 * 16);
    let behind = Camera {
        position: [0.5, 0.5, 3.0],
        target: [0.5, 0.5, 4.0],
        ..camera
    };
    assert_eq!(check(behind, 16), 0, "what lies behind is not seen");
}

/// A ray in the plane of a face from a camera in that plane.
#[test]
fn a_camera_in_the_plane_of_a_face_sees_along_it() {
    let camera = Camera {
        position: [-2.0, 1.0, 0.5],
        target: [0.5, 1.0, 0.5],
        up: [0.0, 1.0, 0.0],
        lens: Lens::Perspective { angle: 0.4 },
    };
    let grid: Grid = sampled([3, 3, 3], |_| 0.25);
    let transfer = transfer(&[[0.0, EXTINCTION, EMISSION]]);
    let raycaster = raycaster(&grid, &transfer, camera, "front-to-back/middle/expm1");
    let picture = render(&raycaster);
    let expected = -(-EXTINCTION).exp_m1() * EMISSION;
    close(picture.image.pixel(2, 2)[0], expected, 1e-12);
    assert_eq!(picture.image.pixel(2, 1)[0], 0.0);
}

/// A last step that is shorter, of a medium that changes: where each sample lies is seen.
#[test]
fn a_shorter_last_step_has_its_sample_in_its_own_middle() {
    let grid = sampled([3, 3, 3], |[_, _, z]| z);
    let transfer = transfer(&[[0.0, 1.0, 0.0], [1.0, 3.0, 1.0]]);
    let camera = orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0);
    let medium = |z: f64| [1.0 + 2.0 * z, z];
    for (position, part) in [("front", 0.0), ("middle", 0.5), ("back", 1.0)] {
        let raycaster = Raycaster {
            step: 0.3,
            last_step: LastStep::Shorter,
            ..raycaster(
                &grid,
                &transfer,
                camera,
                &format!("front-to-back/{position}/expm1"),
            )
        };
        let (mut radiance, mut transmittance) = (0.0, 1.0);
        for (front, step) in [(0.0, 0.3), (0.3, 0.3), (0.6, 0.3), (0.9, 0.1)] {
            let [extinction, emission] = medium(front + part * step);
            let opacity = 1.0 - f64::exp(-extinction * step);
            radiance += emission * opacity * transmittance;
            transmittance *= 1.0 - opacity;
        }
        for (_, found) in pixels(&raycaster, &render(&raycaster)) {
            close(found, radiance, 1e-12);
        }
    }
    let raycaster = Raycaster {
        step: 0.4,
        last_step: LastStep::Shorter,
        ..raycaster(&grid, &transfer, camera, "trapezoid/trapezoid")
    };
    let (mut depth, mut radiance) = (0.0, 0.0);
    let source = |z: f64, depth: f64| medium(z)[0] * medium(z)[1] * f64::exp(-depth);
    for (front, back) in [(0.0, 0.4), (0.4, 0.8), (0.8, 1.0)] {
        let before = source(front, depth);
        depth += (back - front) * (medium(front)[0] + medium(back)[0]) / 2.0;
        radiance += (back - front) * (before + source(back, depth)) / 2.0;
    }
    for (_, found) in pixels(&raycaster, &render(&raycaster)) {
        close(found, radiance, 1e-12);
    }
}

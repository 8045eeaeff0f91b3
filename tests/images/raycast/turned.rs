//! A volume that is turned, seen by a camera that is turned with it, is the same picture.

use super::{close, orthographic, raycaster, render, sampled, transfer};
use volver::raycast::{Interpolation, Raycaster};
use volver::volume::{Camera, Grid, Lens};

type Matrix = [[f64; 3]; 3];

fn apply(matrix: &Matrix, vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
}

/// About three axes, one after the other.
fn rotation(angles: [f64; 3]) -> Matrix {
    let mut matrix = Grid::ALONG_AXES;
    for (axis, angle) in angles.into_iter().enumerate() {
        let (sin, cos) = angle.sin_cos();
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        for row in &mut matrix {
            (row[next], row[last]) = (
                cos * row[next] + sin * row[last],
                cos * row[last] - sin * row[next],
            );
        }
    }
    matrix
}

#[test]
fn a_turned_volume_before_a_turned_camera_is_the_same() {
    let field = |[x, y, z]: [f64; 3]| 0.3 + (3.0 * x + y).sin() * z + 0.2 * y;
    let grid = Grid {
        origin: [2.0, -1.0, 0.5],
        spacing: [0.3, 0.2, 0.25],
        ..sampled([4, 6, 5], field)
    };
    let transfer = transfer(&[[-1.0, 0.2, 0.1], [0.3, 2.0, 1.0], [1.5, 0.1, 0.4]]);
    let middle = grid.place([1.5, 2.5, 2.0]);
    let camera = Camera {
        position: [0.0, 0.5, 4.0],
        target: middle,
        up: [0.0, 1.0, 0.2],
        lens: Lens::Perspective { angle: 0.5 },
    };
    let turn = rotation([0.7, -1.9, 2.3]);
    let turned = Grid {
        origin: apply(&turn, grid.origin),
        direction: turn,
        ..grid.clone()
    };
    let turned_camera = Camera {
        position: apply(&turn, camera.position),
        target: apply(&turn, camera.target),
        up: apply(&turn, camera.up),
        ..camera
    };
    for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
        let raycaster = Raycaster {
            interpolation,
            size: [24, 20],
            step: 0.05,
            ..raycaster(&grid, &transfer, camera, "trapezoid/trapezoid")
        };
        let straight = render(&raycaster);
        let other = render(&Raycaster {
            grid: &turned,
            camera: turned_camera,
            ..raycaster
        });
        assert!(straight.hits > 100 && straight.hits == other.hits);
        for (found, expected) in other.image.values.iter().zip(&straight.image.values) {
            close(*found, *expected, 1e-11);
        }
        let elsewhere = render(&Raycaster {
            grid: &turned,
            ..raycaster
        });
        assert_ne!(elsewhere.image, straight.image);
    }
}

/// Columns of the direction are axes: x of this grid lies along z of space, and mirrored.
#[test]
fn columns_of_the_direction_are_the_axes() {
    let transfer = transfer(&[[0.0, 0.0, 1.0], [1.0, 1.0, 1.0]]);
    let along_x = sampled([3, 3, 3], |[x, _, _]| x);
    let turned = Grid {
        origin: [0.0, 0.0, 1.0],
        direction: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]],
        ..along_x
    };
    let camera = orthographic([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0);
    let raycaster = raycaster(&turned, &transfer, camera, "front-to-back/middle/expm1");
    let picture = render(&raycaster);
    // Rows from the upper edge, z = 9/10, down: s = 1 − z.
    for row in 0..5 {
        let s = 0.1 + 0.2 * row as f64;
        close(picture.image.pixel(2, row)[0], -(-s).exp_m1(), 1e-12);
    }
}

//! Pictures do not depend on how many lanes there are: every bit is that of one ray by itself.

use super::{orthographic, raycaster, render, sampled};
use volver::raycast::{Interpolation, LastStep, Precision, Raycaster};
use volver::real::lanes::Width;
use volver::volume::{Camera, ControlPoint, Lens, TransferFunction};

/// So many control points, of so many channels.
fn transfer(points: usize, channels: usize) -> TransferFunction {
    let wave = |i: usize, c: usize| 0.5 + 0.5 * ((7 * i + 3 * c) as f64).sin();
    TransferFunction {
        channels: (0..channels).map(|c| c.to_string()).collect(),
        points: (0..points)
            .map(|i| ControlPoint {
                s: i as f64 / (points - 1) as f64,
                extinction: 3.0 * wave(i, 1),
                emission: (0..channels).map(|c| wave(i, c)).collect(),
            })
            .collect(),
    }
}

#[test]
fn pictures_have_the_same_bits_in_every_width() {
    let grid = sampled([7, 5, 6], |[x, y, z]| {
        0.5 + 0.5 * (9.0 * x + 5.0 * y * z).sin()
    });
    let camera = Camera {
        lens: Lens::Perspective { angle: 0.45 },
        ..orthographic([0.48, 0.6, -0.64], [0.0, 0.0, 1.0], 1.0)
    };
    let few = transfer(4, 3);
    let many = transfer(30, 5);
    for precision in [Precision::Binary32, Precision::Binary64] {
        for interpolation in [
            Interpolation::Nearest,
            Interpolation::Linear,
            Interpolation::Cubic,
        ] {
            for (method, last_step) in [
                ("front-to-back/middle/expm1", LastStep::Equal),
                ("front-to-back/back/subtraction/depths", LastStep::Shorter),
                ("trapezoid/trapezoid", LastStep::Equal),
            ] {
                for transfer in [&few, &many] {
                    let raycaster = Raycaster {
                        precision,
                        interpolation,
                        last_step,
                        size: [37, 21],
                        step: 0.013,
                        opacity: true,
                        ..raycaster(&grid, transfer, camera, method)
                    };
                    let mut pictures = Width::there().map(|width| {
                        width.choose().expect("a width");
                        render(&raycaster)
                    });
                    let first = pictures.next().expect("a picture");
                    assert!(first.hits > 100 && first.hits < 37 * 21, "{}", first.hits);
                    assert!(pictures.all(|picture| picture == first), "{raycaster:?}");
                }
            }
        }
    }
}

/// What is seen of one ray does not depend on those beside it.
#[test]
fn a_pixel_alone_is_the_same_pixel() {
    let grid = sampled([7, 5, 6], |[x, y, z]| {
        0.5 + 0.5 * (9.0 * x + 5.0 * y * z).sin()
    });
    let transfer = transfer(4, 3);
    let camera = orthographic([0.48, 0.6, -0.64], [0.0, 0.0, 1.0], 1.0);
    let all = Raycaster {
        precision: Precision::Binary32,
        size: [21, 21],
        ..raycaster(&grid, &transfer, camera, "front-to-back/middle/expm1")
    };
    let middle = Raycaster {
        size: [1, 1],
        camera: Camera {
            lens: Lens::Orthographic { height: 1.0 / 21.0 },
            ..camera
        },
        ..all
    };
    assert_eq!(
        render(&all).image.pixel(10, 10),
        render(&middle).image.pixel(0, 0)
    );
}

//! What is no picture is refused, in one line that says what would be one.

use super::{orthographic, raycaster, sampled, transfer};
use volver::raycast::{Interpolation, LastStep, RaycastError, Raycaster};
use volver::volume::{Camera, Grid, Lens, Samples, TransferFunction};

// A list.
#[allow(clippy::too_many_lines)]
#[test]
fn nothing_is_rendered_of_nothing() {
    let grid = sampled([3; 3], |_| 0.5);
    let good = transfer(&[[0.0, 1.0, 1.0], [1.0, 2.0, 1.0]]);
    let camera = orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0);
    let fine = raycaster(&grid, &good, camera, "front-to-back/middle/expm1");
    assert!(fine.render().is_ok());
    let no_channel = TransferFunction {
        channels: Vec::new(),
        points: vec![],
    };
    let no_point = TransferFunction {
        points: Vec::new(),
        ..good.clone()
    };
    let falling = transfer(&[[1.0, 1.0, 1.0], [0.0, 1.0, 1.0]]);
    let negative = transfer(&[[0.0, -1.0, 1.0]]);
    let infinite = transfer(&[[0.0, 1.0, f64::INFINITY]]);
    let mut uneven = good.clone();
    uneven.points[1].emission.clear();
    let flat = sampled([3, 3, 3], |_| 0.5);
    let flat = Grid {
        dimensions: [9, 3, 1],
        samples: Samples::F32(vec![0.0; 27]),
        ..flat
    };
    let short = Grid {
        samples: Samples::F32(vec![0.0; 26]),
        ..grid.clone()
    };
    let nowhere = Grid {
        direction: [[0.0; 3]; 3],
        ..grid.clone()
    };
    let no_spacing = Grid {
        spacing: [0.5, 0.0, 0.5],
        ..grid.clone()
    };
    let at = |target, up| Camera {
        target,
        up,
        ..camera
    };
    let lens = |lens| Camera { lens, ..camera };
    let refused = [
        (
            Raycaster {
                camera: at(camera.position, camera.up),
                ..fine
            },
            "looks nowhere",
        ),
        (
            Raycaster {
                camera: at([0.5; 3], [0.0, 0.0, 3.0]),
                ..fine
            },
            "looks nowhere",
        ),
        (
            Raycaster {
                camera: at([f64::NAN; 3], camera.up),
                ..fine
            },
            "looks nowhere",
        ),
        (
            Raycaster {
                camera: lens(Lens::Orthographic { height: 0.0 }),
                ..fine
            },
            "the lens",
        ),
        (
            Raycaster {
                camera: lens(Lens::Perspective { angle: 3.2 }),
                ..fine
            },
            "the lens",
        ),
        (
            Raycaster {
                size: [0, 5],
                ..fine
            },
            "0 x 5 pixels",
        ),
        (
            Raycaster {
                size: [usize::MAX, 2],
                ..fine
            },
            "pixels",
        ),
        (Raycaster { step: 0.0, ..fine }, "step 0 "),
        (Raycaster { step: -1.0, ..fine }, "step -1 "),
        (
            Raycaster {
                step: f64::NAN,
                ..fine
            },
            "step NaN",
        ),
        (
            Raycaster {
                step: 1e-12,
                ..fine
            },
            "step 0.000000000001",
        ),
        (
            Raycaster {
                transfer: &no_channel,
                ..fine
            },
            "no channel",
        ),
        (
            Raycaster {
                transfer: &no_point,
                ..fine
            },
            "no control point",
        ),
        (
            Raycaster {
                transfer: &falling,
                ..fine
            },
            "point 1 lies below point 0",
        ),
        (
            Raycaster {
                transfer: &negative,
                ..fine
            },
            "extinction -1",
        ),
        (
            Raycaster {
                transfer: &infinite,
                ..fine
            },
            "control point 0",
        ),
        (
            Raycaster {
                transfer: &uneven,
                ..fine
            },
            "control point 1 has 0 emissions",
        ),
        (
            Raycaster {
                grid: &flat,
                ..fine
            },
            "1 samples along axis 2",
        ),
        (
            Raycaster {
                interpolation: Interpolation::Cubic,
                ..fine
            },
            "3 samples along axis 0 (allowed: 4 ",
        ),
        (
            Raycaster {
                grid: &short,
                ..fine
            },
            "26 samples in a grid of 27",
        ),
        (
            Raycaster {
                grid: &nowhere,
                ..fine
            },
            "the grid",
        ),
        (
            Raycaster {
                grid: &no_spacing,
                ..fine
            },
            "the grid",
        ),
        (
            Raycaster {
                method: "simpson/simpson".parse().expect("a method"),
                last_step: LastStep::Shorter,
                ..fine
            },
            "method simpson/simpson",
        ),
        (
            Raycaster {
                method: "preintegrated/linear/linear".parse().expect("a method"),
                ..fine
            },
            "no closed form",
        ),
    ];
    for (raycaster, says) in refused {
        let error: RaycastError = raycaster.render().expect_err(says);
        let said = error.to_string();
        assert!(said.contains(says) && said.contains("(allowed: "), "{said}");
        assert!(!said.contains('\n'));
    }
}

/// Rays that pass are black, and counted.
#[test]
fn a_camera_that_looks_elsewhere_sees_nothing() {
    let grid = sampled([3; 3], |_| 0.5);
    let transfer = transfer(&[[0.0, 1.0, 1.0]]);
    let camera = Camera {
        target: [0.5, 9.0, -3.0],
        ..orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0)
    };
    let raycaster = raycaster(&grid, &transfer, camera, "front-to-back/middle/expm1");
    let picture = raycaster.render().expect("a picture");
    assert_eq!(picture.hits, 0);
    assert!(picture.image.values.iter().all(|&value| value == 0.0));
}

//! The crate's methods on the same ray, as another route to the same number, and their orders in the step.

use super::{close, inside, orthographic, pixels, raycaster, render, sampled, transfer};
use rug::Rational;
use volver::case::{Case, Fresh, Structure, Transfer};
use volver::method::Method;
use volver::raycast::{Interpolation, Raycaster};
use volver::real::lanes::LaneFormat;
use volver::real::{Format, Real};
use volver::volume::{Grid, Ray, Samples};

/// s = x + 2 y − z + ½: linear along every ray, so that no interpolation but the nearest is off.
const SLOPE: [f64; 3] = [1.0, 2.0, -1.0];
const OFFSET: f64 = 0.5;

fn ramp([x, y, z]: [f64; 3]) -> f64 {
    OFFSET + SLOPE[0] * x + SLOPE[1] * y + SLOPE[2] * z
}

/// One ray through that field with τ = 1 + s, C = 2 − s.
#[derive(Debug)]
struct Ramp {
    from: f64,
    slope: f64,
    length: f64,
}

impl Case for Ramp {
    fn name(&self) -> &'static str {
        "ramp"
    }
    fn length(&self) -> Rational {
        Rational::from_f64(self.length).expect("a length")
    }
    fn field<R: Real>(&self, lambda: &R) -> R {
        let format = lambda.format();
        format.binary64(self.slope) * lambda + &format.binary64(self.from)
    }
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let format = s.format();
        Transfer {
            emission: format.int(2) - s,
            extinction: format.int(1) + s,
        }
    }
    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn structure(&self) -> Structure {
        Structure::default()
    }
}

impl Ramp {
    fn on(ray: &Ray) -> Option<Ramp> {
        let [enter, leave] = inside(ray, [1.0; 3])?;
        let along = (0..3).map(|axis| SLOPE[axis] * ray.direction[axis]);
        Some(Ramp {
            from: ramp(ray.at(enter)),
            slope: along.sum(),
            length: leave - enter,
        })
    }

    fn radiance_by(&self, method: &str, n: u64) -> f64 {
        let method: Method = method.parse().expect("a method");
        let nodes = Fresh::new(self, LaneFormat::<f64>::new());
        method.radiance(&nodes, n).expect("a radiance").0
    }
}

fn grid() -> Grid {
    sampled([4, 6, 5], ramp)
}

fn linear_transfer() -> volver::volume::TransferFunction {
    transfer(&[[-0.5, 0.5, 2.5], [0.0, 1.0, 2.0], [3.5, 4.5, -1.5]])
}

/// Methods that go in lanes, in every variant that they have, and others.
const METHODS: [&str; 16] = [
    "front-to-back/front/subtraction",
    "front-to-back/middle/subtraction",
    "front-to-back/back/expm1",
    "front-to-back/middle/expm1",
    "front-to-back/middle/expm1/depths",
    "front-to-back/middle/expm1/remainder",
    "front-to-back/middle/linear",
    "trapezoid/trapezoid",
    "front-to-back/middle/relative/neumaier",
    "back-to-front/middle/expm1",
    "midpoint/trapezoid",
    "simpson/simpson",
    "boole-fours/boole",
    "gauss-3/gauss-2",
    "layers/linear",
    "preintegrated/linear-by-4-trapezoid/linear-by-4-trapezoid",
];

#[test]
fn pixels_are_what_the_methods_say_of_their_rays() {
    let (grid, transfer) = (grid(), linear_transfer());
    let camera = orthographic([0.48, 0.6, -0.64], [0.0, 0.0, 1.0], 1.2);
    for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
        for method in METHODS {
            let raycaster = Raycaster {
                interpolation,
                step: 0.1,
                size: [7, 6],
                ..raycaster(&grid, &transfer, camera, method)
            };
            let mut rays = 0;
            for (ray, found) in pixels(&raycaster, &render(&raycaster)) {
                let Some(ramp) = Ramp::on(&ray) else {
                    assert_eq!(found, 0.0);
                    continue;
                };
                let least = (ramp.length * 10.0).ceil() as u64;
                let allowed = |n: &u64| raycaster.method.check_segments(*n).is_ok();
                let n = (least..least + 8)
                    .find(allowed)
                    .expect("a number of segments");
                close(found, ramp.radiance_by(method, n), 1e-12);
                rays += 1;
            }
            assert!(rays > 25, "{rays}");
        }
    }
}

/// Errors of a picture on so many segments along z: the largest of all pixels.
fn errors(method: &str, segments: [u32; 4]) -> Vec<f64> {
    let (grid, transfer) = (grid(), linear_transfer());
    let camera = orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0);
    let of = |n: u32| {
        let raycaster = Raycaster {
            step: 1.0 / f64::from(n),
            ..raycaster(&grid, &transfer, camera, method)
        };
        let errors = pixels(&raycaster, &render(&raycaster))
            .into_iter()
            .map(|(ray, found)| {
                let ramp = Ramp::on(&ray).expect("a ray inside");
                (found - ramp.radiance_by("gauss-3/gauss-5", 256)).abs()
            });
        errors.fold(0.0, f64::max)
    };
    segments.map(of).to_vec()
}

#[test]
fn errors_fall_with_the_step_as_theory_says() {
    for (method, expected, segments) in [
        ("front-to-back/front/expm1", 1.0, [256, 512, 1024, 2048]),
        (
            "front-to-back/back/subtraction",
            1.0,
            [256, 512, 1024, 2048],
        ),
        ("front-to-back/middle/linear", 1.0, [256, 512, 1024, 2048]),
        ("front-to-back/middle/expm1", 2.0, [32, 64, 128, 256]),
        ("trapezoid/trapezoid", 2.0, [32, 64, 128, 256]),
        ("simpson/simpson", 4.0, [16, 32, 64, 128]),
        // The inner rule is exact where the extinction is linear.
        ("gauss-2/boole", 6.0, [32, 64, 128, 256]),
    ] {
        let errors = errors(method, segments);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            println!("{method}: {order:.3} of {errors:?}");
            assert!(
                (order - expected).abs() < 0.05,
                "{method}: {order} of {errors:?}"
            );
        }
    }
}

/// Of samples in binary32 the ramp is the same here: they are numbers of binary32 all.
#[test]
fn samples_of_either_format_are_read() {
    let wide = Grid {
        samples: Samples::F64((0..64).map(|i| f64::from(i % 5) * 0.25).collect()),
        ..sampled([4; 3], ramp)
    };
    let narrow = Grid {
        samples: Samples::F32((0..64_u8).map(|i| f32::from(i % 5) * 0.25).collect()),
        ..wide.clone()
    };
    let transfer = linear_transfer();
    let camera = orthographic([0.48, 0.6, -0.64], [0.0, 0.0, 1.0], 1.2);
    let of = |grid| render(&raycaster(grid, &transfer, camera, METHODS[0]));
    assert_eq!(of(&wide), of(&narrow));
}

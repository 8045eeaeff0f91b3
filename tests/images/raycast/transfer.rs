//! Transfer functions: what a renderer reads of them is what they say.

use super::{close, orthographic, raycaster, render, sampled};
use volver::raycast::Raycaster;
use volver::real::lanes::Width;
use volver::volume::{ControlPoint, TransferFunction};

fn points(points: &[f64]) -> TransferFunction {
    let point = |(i, &s): (usize, &f64)| ControlPoint {
        s,
        extinction: 0.5 + (i as f64 * 1.7).sin().abs(),
        emission: vec![(i as f64 * 0.9).cos(), i as f64],
    };
    TransferFunction {
        channels: vec!["one".into(), "two".into()],
        points: points.iter().enumerate().map(point).collect(),
    }
}

/// A medium that is the same everywhere shows τ and C of one value: between points, on them, at jumps, and beyond.
#[test]
fn every_value_of_the_field_has_its_extinction_and_emission() {
    let many: Vec<f64> = (0..20).map(|i| f64::from(i) * 0.125 - 0.5).collect();
    let with_a_jump = [&many[..10], &many[9..]].concat();
    for transfer in [
        points(&[0.5]),
        points(&[0.0, 1.0]),
        points(&[-0.25, 0.5, 0.75, 1.5]),
        points(&[0.0, 0.5, 0.5, 1.0]),
        points(&[0.0, 0.0, 1.0]),
        points(&[0.0, 1.0, 1.0]),
        points(&[0.5, 0.5]),
        points(&many),
        points(&with_a_jump),
    ] {
        for width in Width::there() {
            width.choose().expect("a width");
            for i in -8..24 {
                let s = f64::from(i) * 0.0625 + if i % 3 == 0 { 0.01 } else { 0.0 };
                check(&transfer, s);
            }
            check(&transfer, f64::INFINITY);
            check(&transfer, f64::NEG_INFINITY);
        }
    }
}

fn check(transfer: &TransferFunction, s: f64) {
    let grid = sampled([2; 3], |_| s);
    let mut emission = [0.0; 2];
    let extinction = transfer.at(s, &mut emission);
    let raycaster = Raycaster {
        size: [2, 1],
        step: 0.5,
        opacity: true,
        // Samples themselves: ∞ − ∞ is no number.
        interpolation: volver::raycast::Interpolation::Nearest,
        ..raycaster(
            &grid,
            transfer,
            orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 0.5),
            "front-to-back/middle/expm1",
        )
    };
    let picture = render(&raycaster);
    assert_eq!(picture.image.channels, ["one", "two", "opacity"]);
    let opacity = -(-extinction).exp_m1();
    let pixel = picture.image.pixel(1, 0);
    close(pixel[0], opacity * emission[0], 1e-12);
    close(pixel[1], opacity * emission[1], 1e-12);
    close(pixel[2], opacity, 1e-12);
}

/// A sample that is no number is seen in the picture.
#[test]
fn what_is_no_number_stays_none() {
    let grid = sampled([3; 3], |[x, _, _]| if x > 0.75 { f64::NAN } else { 0.5 });
    let transfer = points(&[0.0, 1.0]);
    for width in Width::there() {
        width.choose().expect("a width");
        let raycaster = Raycaster {
            size: [4, 4],
            ..raycaster(
                &grid,
                &transfer,
                orthographic([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0),
                "front-to-back/middle/expm1",
            )
        };
        let picture = render(&raycaster);
        let is_number = |x| !picture.image.pixel(x, 2)[0].is_nan();
        // Right is −x.
        assert_eq!([0, 1, 2, 3].map(is_number), [false, false, true, true]);
    }
}

//! Binary32: errors fall as in binary64 until rounding takes over, and then rise.

use super::{composited, orthographic, pixels, raycaster, render, sampled, transfer};
use volver::raycast::{Precision, Raycaster};

#[test]
fn binary32_has_a_floor() {
    let grid = sampled([9; 3], |[x, y, z]| x + y + z);
    let transfer = transfer(&[[0.0, 0.5, 1.0], [3.0, 3.5, 0.0]]);
    let camera = orthographic([0.48, 0.6, -0.64], [0.0, 0.0, 1.0], 1.0);
    let error = |precision, steps: u32| {
        let raycaster = Raycaster {
            precision,
            size: [3, 3],
            step: 1.0 / f64::from(steps),
            ..raycaster(&grid, &transfer, camera, "front-to-back/middle/expm1")
        };
        let errors = pixels(&raycaster, &render(&raycaster))
            .into_iter()
            .map(|(ray, found)| {
                let [enter, leave] = super::inside(&ray, [1.0; 3]).expect("a ray inside");
                let medium = |lambda: f64| {
                    let s: f64 = ray.at(enter + lambda).iter().sum();
                    [0.5 + s, 1.0 - s / 3.0]
                };
                (found - composited(leave - enter, 1 << 17, 0.5, medium)).abs()
            });
        errors.fold(0.0, f64::max)
    };
    let wide = [8, 64, 1 << 14].map(|steps| error(Precision::Binary64, steps));
    let narrow = [8, 64, 1 << 14].map(|steps| error(Precision::Binary32, steps));
    println!("binary64 {wide:?}, binary32 {narrow:?}");
    // Far above the floor both are the method's.
    assert!((narrow[0] / wide[0] - 1.0).abs() < 0.01);
    assert!(wide[1] / wide[2] > 1e4, "binary64 goes on");
    // Units of binary32 in the last place, some of them for each of so many steps.
    let unit = f64::from(f32::EPSILON);
    assert!(narrow[2] > unit && narrow[2] < 4096.0 * unit);
}

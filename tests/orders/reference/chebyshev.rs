//! The fast transform against its definition; series against what they are series of.

use rug::Float;
use rug::float::Constant;
use volver::inside::reference::{Circle, Series, cosine_transform};

const BITS: u32 = 300;

fn circle(n: usize) -> Circle {
    let mut circle = Circle::new(BITS);
    circle.grow(n);
    circle
}

fn angle(k: usize, n: usize) -> Float {
    Float::with_val(BITS + 64, Constant::Pi) * k as u64 / n as u64
}

fn close(a: &Float, b: &Float, log2: i32) -> bool {
    Float::with_val(BITS + 64, a - b).abs() < Float::with_val(64, 1) >> -log2
}

/// Values without a pattern.
fn values(n: usize) -> Vec<Float> {
    let value =
        |k: u64| (k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11) as f64 * 2_f64.powi(-52) - 1.0;
    (0..=n as u64)
        .map(|k| Float::with_val(BITS, value(k + 1)) / 3_u32)
        .collect()
}

#[test]
fn the_circle_has_cosines() {
    let circle = circle(1024);
    for n in [2, 8, 1024] {
        for k in 0..=n {
            assert!(
                close(circle.cosine(k, n), &angle(k, n).cos(), -294),
                "cos {k}/{n}"
            );
            assert!(
                close(circle.sine(k, n), &angle(k, n).sin(), -294),
                "sin {k}/{n}"
            );
        }
    }
}

#[test]
fn the_fast_transform_is_the_quadratic_one() {
    for n in [2, 4, 8, 16, 64, 256] {
        let values = values(n);
        let fast = cosine_transform(&values, &circle(n));
        assert_eq!(fast.len(), n + 1);
        for (j, fast) in fast.iter().enumerate() {
            let mut sum = Float::new(BITS + 64);
            for (k, value) in values.iter().enumerate() {
                let term = Float::with_val(BITS + 64, value * angle(j * k % (2 * n), n).cos());
                sum += if k == 0 || k == n { term / 2_u32 } else { term };
            }
            assert!(close(fast, &sum, -282), "S{j} of {n}: {fast} {sum}");
        }
    }
}

#[test]
fn a_series_goes_through_its_values_at_more_points_too() {
    // f = x³ on [0, 1], of degree 3.
    let circle = circle(32);
    let cube = |n: usize| -> Vec<Float> {
        let places = (0..=n).map(|k| circle.place(k, n));
        places.map(|x| Float::with_val(BITS, &x * &x) * x).collect()
    };
    let series = Series::through(&cube(8), &circle);
    for (a, b) in series.values(32, &circle).iter().zip(&cube(32)) {
        assert!(close(a, b, -290));
    }
    assert_eq!(series.degree(), 8);
    // x = (1 − ξ)/2, x³ = (10 − 15 T₁ + 6 T₂ − T₃)/32.
    assert!(series.log2_largest(4..=8) < -290.0);
    assert!((series.log2_largest(2..=3) - 0.1875_f64.log2()).abs() < 1e-9);
    assert!((series.log2_largest(3..=8) + 5.0).abs() < 1e-9);
}

#[test]
fn integrals_of_exponentials_are_right() {
    // ∫₀ˣ e^(3u) du = (e^(3x) − 1)/3 on [0, 1/4], in x = 4u.
    let circle = circle(64);
    let width = Float::with_val(BITS, 0.25);
    let at = |k: usize| Float::with_val(BITS, circle.place(k, 64) * &width) * 3_u32;
    let values: Vec<Float> = (0..=64).map(|k| at(k).exp()).collect();
    let integral = Series::through(&values, &circle).integral(&width);
    for (k, value) in integral.values(64, &circle).iter().enumerate() {
        assert!(close(value, &(at(k).exp_m1() / 3_u32), -285), "{k}");
    }
    let total = Float::with_val(BITS, 0.75).exp_m1() / 3_u32;
    assert!(close(&integral.at_right(), &total, -290));
}

#[test]
fn points_between_have_the_values_of_the_finer_points() {
    for n in [2, 4, 16, 128] {
        let circle = circle(4 * n);
        let series = Series::through(&values(n), &circle);
        for finer in [2 * n, 4 * n] {
            let all = series.values(finer, &circle);
            let between = series.values_between(finer, &circle);
            assert_eq!(between.len(), finer / 2);
            for (k, value) in between.iter().enumerate() {
                assert!(close(value, &all[2 * k + 1], -290), "{n} {finer} {k}");
            }
        }
    }
}

#[test]
fn rounding_errors_of_transforms_add_up_to_some_n_units() {
    let n = 4096;
    let mut fine = Circle::new(BITS + 64);
    fine.grow(n);
    let values = values(n);
    let exact: Vec<Float> = values
        .iter()
        .map(|value| Float::with_val(BITS + 64, value))
        .collect();
    let rough = cosine_transform(&values, &circle(n));
    for (a, b) in rough.iter().zip(cosine_transform(&exact, &fine)) {
        // The values are of size 1 and the unit is 2^−300.
        assert!(close(a, &b, -300 + 12 + 6));
    }
}

//! Rays side by side: the bits of each ray by itself, whatever the width, and what is refused.

// What takes lanes must be inlined into the function that has the instructions.
#![allow(clippy::inline_always)]

use rug::Rational;
use volver::case::{Case, Fresh, Structure, Transfer};
use volver::method::{Method, RayError, RayMedium, composite_given, drawn_radiances, radiances};
use volver::real::lanes::{LaneFloat, LaneFormat, LaneReal, Lanes, Width};
use volver::real::{Format, Real};

/// C = sin s², τ = (s + o) cos s² + 1 with another o for each ray.
const RAYS: usize = 45;

fn offset<T: LaneFloat>(ray: usize) -> T {
    LaneFormat::<T>::new().fraction(ray as u64, 17).0
}

struct Medium<T> {
    offsets: Vec<T>,
}

impl<T: LaneFloat> Medium<T> {
    fn new() -> Self {
        Medium {
            offsets: (0..RAYS).map(offset).collect(),
        }
    }
}

impl<T: LaneFloat> RayMedium<T> for Medium<T> {
    #[inline(always)]
    fn transfer<L: Lanes<Element = T>>(&self, ray: usize, s: L) -> Transfer<L> {
        let (sin, cos) = Lanes::sin_cos(s * s);
        Transfer {
            emission: sin,
            extinction: (s + s.load(&self.offsets[ray..])) * cos + s.all(T::ONE),
        }
    }
}

/// One of these rays as any case is.
#[derive(Debug)]
struct Alone {
    ray: usize,
    length: Rational,
}

impl Case for Alone {
    fn name(&self) -> &'static str {
        "alone"
    }
    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn length(&self) -> Rational {
        self.length.clone()
    }
    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let format = s.format();
        let (emission, cos) = (s.clone() * s).sin_cos();
        let offset = format.fraction(self.ray as u64, 17);
        Transfer {
            emission,
            extinction: (s.clone() + &offset) * &cos + &format.int(1),
        }
    }
    fn structure(&self) -> Structure {
        Structure::default()
    }
}

const METHODS: [&str; 8] = [
    "trapezoid/trapezoid",
    "midpoint/trapezoid",
    "front-to-back/front/expm1",
    "front-to-back/middle/expm1",
    "front-to-back/middle/expm1/depths",
    "front-to-back/middle/expm1/remainder",
    "front-to-back/back/subtraction",
    "front-to-back/middle/linear/remainder",
];

/// Each method over all rays, against the library's own run of each ray.
fn are_the_rays_themselves<T: LaneFloat>(length: &Rational, n: u64) {
    for name in METHODS {
        let method: Method = name.parse().unwrap();
        let alone: Vec<T> = (0..RAYS)
            .map(|ray| {
                let case = Alone {
                    ray,
                    length: length.clone(),
                };
                let nodes = Fresh::new(&case, LaneFormat::<T>::new());
                let LaneReal(radiance) = method.radiance(&nodes, n).unwrap();
                radiance
            })
            .collect();
        for width in Width::there() {
            width.choose().unwrap();
            let found = radiances(&method, &Medium::<T>::new(), length, n, RAYS).unwrap();
            assert_eq!(found, alone, "{name} in {width}");
        }
    }
}

#[test]
fn rays_side_by_side_are_the_rays_themselves() {
    are_the_rays_themselves::<f64>(&(13, 10).into(), 37);
    are_the_rays_themselves::<f32>(&(13, 10).into(), 37);
    // More than a block, and a length that no machine integers make.
    are_the_rays_themselves::<f64>(&Rational::from((1_u128 << 100, (1_u128 << 100) - 1)), 600);
    are_the_rays_themselves::<f32>(&1.into(), 1);
}

/// Each sampling under outer rules of every kind, each ray with a seed of its own, against the library's own run of each
/// ray with its seed.
fn drawn_rays_are_the_rays_themselves<T: LaneFloat>(length: &Rational, n: u64) {
    let seeds: Vec<u64> = (0..RAYS as u64).map(|ray| ray * ray + 3).collect();
    for sampling in [
        "monte-carlo",
        "monte-carlo-independent",
        "monte-carlo-stratified",
    ] {
        for outer in [
            "trapezoid",
            "riemann-left",
            "riemann-right",
            "simpson",
            "boole",
        ] {
            let method = |seed: u64| -> Method {
                let name = format!("{sampling}@{seed}/{outer}");
                name.parse().unwrap()
            };
            let alone: Vec<T> = seeds
                .iter()
                .enumerate()
                .map(|(ray, &seed)| {
                    let case = Alone {
                        ray,
                        length: length.clone(),
                    };
                    let nodes = Fresh::new(&case, LaneFormat::<T>::new());
                    let LaneReal(radiance) = method(seed).radiance(&nodes, n).unwrap();
                    radiance
                })
                .collect();
            assert!(alone.windows(2).all(|pair| pair[0] != pair[1]));
            for width in Width::there() {
                width.choose().unwrap();
                let medium = Medium::<T>::new();
                let found = drawn_radiances(&method(0), &medium, length, n, &seeds).unwrap();
                assert_eq!(found, alone, "{sampling}/{outer} in {width}");
            }
        }
    }
}

#[test]
fn rays_of_random_samples_side_by_side_are_the_rays_themselves() {
    drawn_rays_are_the_rays_themselves::<f64>(&(13, 10).into(), 36);
    drawn_rays_are_the_rays_themselves::<f32>(&(13, 10).into(), 36);
    drawn_rays_are_the_rays_themselves::<f64>(&(1, 3).into(), 4);
}

#[test]
fn given_samples_are_composited_ray_by_ray() {
    let (rays, segments) = (21, 300);
    let sample = |i: usize, scale: f64| (i as f64 * 0.7).sin().abs() * scale;
    let colors: Vec<f64> = (0..rays * segments).map(|i| sample(i, 1.0)).collect();
    let mut opacities: Vec<f64> = (0..rays * segments).map(|i| sample(i + 5, 0.02)).collect();
    // What is no number in one ray leaves the others alone.
    opacities[7] = f64::NAN;
    opacities[rays + 9] = f64::INFINITY;
    for remainder in [false, true] {
        let alone: Vec<f64> = (0..rays)
            .map(|ray| {
                let (mut radiance, mut transmittance) = (0.0, 1.0);
                for j in 0..segments {
                    let (color, opacity) = (colors[j * rays + ray], opacities[j * rays + ray]);
                    radiance += color * opacity * transmittance;
                    if remainder {
                        transmittance -= opacity * transmittance;
                    } else {
                        transmittance *= 1.0 - opacity;
                    }
                }
                radiance
            })
            .collect();
        assert!(alone[7].is_nan() && !alone[9].is_finite() && alone[8].is_finite());
        for width in Width::there() {
            width.choose().unwrap();
            let found = composite_given(&colors, &opacities, rays, remainder).unwrap();
            let same =
                |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
            assert!(found.iter().zip(&alone).all(same), "in {width}");
        }
    }
}

#[test]
fn what_does_not_go_in_lanes_is_refused_in_one_line() {
    let run = |name: &str, n| {
        let method: Method = name.parse().unwrap();
        radiances(&method, &Medium::<f64>::new(), &1.into(), n, 3)
    };
    for name in [
        "boole/simpson",
        "trapezoid/trapezoid/linear",
        "front-to-back/middle/relative",
        "front-to-back/middle/expm1/neumaier",
        "front-to-back/middle/expm1/stop=1:255",
        "back-to-front/middle/expm1",
        "layers/half-own",
    ] {
        let error = run(name, 4).unwrap_err();
        assert!(matches!(&error, RayError::Method { method } if method == name));
        assert!(!error.to_string().contains('\n'));
    }
    let draw = |name: &str, n| {
        let method: Method = name.parse().unwrap();
        drawn_radiances(&method, &Medium::<f64>::new(), &1.into(), n, &[1, 2, 3])
    };
    for name in [
        "trapezoid/trapezoid",
        "monte-carlo@1/midpoint",
        "monte-carlo@1/trapezoid/linear",
        "front-to-back/middle/expm1",
    ] {
        let error = draw(name, 4).unwrap_err();
        assert!(matches!(&error, RayError::Undrawn { method } if method == name));
        assert!(!error.to_string().contains('\n'));
    }
    let error = draw("monte-carlo@1/simpson", 3).unwrap_err();
    assert!(matches!(error, RayError::Segments(_)), "{error}");
    let error = run("trapezoid/trapezoid", 0).unwrap_err();
    assert!(matches!(error, RayError::Segments(_)), "{error}");
    for (colors, opacities, rays) in [(6, 6, 4), (6, 5, 3), (6, 6, 0)] {
        let error = composite_given(&vec![0.5; colors], &vec![0.5; opacities], rays, false);
        let expected = RayError::Samples {
            colors,
            opacities,
            rays,
        };
        assert_eq!(error, Err(expected));
    }
    let method: Method = "trapezoid/trapezoid".parse().unwrap();
    assert_eq!(
        radiances(&method, &Medium::<f64>::new(), &1.into(), 4, 0),
        Ok(Vec::new())
    );
}

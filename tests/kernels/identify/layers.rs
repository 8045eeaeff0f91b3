//! Layer rules that state no rule: named where answers are theirs on rays of all kinds.
//!
//! What looks alike: other means of both ends' C (of C that changes little); the depth by another rule than the mean of both
//! ends (even media); a curve with another limiter (where it does not overshoot), of another degree, or with other
//! derivatives at the ends of the ray (its inner layers).

use volver::identify::{Budget, Examined, Verdict, examine};
use volver::kernel::{Closure, Declaration, Segments};

/// What a layer weighs the points of C with that stand at the same distances, x ∫ Bᵢ(u) e^(−xu) du: by Gauss's five points
/// on parts of depth ½ or less.
fn bernstein(points: &[f64], x: f64) -> f64 {
    const GAUSS: [(f64, f64); 5] = [
        (0.046_910_077_030_668, 0.118_463_442_528_094_54),
        (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
        (0.5, 0.284_444_444_444_444_44),
        (0.769_234_655_052_841_5, 0.239_314_335_249_683_24),
        (0.953_089_922_969_332, 0.118_463_442_528_094_54),
    ];
    let parts = (4.0 * x).ceil().clamp(4.0, 4_000.0);
    let mut sum = 0.0;
    for part in 0..parts as usize {
        for (at, weight) in GAUSS {
            let u = (part as f64 + at) / parts;
            let v = 1.0 - u;
            let c = match points {
                [a, b, c] => v * v * a + 2.0 * u * v * b + u * u * c,
                [a, b, c, d] => {
                    v * v * v * a + 3.0 * u * v * v * b + 3.0 * u * u * v * c + u * u * u * d
                }
                _ => unreachable!(),
            };
            sum += weight / parts * x * c * (-x * u).exp();
        }
    }
    sum
}

/// Derivatives at places: of the parabola through three, or monotone (Fritsch and Butland), and of a line at both ends.
fn slopes(steps: &[f64], values: &[f64], monotone: bool) -> Vec<f64> {
    let secant = |k: usize| {
        if steps[k].abs() > 0.0 {
            (values[k + 1] - values[k]) / steps[k]
        } else {
            0.0
        }
    };
    let last = steps.len();
    let at = |k: usize| {
        if k == 0 || k == last {
            return secant(if k == 0 { 0 } else { last - 1 });
        }
        let (near, far) = (secant(k - 1), secant(k));
        let (before, behind) = (steps[k - 1], steps[k]);
        // A layer without depth says nothing of its neighbours.
        if before.abs() <= 0.0 || behind.abs() <= 0.0 {
            return if before.abs() <= 0.0 { far } else { near };
        }
        if monotone {
            if near * far <= 0.0 {
                return 0.0;
            }
            let part = (1.0 + behind / (before + behind)) / 3.0;
            return near * far / (part * far + (1.0 - part) * near);
        }
        (before * far + behind * near) / (before + behind)
    };
    (0..=last).map(at).collect()
}

/// The points between the ends of every layer.
fn points(steps: &[f64], values: &[f64], degree: usize, limiter: &str) -> Vec<Vec<f64>> {
    let slopes = slopes(steps, values, limiter == "monotone");
    let of = |k: usize| {
        let (f, b, h) = (values[k], values[k + 1], steps[k]);
        let (near, far) = (h * slopes[k], h * slopes[k + 1]);
        let mut inner = if degree == 2 {
            vec![0.5 * (f + b) + 0.25 * (near - far)]
        } else {
            vec![f + near / 3.0, b - far / 3.0]
        };
        if limiter == "clip" {
            for point in &mut inner {
                *point = point.clamp(f.min(b), f.max(b));
            }
        }
        let mut all = vec![f];
        all.append(&mut inner);
        all.push(b);
        all
    };
    (0..steps.len()).map(of).collect()
}

fn bezier(segments: &Segments, channel: usize, degree: usize, limiter: &str) -> f64 {
    let steps: Vec<f64> = segments.lengths().collect();
    let of_depth = points(&steps, &segments.edges.extinction, degree, limiter);
    let depths: Vec<f64> = of_depth
        .iter()
        .zip(&steps)
        .map(|(points, step)| step * points.iter().sum::<f64>() / points.len() as f64)
        .collect();
    let (mut sum, mut through) = (0.0, 1.0);
    let all = points(&depths, &segments.edges.emission[channel], degree, limiter);
    for (points, x) in all.iter().zip(depths) {
        sum += through * bernstein(points, x);
        through *= (-x).exp();
    }
    sum
}

/// By the ends' C and the depth of every segment; `middle` where the depth is that of the middle.
fn by_mean(segments: &Segments, channel: usize, middle: bool, mean: fn(f64, f64) -> f64) -> f64 {
    let (edges, middles) = (&segments.edges, &segments.middles);
    let (mut sum, mut through) = (0.0, 1.0);
    for (i, d) in segments.lengths().enumerate() {
        let tau = if middle {
            middles.extinction[i]
        } else {
            0.5 * (edges.extinction[i] + edges.extinction[i + 1])
        };
        let c = &edges.emission[channel];
        sum += through * -(-tau * d).exp_m1() * mean(c[i], c[i + 1]);
        through *= (-tau * d).exp();
    }
    sum
}

/// As it stands in books, and 0 or the value itself where that has no value.
fn logarithmic(a: f64, b: f64) -> f64 {
    if a <= 0.0 || b <= 0.0 {
        0.0
    } else if ((b - a) / a).abs() < 1e-12 {
        a
    } else {
        (b - a) / (b / a).ln()
    }
}

fn examined(
    declare: impl FnOnce(&mut Declaration),
    radiance: fn(&Segments, usize) -> f64,
) -> Examined {
    let mut declaration = Declaration::new("layers");
    declaration.positive_emission = true;
    declare(&mut declaration);
    let mut kernel = Closure::new(
        declaration,
        move |task: &volver::kernel::Task<'_>, channel| {
            task.cut()
                .map_or(f64::NAN, |segments| radiance(segments, channel))
        },
    );
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

#[test]
fn layer_rules_that_state_no_rule_are_named_as_methods() {
    type Known = (&'static str, fn(&Segments, usize) -> f64);
    let kernels: [Known; 5] = [
        ("layers/logarithmic", |s, c| {
            by_mean(s, c, false, logarithmic)
        }),
        ("layers/bezier-quadratic", |s, c| bezier(s, c, 2, "")),
        ("layers/bezier-quadratic-clip", |s, c| {
            bezier(s, c, 2, "clip")
        }),
        ("layers/bezier-cubic", |s, c| bezier(s, c, 3, "")),
        ("layers/bezier-cubic-monotone", |s, c| {
            bezier(s, c, 3, "monotone")
        }),
    ];
    for (name, radiance) in kernels {
        let method: volver::method::Method = name.parse().unwrap();
        let found = examined(|_| (), radiance);
        let misses: Vec<_> = found
            .found
            .not_identified
            .iter()
            .map(|part| &part.reason)
            .collect();
        assert_eq!(found.found.method, Some(method), "{name}: {misses:?}");
        assert!(found.found.named().is_none(), "{name}");
        assert_eq!(found.verdict(), Verdict::Right, "{name}");
        let declared = examined(|d| d.method = Some(method), radiance);
        assert_eq!(declared.verdict(), Verdict::Right, "{name}");
        // Another one is declared.
        let other = "layers/bezier-quadratic-monotone".parse().unwrap();
        let declared = examined(|d| d.method = Some(other), radiance);
        let names: Vec<&str> = declared.deviations.iter().map(|d| d.name).collect();
        assert_eq!(names, ["method"], "{name}");
    }
}

#[test]
fn what_looks_like_a_layer_rule_and_is_none_has_no_name() {
    type Known = (&'static str, fn(&Segments, usize) -> f64);
    let kernels: [Known; 6] = [
        ("a geometric mean", |s, c| {
            by_mean(s, c, false, |a, b| (a * b).sqrt())
        }),
        ("depths of middles", |s, c| by_mean(s, c, true, logarithmic)),
        ("1.000001 times as much", |s, c| {
            1.000_001 * by_mean(s, c, false, logarithmic)
        }),
        ("a logarithmic mean of what is bright", |s, c| {
            by_mean(s, c, false, |a, b| {
                if a.min(b) < 1e-3 {
                    0.5 * (a + b)
                } else {
                    logarithmic(a, b)
                }
            })
        }),
        ("a curve of C on one of τ of another degree", |s, c| {
            0.5 * (bezier(s, c, 2, "") + bezier(s, c, 3, ""))
        }),
        ("a curve that is clipped at 0", |s, c| {
            bezier(s, c, 2, "").max(0.01)
        }),
    ];
    for (what, radiance) in kernels {
        let found = examined(|_| (), radiance);
        assert_eq!(found.found.method, None, "{what}");
        assert!(found.found.named().is_none(), "{what}");
    }
}

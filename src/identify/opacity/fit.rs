//! The law that most measured points have: the one whose parameter is the same at all of them.

use super::measure::Point;
use crate::identify::number::simplest;
use crate::identify::rule::{Depth, Law, Power, Scale, Shape, Weight};
use crate::identify::weights::{Answers, Measured};
use crate::identify::{Bracket, Parameter};

/// A law, and the parameters' brackets.
#[derive(Clone, Debug)]
pub(in crate::identify) struct Fitted {
    pub(in crate::identify) law: Law,
    /// Of κ.
    pub(in crate::identify) factor: (f64, f64),
    /// Of the scale.
    pub(in crate::identify) scale: (f64, f64),
    /// Of what else was bisected.
    pub(in crate::identify) brackets: Vec<Bracket>,
    /// The part of the points that have it.
    pub(in crate::identify) share: f64,
    /// The relative precision that it is followed to, where that is coarser than rounding.
    pub(in crate::identify) grain: f64,
}

/// Points with an error of more than this part say nothing of a parameter.
const WORST: f64 = 0.02;
/// A law has at least so many of the points that say anything.
const FEWEST: f64 = 0.25;
/// And this many of them.
const FEWEST_POINTS: usize = 6;

/// How well a number can be known, as a part of it.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// Known less well it says nothing.
    worst: f64,
    /// It is known no better.
    best: f64,
}

/// A number that many measured ones agree on.
#[derive(Clone, Copy, Debug)]
struct Common {
    value: f64,
    error: f64,
    count: usize,
}

/// The value on which most agree, within three times their errors.
fn common(all: &[Measured], known: Known) -> Option<Common> {
    let usable = |m: &&Measured| {
        m.value.is_finite() && m.value != 0.0 && m.error <= known.worst * m.value.abs()
    };
    let good: Vec<Measured> = all.iter().filter(usable).copied().collect();
    let agree = |center: &Measured, m: &&Measured| {
        (m.value - center.value).abs() <= 3.0 * (m.error + center.error)
    };
    // Those that are known well decide: with a loose one all agree.
    let part = |m: &Measured| m.error / m.value.abs();
    let mut parts: Vec<f64> = good.iter().map(part).collect();
    parts.sort_by(f64::total_cmp);
    let loosest = parts.get(parts.len() / 2).copied()?.max(1e-10);
    let sharp: Vec<Measured> = good
        .iter()
        .filter(|m| part(m) <= loosest)
        .copied()
        .collect();
    let count = |center: &Measured| sharp.iter().filter(|m| agree(center, m)).count();
    // Of many centers with as many followers the surest one.
    let center = sharp
        .iter()
        .max_by(|u, v| count(u).cmp(&count(v)).then(v.error.total_cmp(&u.error)))?;
    let mut followers: Vec<&Measured> = good.iter().filter(|m| agree(center, m)).collect();
    // Of those that agree with a loose center some do not with the others.
    let middle = weighted_median(&followers)?;
    followers.retain(|m| (m.value - middle.value).abs() <= 3.0 * (m.error + middle.error));
    let (mut sum, mut worth, mut least) = (0.0, 0.0, f64::INFINITY);
    for m in &followers {
        let weight = (m.error + 1e-17 * m.value.abs()).powi(-2);
        sum += m.value * weight;
        worth += weight;
        least = least.min(m.error);
    }
    Some(Common {
        value: sum / worth,
        // Errors are bounds and may lean to one side: no less than the best of them.
        error: least.max(known.best * (sum / worth).abs()),
        count: followers.len(),
    })
}

/// The measured number with half of the worth on either side.
fn weighted_median(all: &[&Measured]) -> Option<Measured> {
    let worth = |m: &Measured| (m.error + 1e-17 * m.value.abs()).powi(-1);
    let mut sorted: Vec<&Measured> = all.to_vec();
    sorted.sort_by(|u, v| u.value.total_cmp(&v.value));
    let half = sorted.iter().map(|m| worth(m)).sum::<f64>() / 2.0;
    let mut sum = 0.0;
    let found = sorted.into_iter().find(|m| {
        sum += worth(m);
        sum >= half
    });
    found.copied()
}

fn powers() -> Vec<[Power; 3]> {
    let of = |halves: i8| Power { halves };
    let mut all = Vec::new();
    for extinction in [2, 4, 1, 0, 3] {
        for length in [2, 0, 4, 1, 3] {
            for ray in [0, -2, 2] {
                all.push([of(extinction), of(length), of(ray)]);
            }
        }
    }
    // The plain one first, then by how far they are from it.
    all.sort_by_key(|[a, b, c]| {
        let far = |p: &Power, from: i8| u32::from((p.halves - from).unsigned_abs());
        far(a, 2) + far(b, 2) + 2 * far(c, 0)
    });
    all
}

fn depth_with(powers: [Power; 3], factor: f64) -> Depth {
    let [extinction, length, ray] = powers;
    Depth {
        factor,
        extinction,
        length,
        ray,
    }
}

fn bare(powers: [Power; 3], point: &Point) -> f64 {
    depth_with(powers, 1.0).of(&point.extinction, &point.length, &point.ray)
}

/// κ of a point under a shape, with its error.
fn factor(shape: Shape, powers: [Power; 3], point: &Point, eps: f64) -> Measured {
    let p = point.passes.value - eps;
    let opacity = 1.0 - p;
    let x = shape.depth(opacity, p);
    // dx/dp by a small step.
    let step = 1e-4 * p.abs().max(1e-3);
    let slope = (shape.depth(opacity - step, p + step) - x) / step;
    let bare = bare(powers, point);
    Measured {
        value: x / bare,
        error: (slope * point.passes.error / bare).abs() + 4e-16 * (x / bare).abs(),
    }
}

/// Whether nothing is absorbed at any point.
fn is_clear(points: &[Point]) -> bool {
    let mut known = points.iter().filter(|p| p.passes.value.is_finite());
    let clear = |p: &Point| (p.passes.value - 1.0).abs() <= 3.0 * p.passes.error;
    known.clone().count() > 4 && known.all(clear) && points.iter().any(|p| p.weight.value > 0.1)
}

/// The laws that explain at least half of the points, the best first.
///
/// `eps` is what is added to p whatever the segment.
pub(in crate::identify) fn laws(points: &[Point], eps: f64, answers: &Answers) -> Vec<Fitted> {
    let mut all: Vec<Fitted> = Vec::new();
    // Noise leans to no side that is known: a parameter is known to no more than its size.
    let points: Vec<Point> = points
        .iter()
        .map(|p| Point {
            weight: noisy(p.weight, answers.noise),
            passes: noisy(p.passes, answers.noise),
            ..*p
        })
        .collect();
    let points = points.as_slice();
    // In narrow formats nothing is known well.
    let known = Known {
        worst: WORST.max(200.0 * answers.unit.max(answers.grain)).min(0.3),
        best: (4.0 * answers.noise + answers.grain).max(1e-16),
    };
    let bare = passing(points, eps, known).into_iter().map(|p| (p, 1.0));
    let covered = cover(points).into_iter().flat_map(|cover| {
        let bare: Vec<Point> = points.iter().map(|p| uncovered(p, cover)).collect();
        let all = passing(&bare, eps, known).into_iter();
        all.map(move |passing| (passing, cover))
    });
    for ((shape, depth, bracket), cover) in bare.chain(covered) {
        let base = Law {
            depth,
            shape,
            eps,
            cover: Scale(cover),
            ..Law::default()
        };
        for (weight, scale, of_scale) in weighing(&base, points, known) {
            let law = Law {
                weight,
                scale: Scale(scale),
                ..base.clone()
            };
            let share = share(&law, points, answers);
            let is_own = matches!(weight, Weight::Own { .. });
            let own = is_own.then(|| Bracket::of(Parameter::Weight, of_scale));
            all.push(Fitted {
                law,
                factor: bracket,
                scale: if is_own { (1.0, 1.0) } else { of_scale },
                brackets: own.into_iter().collect(),
                share,
                grain: 0.0,
            });
        }
    }
    all.retain(|fitted| fitted.share >= FEWEST);
    // Stable: of equals the simplest, which was tried first.
    all.sort_by(|u, v| {
        let shares = round(v.share).total_cmp(&round(u.share));
        shares.then(words(&u.law).cmp(&words(&v.law)))
    });
    all
}

/// Thick segments whose opacities agree to this part of them are as opaque as any is.
const FLAT: f64 = 1e-7;
/// An opacity of thick segments above this is 1, or 1 less what they let through.
const OPAQUE: f64 = 0.999;

/// What every opacity may have been multiplied by: the largest one, where thick segments have it all alike.
fn cover(points: &[Point]) -> Option<f64> {
    let known = points.iter().filter(|p| p.passes.error < FLAT);
    let mut opacities: Vec<f64> = known.map(|p| 1.0 - p.passes.value).collect();
    opacities.retain(|opacity| opacity.is_finite());
    opacities.sort_by(|u, v| v.total_cmp(u));
    let [first, second, ..] = opacities[..] else {
        return None;
    };
    let is_flat = first - second <= FLAT * first && first > FLAT && first < OPAQUE;
    is_flat.then(|| simplest(first * (1.0 - 1e-12), first * (1.0 + FLAT)))
}

/// What a segment would let through if its opacity were multiplied by nothing.
fn uncovered(point: &Point, cover: f64) -> Point {
    Point {
        passes: Measured {
            value: 1.0 - (1.0 - point.passes.value) / cover,
            error: point.passes.error / cover,
        },
        ..*point
    }
}

fn noisy(m: Measured, noise: f64) -> Measured {
    Measured {
        error: m.error + 4.0 * noise * m.value.abs(),
        ..m
    }
}

/// How much is to be said of a law.
fn words(law: &Law) -> usize {
    let form = match law.weight {
        weight if weight == Weight::default() => 0,
        Weight::Opacity { .. } => 1,
        Weight::Depth { depth, .. } => {
            2 + usize::from(
                !Depth {
                    factor: 1.0,
                    ..depth
                }
                .is_plain(),
            )
        }
        Weight::Own { depth, .. } => 4 + usize::from(!depth.is_plain()),
    };
    let is_plain = Depth {
        factor: 1.0,
        ..law.depth
    }
    .is_plain();
    let shape = usize::from(law.shape != Shape::Exponential);
    let factors = [law.scale, law.cover];
    let factors = factors.iter().filter(|f| (f.0 - 1.0).abs() > 0.0).count();
    form + shape + 2 * usize::from(!is_plain) + factors
}

fn round(share: f64) -> f64 {
    (share * 50.0).round()
}

/// Shapes of p with their depths, those that most points have first.
fn passing(points: &[Point], eps: f64, known: Known) -> Vec<(Shape, Depth, (f64, f64))> {
    if is_clear(points) {
        return vec![(Shape::Clear, Depth::default(), (1.0, 1.0))];
    }
    let mut found: Vec<(usize, Shape, Depth, (f64, f64))> = Vec::new();
    for shape in Shape::ABSORBING {
        for powers in powers() {
            if powers[0] == Power::ZERO {
                continue;
            }
            let of: Vec<Measured> = points
                .iter()
                .map(|p| factor(shape, powers, p, eps))
                .collect();
            let Some(common) = common(&of, known) else {
                continue;
            };
            if common.count < FEWEST_POINTS {
                continue;
            }
            let (low, high) = (common.value - common.error, common.value + common.error);
            let depth = depth_with(powers, simplest(low, high));
            found.push((common.count, shape, depth, (low, high)));
        }
    }
    found.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
    let most = found.first().map_or(0, |(count, ..)| *count);
    found.retain(|(count, ..)| 2 * *count >= most);
    found.truncate(8);
    found.into_iter().map(|(_, s, d, b)| (s, d, b)).collect()
}

/// Weights with their scale and its bracket; that of the own depth's factor where a weight has one.
fn weighing(base: &Law, points: &[Point], known: Known) -> Vec<(Weight, f64, (f64, f64))> {
    let mut forms: Vec<Weight> = Vec::new();
    let of = |halves: i8| Power { halves };
    if base.shape != Shape::Clear {
        for (opacity, passes) in [
            (2, 0),
            (2, 2),
            (2, 1),
            (4, 0),
            (1, 0),
            (0, 0),
            (0, 2),
            (2, -2),
            (3, 0),
        ] {
            forms.push(Weight::Opacity {
                opacity: of(opacity),
                passes: of(passes),
            });
        }
    }
    for powers in powers() {
        for passes in [0, 1, 2] {
            if base.shape == Shape::Clear && passes != 0 {
                continue;
            }
            forms.push(Weight::Depth {
                depth: depth_with(powers, 1.0),
                passes: of(passes),
            });
        }
    }
    let mut found = Vec::new();
    for form in forms {
        let unit = Law {
            weight: form,
            ..base.clone()
        };
        let scales: Vec<Measured> = points
            .iter()
            .map(|p| {
                let shape = unit.of(&p.extinction, &p.length, &p.ray).0;
                Measured {
                    value: p.weight.value / shape,
                    error: (p.weight.error / shape).abs() + 4e-16 * (p.weight.value / shape).abs(),
                }
            })
            .collect();
        let Some(common) = common(&scales, known) else {
            continue;
        };
        if common.count >= FEWEST_POINTS {
            let (low, high) = (common.value - common.error, common.value + common.error);
            found.push((common.count, form, simplest(low, high), (low, high)));
        }
    }
    for shape in [Shape::Exponential, Shape::Linear] {
        for powers in powers() {
            let of: Vec<Measured> = points
                .iter()
                .map(|p| {
                    let w = p.weight;
                    let x = shape.depth(w.value, 1.0 - w.value);
                    let bare = bare(powers, p);
                    Measured {
                        value: x / bare,
                        error: w.error / (1.0 - w.value).max(1e-3) / bare + 4e-16 * x / bare,
                    }
                })
                .collect();
            let Some(common) = common(&of, known) else {
                continue;
            };
            if common.count >= FEWEST_POINTS {
                let (low, high) = (common.value - common.error, common.value + common.error);
                let depth = depth_with(powers, simplest(low, high));
                found.push((common.count, Weight::Own { depth, shape }, 1.0, (low, high)));
            }
        }
    }
    found.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
    let most = found.first().map_or(0, |(count, ..)| *count);
    found.retain(|(count, ..)| 2 * *count >= most);
    found.truncate(8);
    found.into_iter().map(|(_, w, s, b)| (w, s, b)).collect()
}

/// Whether a point has a law.
pub(in crate::identify) fn has(law: &Law, point: &Point, answers: &Answers) -> bool {
    let (weight, passes) = law.of(&point.extinction, &point.length, &point.ray);
    let size = weight.abs().max(law.scale.0.abs());
    // An opacity by subtraction is off by a unit of 1.
    let slack = 16.0 * answers.unit + answers.noise + answers.grain;
    // A ray that ends in this very segment may have cut its weight.
    let ends = point.passes.value.is_nan() && point.weight.value < weight;
    let is_one = |w: f64| (w - 1.0).abs() <= 1e-9 + 64.0 * answers.unit;
    let w = point.weight.value;
    if ends && !is_one(w) && !is_one(w / law.scale.0) {
        return true;
    }
    let near = |m: Measured, want: f64, size: f64| {
        m.value.is_nan() || (m.value - want).abs() <= 3.0 * m.error + slack * size
    };
    near(point.weight, weight, size) && near(point.passes, passes, 1.0)
}

/// The part of the points that have it, of those that say anything.
fn share(law: &Law, points: &[Point], answers: &Answers) -> f64 {
    let says = |p: &&Point| {
        // Where a ray ends its last weight may be cut.
        p.weight.value.is_finite()
            && p.passes.value.is_finite()
            && (p.weight.value.abs() > 3.0 * p.weight.error
                || (p.passes.value - 1.0).abs() > 3.0 * p.passes.error)
    };
    let all: Vec<&Point> = points.iter().filter(says).collect();
    let with = all.iter().filter(|p| has(law, p, answers)).count();
    with as f64 / all.len().max(1) as f64
}

//! Methods that state no rule, beside the answers to all kinds of rays.

use super::kinds::{CORE, MAKES, WALL, What};
use super::ray::ray;
use super::{HoldOut, Terms};
use crate::case::Transfer;
use crate::identify::precision::Precision;
use crate::identify::random::Random;
use crate::identify::ray::Ray;
use crate::identify::session::Session;
use crate::identify::silence::Silence;
use crate::identify::state::is_same;
use crate::identify::weights::Answers;
use crate::kernel::Segments;
use crate::method::{Degree, Layers};

/// Layers thinner than this have their weights by a series.
const THIN: [f64; 2] = [0.02, 0.05];
/// Emissions that are nearer to each other than this part of them have their mean by a series.
const NEAR: f64 = 1e-6;

/// The method that has all those answers, where exactly one has.
pub(in crate::identify) fn by_method(
    session: &mut Session<'_>,
    terms: &Terms<'_>,
) -> Result<Option<(Layers, HoldOut)>, Silence> {
    let states_none = |layers: &Layers| matches!(layers, Layers::Logarithmic | Layers::Bezier(_));
    let mut left: Vec<Layers> = Layers::ALL.into_iter().filter(states_none).collect();
    let mut random = Random::new(97);
    let mut out = HoldOut::default();
    let mut all = Vec::new();
    let mut first: Option<(Ray, Vec<f64>)> = None;
    for make in MAKES {
        if make.what == What::Opaque(WALL)
            // Where signs differ there is no logarithmic mean.
            || make.what == What::Negative
            || (session.is_short() && !CORE.contains(&make.name))
        {
            continue;
        }
        let partial = if session.divides { 0 } else { make.partial };
        for (is_partial, rays) in [
            (false, make.whole.max(usize::from(partial == 0))),
            (true, partial),
        ] {
            let mut kind = make.kind(is_partial);
            for turn in 0..rays {
                let ray = ray(session, &mut random, make, (is_partial, turn), terms);
                kind.rays += 1;
                let got = match session.ask_any(&ray) {
                    Ok(got) => got,
                    Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
                    Err(_) => {
                        kind.unanswered += 1;
                        continue;
                    }
                };
                let mut digits = 17.0;
                left.retain(|layers| {
                    let of = digits_of(*layers, terms.answers, &ray.segments, &got);
                    digits = of.unwrap_or(digits);
                    of.is_some()
                });
                if left.is_empty() {
                    return Ok(None);
                }
                kind.agree += 1;
                kind.digits = kind.digits.min(digits);
                all.extend_from_slice(&got);
                first.get_or_insert((ray, got));
            }
            out.kinds.extend((kind.rays > 0).then_some(kind));
        }
    }
    out.precision = Some(Precision::of(&all));
    out.drifts = terms.answers.noise == 0.0
        && first.is_some_and(|(ray, before)| {
            let again = session.ask_any(&ray);
            again.is_ok_and(|again| !is_same(&before, &again))
        });
    Ok(match left[..] {
        [layers] if out.is_whole() => Some((layers, out)),
        _ => None,
    })
}

/// The digits in which the answers of all channels are a method's; `None` where one is not, but for rounding.
fn digits_of(layers: Layers, answers: &Answers, ray: &Segments, got: &[f64]) -> Option<f64> {
    let lengths: Vec<f64> = ray.lengths().collect();
    let mut digits: f64 = 17.0;
    for (emission, got) in ray.edges.emission.iter().zip(got) {
        let nodes = ray.edges.extinction.iter().zip(emission);
        let places: Vec<Transfer<f64>> = nodes
            .map(|(extinction, emission)| Transfer {
                extinction: *extinction,
                emission: *emission,
            })
            .collect();
        let want = layers.between(&places, &lengths)?;
        let bright = emission.iter().map(|c| c.abs()).fold(0.0, f64::max);
        let n = lengths.len() as f64;
        let rounded = (want.abs() + bright) * (16.0 + 4.0 * n);
        let slack = answers.unit * (rounded + 8.0 * bright * lost(layers, &places, &lengths));
        let off = (got - want).abs();
        // What is no number is nobody's.
        if off.is_nan() || off > slack + answers.noise * (want.abs() + bright) {
            return None;
        }
        if off > 0.0 {
            let part = off / want.abs().max(got.abs());
            digits = digits.min((-part.log10()).clamp(0.0, 17.0));
        }
    }
    Some(digits)
}

/// By how many units of the emission weights are off that are differences.
fn lost(layers: Layers, places: &[Transfer<f64>], lengths: &[f64]) -> f64 {
    let layer = |(ends, length): (&[Transfer<f64>], &f64)| {
        let [front, back] = ends else { return 0.0 };
        let depth = 0.5 * (front.extinction + back.extinction) * length;
        match layers {
            Layers::Logarithmic => {
                let largest = front.emission.abs().max(back.emission.abs());
                let apart = (front.emission - back.emission).abs() / largest.max(f64::MIN_POSITIVE);
                depth.min(1.0) / apart.max(NEAR)
            }
            Layers::Bezier(bezier) => match bezier.degree {
                Degree::Quadratic => depth.max(THIN[0]).powi(-2),
                Degree::Cubic => depth.max(THIN[1]).powi(-3),
            },
            _ => 0.0,
        }
    };
    places.windows(2).zip(lengths).map(layer).sum()
}

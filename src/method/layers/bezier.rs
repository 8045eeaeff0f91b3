//! Layers along which τ and C are Bézier curves: τ of the length, C of the optical depth that follows.

use super::composite;
use crate::case::{Nodes, Number};
use crate::real::special::bernstein_in_depth;
use crate::real::{Format, Real, row};

/// A curve through the values at both ends of every layer, whose derivatives there come from both layers beside an end.
///
/// With g = h f′ for a step h and the values f and b at the ends of a layer the curve has the points f, c, b with
/// c = (f + b)/2 + (gf − gb)/4, or f, f + gf/3, b − gb/3, b. Its mean is that of its points: times d, of τ, it is the
/// layer's optical depth x; and the light of the layer is Σ wᵢ(x) Cᵢ with wᵢ(x) = x ∫₀¹ Bᵢ(u) e^(−xu) du for the points
/// Cᵢ of C as a function of optical depth. Steps may differ. At the ends of the ray the derivative is the slope of the
/// one layer, and a layer without depth says nothing of its neighbours.
///
/// Source: Auer (2003); de la Cruz Rodríguez and Piskunov (2013), The Astrophysical Journal 764:33, for both curves;
/// Fritsch and Butland (1984) for the monotone derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Bezier {
    /// How many points it has.
    pub degree: Degree,
    /// What keeps it from overshooting.
    pub limiter: Limiter,
}

/// The degree of a Bézier curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Degree {
    /// One point between the ends, the mean of those that both ends' tangents give.
    Quadratic,
    /// Two points between the ends, one on each tangent: Hermite's cubic.
    Cubic,
}

/// What keeps a Bézier curve from overshooting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Limiter {
    /// Nothing: derivatives are those of the parabola through three places.
    None,
    /// The same, and points between the ends are cut off at the ends' values.
    Clip,
    /// Derivatives are weighted harmonic means of both slopes, and 0 where those differ in sign.
    Monotone,
}

/// A layer of a function: its step and how much the function rises over it.
struct Piece<R> {
    step: R,
    rise: R,
}

impl Bezier {
    /// The radiance on n layers of length `step`.
    pub(super) fn radiance<N: Nodes>(self, nodes: &N, n: u64, step: &Number<N>) -> Number<N> {
        let (mut extinctions, mut emissions) = (Vec::new(), Vec::new());
        for place in nodes.march(n) {
            extinctions.push(place.extinction);
            emissions.push(place.emission);
        }
        let steps = row(extinctions.iter().skip(1).map(|_| step.clone()));
        self.between(nodes.format(), &steps, &extinctions, &emissions)
    }

    /// The radiance of values at places that are steps apart.
    pub(super) fn between<F: Format>(
        self,
        format: F,
        steps: &[F::Real],
        extinctions: &[F::Real],
        emissions: &[F::Real],
    ) -> F::Real {
        let of_extinction = self.curves(steps, extinctions);
        let depths = row(of_extinction.iter().zip(steps).map(|(points, step)| {
            let mut sum = format.int(0);
            for point in points {
                sum += point;
            }
            sum * step / &format.int(self.count())
        }));
        let of_emission = self.curves(&depths, emissions);
        let layers = of_emission.iter().zip(&depths);
        composite(format, layers, |(points, depth)| {
            (light(points, depth), (-depth.clone()).exp())
        })
    }

    /// How many points a curve has.
    fn count(self) -> i64 {
        match self.degree {
            Degree::Quadratic => 3,
            Degree::Cubic => 4,
        }
    }

    /// The points of every layer's curve through values that are steps apart.
    fn curves<R: Real>(self, steps: &[R], values: &[R]) -> Vec<Vec<R>> {
        let ends = || values.iter().zip(values.iter().skip(1));
        let pieces = row(steps.iter().zip(ends()).map(|(step, (front, back))| Piece {
            step: step.clone(),
            rise: back.clone() - front,
        }));
        row(ends().enumerate().map(|(k, (front, back))| {
            let own = &pieces[k];
            let before = k.checked_sub(1).and_then(|k| pieces.get(k));
            let rises = [before, pieces.get(k + 1)].map(|beside| self.rise(own, beside));
            self.points(front, back, &rises)
        }))
    }

    /// h f′ at the end that a layer of step h shares with the one beside it.
    fn rise<R: Real>(self, own: &Piece<R>, beside: Option<&Piece<R>>) -> R {
        let format = own.step.format();
        let zero = format.int(0);
        let Some(beside) = beside.filter(|beside| own.step != zero && beside.step != zero) else {
            return own.rise.clone();
        };
        // In units of the own step, so that no slope is beyond the range of the format in a thin layer.
        let ratio = beside.step.clone() / &own.step;
        let other = beside.rise.clone() / &ratio;
        let both = ratio.clone() + &format.int(1);
        if self.limiter != Limiter::Monotone {
            return (other + &(ratio * &own.rise)) / &both;
        }
        let same_sign = own.rise > zero && other > zero || own.rise < zero && other < zero;
        if !same_sign {
            return zero;
        }
        let (two, three) = (format.int(2), format.int(3));
        let of_own = ratio.clone() * &two + &format.int(1);
        let of_other = (ratio + &two) * &own.rise / &other;
        own.rise.clone() * &(both * &three) / &(of_own + &of_other)
    }

    /// The points of the curve between two values, by h f′ at both.
    fn points<R: Real>(self, front: &R, back: &R, rises: &[R; 2]) -> Vec<R> {
        let format = front.format();
        let part = |of: &R, whole: u64| of.clone() * &format.fraction(1, whole);
        let [near, far] = rises;
        let mut points = match self.degree {
            Degree::Quadratic => {
                let middle = part(&(front.clone() + back), 2);
                vec![middle + &part(&(near.clone() - far), 4)]
            }
            Degree::Cubic => vec![front.clone() + &part(near, 3), back.clone() - &part(far, 3)],
        };
        if self.limiter == Limiter::Clip {
            let (low, high) = if front < back {
                (front, back)
            } else {
                (back, front)
            };
            for point in &mut points {
                if *point < *low {
                    point.set(low);
                } else if *point > *high {
                    point.set(high);
                }
            }
        }
        points.insert(0, front.clone());
        points.push(back.clone());
        points
    }
}

/// What leaves a layer of that depth in front, of a source along the curve.
fn light<R: Real>(points: &[R], depth: &R) -> R {
    let mut light = depth.format().int(0);
    for (weight, point) in bernstein_in_depth(points.len() - 1, depth)
        .into_iter()
        .zip(points)
    {
        light += &(weight * point);
    }
    light
}

//! Layer rules: formal solutions of the transfer equation and of emission tomography, layer by layer.

mod bezier;
mod limits;

pub use bezier::{Bezier, Degree, Limiter};

use super::MethodError;
use super::error::require_multiple;
use crate::case::{Nodes, Number, Transfer};
use crate::real::special::{linear_in_depth, logarithmic_mean};
use crate::real::{Format, Real, row};
use rug::Rational;
use std::fmt;

/// I ≈ Σᵢ Tᵢ Eᵢ with Tᵢ = ∏_{k<i} e^(−xₖ) over layers of length d, where x is a layer's optical depth and E what
/// leaves it. f, m and b mark values in front, in the middle and at the back; the source function of the transfer
/// equation is C here, its extinction τ.
///
/// | rule | x | E |
/// |---|---|---|
/// | linear | d (τf + τb)/2 | (1 − e) Cf + (e − e^(−x)) Cb, e = (1 − e^(−x))/x: C linear in optical depth |
/// | mean | d (τf + τb)/2 | (1 − e^(−x)) (Cf + Cb)/2 |
/// | logarithmic | d (τf + τb)/2 | (1 − e^(−x)) (Cb − Cf)/ln(Cb/Cf) |
/// | half cells | d (τf + τb)/2 | (1 − e^(−τf d/2)) Cf + e^(−τf d/2) (1 − e^(−τb d/2)) Cb: cells around the ends |
/// | middle | d (τf + τb)/2 | d τm Cm e^(−x/2): emission of the middle, attenuated to it |
/// | half own | d τm | d τm Cm e^(−x/2): a voxel, attenuated by half of itself |
/// | whole own | d τm | d τm Cm e^(−x): a voxel, attenuated by all of itself |
/// | Bézier | curve of τ | curve of C in optical depth: [`Bezier`] |
///
/// All have order 2 but the whole own voxel, which has 1, and Bézier curves, which have 3. The logarithmic mean has order
/// 2 where C has no zero, is 0 where one end's C is, and no number where signs differ.
///
/// Source: Olson and Kunasz (1987) for the linear rule; half and whole own voxels are those of projectors in emission
/// tomography, cells around depth points those of discrete ordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layers {
    /// C linear in optical depth.
    Linear,
    /// The mean of both ends' C.
    Mean,
    /// The logarithmic mean of both ends' C.
    Logarithmic,
    /// Two halves, with the values of the ends that they lie at.
    HalfCells,
    /// The emission of the middle, attenuated by half of the layer.
    Middle,
    /// A voxel, attenuated by half of itself.
    HalfOwn,
    /// A voxel, attenuated by all of itself.
    WholeOwn,
    /// Bézier curves of τ, and of C in optical depth.
    Bezier(Bezier),
}

const fn bezier(degree: Degree, limiter: Limiter) -> Layers {
    Layers::Bezier(Bezier { degree, limiter })
}

/// All rules, with their names.
const NAMES: [(Layers, &str); 13] = [
    (Layers::Linear, "linear"),
    (Layers::Mean, "mean"),
    (Layers::Logarithmic, "logarithmic"),
    (Layers::HalfCells, "half-cells"),
    (Layers::Middle, "middle"),
    (Layers::HalfOwn, "half-own"),
    (Layers::WholeOwn, "whole-own"),
    (bezier(Degree::Quadratic, Limiter::None), "bezier-quadratic"),
    (
        bezier(Degree::Quadratic, Limiter::Clip),
        "bezier-quadratic-clip",
    ),
    (
        bezier(Degree::Quadratic, Limiter::Monotone),
        "bezier-quadratic-monotone",
    ),
    (bezier(Degree::Cubic, Limiter::None), "bezier-cubic"),
    (bezier(Degree::Cubic, Limiter::Clip), "bezier-cubic-clip"),
    (
        bezier(Degree::Cubic, Limiter::Monotone),
        "bezier-cubic-monotone",
    ),
];

impl Layers {
    /// All.
    pub const ALL: [Layers; NAMES.len()] = {
        let mut all = [Layers::Linear; NAMES.len()];
        let mut index = 0;
        while index < NAMES.len() {
            all[index] = NAMES[index].0;
            index += 1;
        }
        all
    };

    /// The radiance on n layers.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n is 0.
    pub fn radiance<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Number<N>, MethodError> {
        require_multiple(self, n, 1)?;
        let step = nodes.format().ratio(&(Rational::from(nodes.length()) / n));
        let middles = || nodes.march_inside(n, Rational::from((1, 2)));
        Ok(match self {
            Layers::Linear => by_ends(nodes, n, &step, |front, back, depth| {
                let [near, far] = linear_in_depth(depth);
                near * &front.emission + &(far * &back.emission)
            }),
            Layers::Mean => by_ends(nodes, n, &step, |front, back, depth| {
                let half = depth.format().fraction(1, 2);
                let mean = (front.emission.clone() + &back.emission) * &half;
                -(-depth.clone()).exp_m1() * &mean
            }),
            Layers::Logarithmic => by_ends(nodes, n, &step, logarithmic),
            Layers::HalfCells => by_ends(nodes, n, &step, |front, back, depth| {
                let half = depth.format().fraction(1, 2) * &step;
                let through = |end: &Transfer<Number<N>>| -(end.extinction.clone() * &half);
                let (near, far) = (through(front), through(back));
                let behind = -far.exp_m1() * &back.emission * &near.clone().exp();
                -near.exp_m1() * &front.emission + &behind
            }),
            Layers::Middle => {
                let layers = ends(nodes, n).zip(middles());
                composite(nodes.format(), layers, |((front, back), middle)| {
                    of_middle(trapezoid(&front, &back, &step), &middle, &step)
                })
            }
            Layers::HalfOwn => composite(nodes.format(), middles(), |voxel| {
                of_middle(voxel.extinction.clone() * &step, &voxel, &step)
            }),
            Layers::WholeOwn => composite(nodes.format(), middles(), |voxel| {
                let depth = voxel.extinction * &step;
                let passes = (-depth.clone()).exp();
                (depth * &voxel.emission * &passes, passes)
            }),
            Layers::Bezier(bezier) => bezier.radiance(nodes, n, &step),
        })
    }
}

impl Layers {
    /// What it makes of layers between those places, each of its own length, where it is the logarithmic mean or a Bézier
    /// curve: all others are sums of emissions.
    pub(crate) fn between<R: Real>(self, places: &[Transfer<R>], lengths: &[R]) -> Option<R> {
        let format = places.first()?.extinction.format();
        match self {
            Layers::Logarithmic => {
                let ends = places.iter().zip(places.iter().skip(1)).zip(lengths);
                Some(composite(format, ends, |((front, back), length)| {
                    let depth = trapezoid(front, back, length);
                    (logarithmic(front, back, &depth), (-depth).exp())
                }))
            }
            Layers::Bezier(bezier) => {
                let extinctions = row(places.iter().map(|place| place.extinction.clone()));
                let emissions = row(places.iter().map(|place| place.emission.clone()));
                Some(bezier.between(format, lengths, &extinctions, &emissions))
            }
            Layers::Linear
            | Layers::Mean
            | Layers::HalfCells
            | Layers::Middle
            | Layers::HalfOwn
            | Layers::WholeOwn => None,
        }
    }
}

/// (1 − e^(−x)) times the logarithmic mean of both ends' C.
fn logarithmic<R: Real>(front: &Transfer<R>, back: &Transfer<R>, depth: &R) -> R {
    let mean = logarithmic_mean(&front.emission, &back.emission);
    -(-depth.clone()).exp_m1() * &mean
}

/// The radiance of a rule that looks at the ends of layers alone, `light` giving E of both and x.
fn by_ends<N: Nodes>(
    nodes: &N,
    n: u64,
    step: &Number<N>,
    light: impl Fn(&Transfer<Number<N>>, &Transfer<Number<N>>, &Number<N>) -> Number<N>,
) -> Number<N> {
    composite(nodes.format(), ends(nodes, n), |(front, back)| {
        let depth = trapezoid(&front, &back, step);
        (light(&front, &back, &depth), (-depth).exp())
    })
}

/// The layers' ends, from the eye on.
fn ends<N: Nodes>(
    nodes: &N,
    n: u64,
) -> impl Iterator<Item = (Transfer<Number<N>>, Transfer<Number<N>>)> {
    let mut places = nodes.march(n);
    let mut front = places.next();
    places.filter_map(move |back| Some((front.replace(back.clone())?, back)))
}

/// d (τf + τb)/2.
fn trapezoid<R: Real>(front: &Transfer<R>, back: &Transfer<R>, step: &R) -> R {
    let half = step.format().fraction(1, 2);
    (front.extinction.clone() + &back.extinction) * &half * step
}

/// (E, e^(−x)) of the middle's emission, attenuated by half of the depth x.
fn of_middle<R: Real>(depth: R, middle: &Transfer<R>, step: &R) -> (R, R) {
    let half = depth.format().fraction(1, 2);
    let to_middle = (-(depth.clone() * &half)).exp();
    let light = middle.extinction.clone() * step * &middle.emission;
    (light * &to_middle, (-depth).exp())
}

/// Σᵢ Tᵢ Eᵢ from front to back, `layer` giving E and e^(−x).
fn composite<F: Format, L>(
    format: F,
    layers: impl Iterator<Item = L>,
    layer: impl Fn(L) -> (F::Real, F::Real),
) -> F::Real {
    let (mut radiance, mut transmittance) = (format.int(0), format.int(1));
    for (light, passes) in layers.map(layer) {
        radiance += &(light * &transmittance);
        transmittance *= &passes;
    }
    radiance
}

/// The rule's own name: `half-own`.
impl fmt::Display for Layers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let own = NAMES.iter().find(|(rule, _)| rule == self);
        f.pad(own.map_or("", |(_, name)| name))
    }
}

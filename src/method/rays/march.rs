//! One pass over some rays.

use super::{RayMedium, Way};
use crate::case::{Places, Transfer};
use crate::method::{Accumulation, OpacityFormula, Position};
use crate::real::lanes::{LaneFloat, LaneFormat, Lanes, WithLanes};
use crate::real::{Format, row};
use rug::Rational;

/// Where rays are looked at, the same for all.
pub(super) struct Ray<T> {
    way: Way,
    n: u64,
    /// d.
    step: T,
    /// Where C and τ are looked at: boundaries under nested rules.
    places: Places,
    /// Where the inner rule looks inside segments.
    middles: Places,
}

impl<T: LaneFloat> Ray<T> {
    pub(super) fn new(way: Way, length: &Rational, n: u64) -> Self {
        let half = Rational::from((1, 2));
        let offset = match way {
            Way::Nested { .. }
            | Way::Composited {
                position: Position::Front,
                ..
            } => Rational::new(),
            Way::Composited {
                position: Position::Middle,
                ..
            } => half.clone(),
            Way::Composited {
                position: Position::Back,
                ..
            } => Rational::from(1),
        };
        let step = LaneFormat::<T>::new().ratio(&(Rational::from(length) / n));
        Ray {
            way,
            n,
            step: step.0,
            places: Places::new(length, n, &offset),
            middles: Places::new(length, n, &half),
        }
    }
}

/// Places that are computed at once: no ray is kept.
const BLOCK: u64 = 256;

/// The places from j on: a block, or what is left of `count`.
#[inline(never)]
fn block<T: LaneFloat>(places: &Places, j: u64, count: u64) -> Vec<T> {
    let format = LaneFormat::<T>::new();
    row((j..count.min(j + BLOCK)).map(|j| places.at(format, j).0))
}

/// Places whose exponentials are taken behind their media: shorter chains of operations, of which a processor does several at
/// once.
const GROUP: usize = 8;

/// Rays to march along, from the `first` on: a multiple of the width.
pub(super) struct March<'m, T, M> {
    pub(super) ray: &'m Ray<T>,
    pub(super) medium: &'m M,
    pub(super) first: usize,
    pub(super) radiances: &'m mut [T],
}

impl<T: LaneFloat, M: RayMedium<T>> WithLanes<T> for March<'_, T, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        let medium = self.medium;
        let rays = self.radiances.chunks_exact_mut(L::WIDTH);
        for (lanes, radiances) in rays.enumerate() {
            let first = self.first + lanes * L::WIDTH;
            let radiance = match self.ray.way {
                Way::Nested { middle } => nested(self.ray, middle, medium, first, zero),
                Way::Composited { opacity, depth, .. } => {
                    composited(self.ray, opacity, depth, medium, first, zero)
                }
            };
            radiance.store(radiances);
        }
    }
}

/// The trapezoid rule over C τ e^(−t), t by the trapezoid or the midpoint rule.
#[inline(always)]
fn nested<L: Lanes, M: RayMedium<L::Element>>(
    ray: &Ray<L::Element>,
    middle: bool,
    medium: &M,
    first: usize,
    zero: L,
) -> L {
    let half = zero.all(L::Element::HALF);
    let step = zero.all(ray.step);
    let mut depth = zero;
    // τ at the front of the next segment, and in its middle.
    let (mut front, mut behind) = (zero, zero);
    let mut sum = zero;
    let mut j = 0;
    while j <= ray.n {
        let places = block(&ray.places, j, ray.n + 1);
        let middles = if middle {
            block(&ray.middles, j, ray.n)
        } else {
            Vec::new()
        };
        for (group, places) in places.chunks(GROUP).enumerate() {
            let (mut sources, mut depths) = ([zero; GROUP], [zero; GROUP]);
            for (k, &lambda) in places.iter().enumerate() {
                let Transfer {
                    emission,
                    extinction,
                } = medium.transfer(first, zero.all(lambda));
                if j + k as u64 > 0 {
                    let mean = if middle {
                        behind
                    } else {
                        front * half + extinction * half
                    };
                    depth = depth + mean * step;
                }
                if let Some(&lambda) = middles.get(group * GROUP + k) {
                    behind = medium.transfer(first, zero.all(lambda)).extinction;
                }
                front = extinction;
                sources[k] = emission * extinction;
                depths[k] = depth;
            }
            for (&source, &depth) in sources.iter().zip(&depths).take(places.len()) {
                let term = source * (-depth).exp();
                let is_end = j == 0 || j == ray.n;
                sum = sum + if is_end { term * half } else { term };
                j += 1;
            }
        }
    }
    sum * step
}

/// Σ C α T from front to back.
#[inline(always)]
fn composited<L: Lanes, M: RayMedium<L::Element>>(
    ray: &Ray<L::Element>,
    formula: OpacityFormula,
    accumulation: Accumulation,
    medium: &M,
    first: usize,
    zero: L,
) -> L {
    let step = zero.all(ray.step);
    let one = zero.all(L::Element::ONE);
    let (mut radiance, mut transmittance, mut depth) = (zero, one, zero);
    let mut j = 0;
    while j < ray.n {
        for &lambda in &block(&ray.places, j, ray.n) {
            let Transfer {
                emission,
                extinction,
            } = medium.transfer(first, zero.all(lambda));
            let segment = extinction * step;
            let opacity = match formula {
                OpacityFormula::Subtraction => one - (-segment).exp(),
                OpacityFormula::Linear => segment,
                // The relative opacity is a series where segments are thin, and no way of lanes.
                OpacityFormula::Expm1 | OpacityFormula::Relative => -(-segment).exp_m1(),
            };
            radiance = radiance + emission * opacity * transmittance;
            transmittance = match accumulation {
                Accumulation::Transmittances => transmittance * (one - opacity),
                Accumulation::Remainder => transmittance - opacity * transmittance,
                Accumulation::Depths => {
                    depth = depth + segment;
                    (-depth).exp()
                }
            };
        }
        j += BLOCK;
    }
    radiance
}

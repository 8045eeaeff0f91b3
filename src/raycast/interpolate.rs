//! The field between samples.

mod cubic;
mod linear;
mod nearest;

use super::bundle::{Bundle, Rays};
use super::number::{Number, Sample};
use crate::real::lanes::{LaneFloat, Lanes, MOST, WithLanes};
use std::fmt;

/// How the field between samples is made of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// The value of the nearest sample; half way between two that with the larger index. Order 1 in the distance h of samples.
    Nearest,
    /// Linear along each axis (trilinear), of the eight samples of a cell. Order 2.
    Linear,
    /// The cubic through four samples along each axis (tricubic), of sixty-four; next to a face through the four that are
    /// nearest to it, so that its order of 4 holds up to the faces. Continuous, with kinks where cells meet.
    ///
    /// It is Lagrange's: the cubic convolution that renderers mostly have (Catmull–Rom; Keys 1981, "Cubic convolution
    /// interpolation for digital image processing", IEEE Trans. ASSP 29) has smooth seams and order 3, and no kernel over four
    /// samples that is continuous and interpolates has more than Lagrange's 4 (Schafer and Rabiner 1973, "A digital signal processing
    /// approach to interpolation", Proc. IEEE 61; Meijering 2002, "A chronology of interpolation", Proc. IEEE 90).
    Cubic,
}

impl Interpolation {
    /// The order p of a smooth field's error, O(hᵖ).
    #[must_use]
    pub fn order(self) -> u32 {
        match self {
            Interpolation::Nearest => 1,
            Interpolation::Linear => 2,
            Interpolation::Cubic => 4,
        }
    }

    /// How many samples there have to be along each axis.
    pub(super) fn least_samples(self) -> usize {
        match self {
            // A volume of one sample has no volume.
            Interpolation::Nearest | Interpolation::Linear => 2,
            Interpolation::Cubic => 4,
        }
    }
}

impl fmt::Display for Interpolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Interpolation::Nearest => "nearest",
            Interpolation::Linear => "linear",
            Interpolation::Cubic => "cubic",
        })
    }
}

/// Samples to interpolate between.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field<'v, S> {
    pub(super) samples: &'v [S],
    pub(super) dimensions: [usize; 3],
    pub(super) interpolation: Interpolation,
}

impl<S: Sample> Field<'_, S> {
    #[inline(always)]
    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        let [width, height, _] = self.dimensions;
        i + width * (j + height * k)
    }

    /// The value there, which is not a number where there is none.
    #[inline(always)]
    fn sample<T: Number>(&self, index: usize) -> T {
        match self.samples.get(index) {
            Some(&sample) => T::rounded(sample),
            None => T::nan(),
        }
    }

    /// Last places of something along each axis: `back` samples before the last.
    #[inline(always)]
    fn last<L: Lanes<Element: Number>>(&self, zero: L, back: usize) -> [L; 3] {
        let [x, y, z] = self.dimensions;
        let place = |count: usize| L::Element::rounded(count.saturating_sub(1 + back) as f64);
        [zero.all(place(x)), zero.all(place(y)), zero.all(place(z))]
    }
}

/// Interpolates along rays, into rows of a value a lane.
pub(super) struct Along<'a, T, S> {
    pub(super) field: Field<'a, S>,
    pub(super) rays: &'a Bundle<T>,
    /// The first row's segment.
    pub(super) first: usize,
    /// Where segments have their samples.
    pub(super) offset: f64,
    pub(super) values: &'a mut [T],
}

impl<T: Number, S: Sample> WithLanes<T> for Along<'_, T, S> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        let march = March {
            rays: self.rays.in_lanes(zero),
            last: self.field.last(zero, 0),
            offset: zero.all(T::rounded(self.offset)),
            k: zero.all(T::rounded(self.first as f64)),
        };
        match self.field.interpolation {
            Interpolation::Nearest => nearest::along(&self.field, march, self.values),
            Interpolation::Linear => linear::along(&self.field, march, self.values),
            Interpolation::Cubic => cubic::along(&self.field, march, self.values),
        }
    }
}

/// Rays on their way.
#[derive(Clone, Copy)]
struct March<L> {
    rays: Rays<L>,
    last: [L; 3],
    offset: L,
    k: L,
}

impl<L: Lanes> March<L> {
    /// The next place inside the box.
    #[inline(always)]
    fn step(&mut self) -> [L; 3] {
        let t = self.rays.sample(self.k, self.offset);
        self.k = self.k + t.all(L::Element::ONE);
        let [x, y, z] = self.rays.start;
        let [u, v, w] = self.rays.step;
        [
            inside(x + t * u, self.last[0]),
            inside(y + t * v, self.last[1]),
            inside(z + t * w, self.last[2]),
        ]
    }
}

/// x from 0 to the last sample's place, where rounding has led out of the box.
#[inline(always)]
fn inside<L: Lanes>(x: L, last: L) -> L {
    x.most(x.all(L::Element::ZERO)).least(last)
}

/// The integer nearest to x, as it is and with the index in its bits.
#[inline(always)]
fn nearest_integer<T: Number, L: Lanes<Element = T>>(x: L) -> (L, L) {
    let integer = x.all(T::INTEGER);
    let shifted = x + integer;
    (shifted - integer, shifted)
}

/// a + f (b − a): the value a where both are the same.
#[inline(always)]
fn between<L: Lanes>(f: L, a: L, b: L) -> L {
    a + f * (b - a)
}

/// The indices of each lane.
#[inline(always)]
fn indices<T: Number>(places: &[[T; MOST]; 3], lane: usize) -> [usize; 3] {
    let [x, y, z] = places;
    [x[lane].index(), y[lane].index(), z[lane].index()]
}

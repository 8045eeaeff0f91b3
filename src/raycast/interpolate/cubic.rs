//! Lagrange's cubic along each axis.

use super::super::number::{Number, Sample};
use super::{Field, March, indices, nearest_integer};
use crate::real::lanes::{LaneFloat, Lanes, MOST};

/// Samples of a cubic.
const FOUR: usize = 4;

#[inline(always)]
pub(super) fn along<L: Lanes<Element: Number>, S: Sample>(
    field: &Field<'_, S>,
    mut march: March<L>,
    values: &mut [L::Element],
) {
    let last = field.last(march.k, FOUR - 1);
    let mut samples = [[L::Element::ZERO; MOST]; FOUR * FOUR * FOUR];
    let mut places = [[L::Element::ZERO; MOST]; 3];
    for row in values.chunks_exact_mut(L::WIDTH) {
        let [x, y, z] = march.step();
        let [i, j, k] = &mut places;
        let in_x = weights(x, last[0], i);
        let in_y = weights(y, last[1], j);
        let in_z = weights(z, last[2], k);
        for lane in 0..L::WIDTH {
            let [i, j, k] = indices(&places, lane);
            for (row, samples) in samples.chunks_exact_mut(FOUR).enumerate() {
                let first = field.index([i, j + row % FOUR, k + row / FOUR]);
                for (place, lanes) in samples.iter_mut().enumerate() {
                    lanes[lane] = field.sample(first + place);
                }
            }
        }
        interpolate(&samples, [in_x, in_y, in_z]).store(row);
    }
}

/// What each of four samples weighs at x, the first of which goes to `place`: x lies between the second and the third where
/// there are as many.
#[inline(always)]
fn weights<L: Lanes<Element: Number>>(x: L, last: L, place: &mut [L::Element]) -> [L; FOUR] {
    let one = x.all(L::Element::ONE);
    let half = x.all(L::Element::HALF);
    let zero = x.all(L::Element::ZERO);
    let two = one + one;
    let (first, shifted) = nearest_integer((x - one - half).most(zero).least(last));
    shifted.store(place);
    let a = x - first;
    let (b, c, d) = (a - one, a - two, a - two - one);
    let sixth = one / (two + two + two);
    [
        -(b * c * d * sixth),
        a * c * d * half,
        -(a * b * d * half),
        a * b * c * sixth,
    ]
}

#[inline(always)]
fn interpolate<L: Lanes>(
    samples: &[[L::Element; MOST]; FOUR * FOUR * FOUR],
    [in_x, in_y, in_z]: [[L; FOUR]; 3],
) -> L {
    let zero = in_x[0].all(L::Element::ZERO);
    let mut value = zero;
    for (plane, z) in samples.chunks_exact(FOUR * FOUR).zip(in_z) {
        let mut of_plane = zero;
        for (row, y) in plane.chunks_exact(FOUR).zip(in_y) {
            let mut of_row = zero;
            for (lanes, x) in row.iter().zip(in_x) {
                of_row = of_row + x * zero.load(lanes);
            }
            of_plane = of_plane + y * of_row;
        }
        value = value + z * of_plane;
    }
    value
}

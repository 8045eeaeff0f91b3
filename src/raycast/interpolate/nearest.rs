//! The nearest sample.

use super::super::number::{Number, Sample};
use super::{Field, March, indices, nearest_integer};
use crate::real::lanes::{LaneFloat, Lanes, MOST};

#[inline(always)]
pub(super) fn along<L: Lanes<Element: Number>, S: Sample>(
    field: &Field<'_, S>,
    mut march: March<L>,
    values: &mut [L::Element],
) {
    let mut places = [[L::Element::ZERO; MOST]; 3];
    for row in values.chunks_exact_mut(L::WIDTH) {
        let [x, y, z] = march.step();
        upper(x).store(&mut places[0]);
        upper(y).store(&mut places[1]);
        upper(z).store(&mut places[2]);
        for (lane, value) in row.iter_mut().enumerate() {
            *value = field.sample(field.index(indices(&places, lane)));
        }
    }
}

/// The integer nearest to x, with the index in its bits: the larger one of two that are as near.
#[inline(always)]
fn upper<L: Lanes<Element: Number>>(x: L) -> L {
    let (nearest, shifted) = nearest_integer(x);
    // It is the even one of two, which is the smaller one where it lies ½ below x.
    let is_nearer = (x - x.all(L::Element::HALF)).below(nearest);
    L::select(is_nearer, shifted, shifted + x.all(L::Element::ONE))
}

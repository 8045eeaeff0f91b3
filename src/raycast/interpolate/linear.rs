//! Linear along each axis.

use super::super::bundle::alone;
use super::super::number::{Number, Sample};
use super::{Field, March, between, nearest_integer};
use crate::real::lanes::{LaneFloat, Lanes, MOST};

/// Places whose samples are fetched before any is interpolated: what lanes have written one by one is on its way for a while
/// before it can be read side by side.
const GROUP: usize = 8;

/// A cell's four edges along x, y faster than z, each with the samples at both of its ends, and where in the cell a place is;
/// lane by lane.
#[derive(Clone, Copy)]
struct Cells<T> {
    edges: [[[T; 2]; MOST]; 4],
    parts: [[T; MOST]; 3],
}

impl<T: LaneFloat> Cells<T> {
    const EMPTY: Self = Cells {
        edges: [[[T::ZERO; 2]; MOST]; 4],
        parts: [[T::ZERO; MOST]; 3],
    };
}

#[inline(always)]
pub(super) fn along<L: Lanes<Element: Number>, S: Sample>(
    field: &Field<'_, S>,
    mut march: March<L>,
    values: &mut [L::Element],
) {
    let Some(edges) = Edges::of(field) else {
        return;
    };
    let last_cell = field.last(march.k, 1);
    if L::WIDTH == 1 {
        for value in values {
            *value = edges.of_one(march.step(), last_cell);
        }
        return;
    }
    let mut group = [Cells::EMPTY; GROUP];
    for rows in values.chunks_mut(GROUP * L::WIDTH) {
        for (cells, _) in group.iter_mut().zip(rows.chunks_exact(L::WIDTH)) {
            edges.fetch(march.step(), last_cell, cells);
        }
        for (cells, row) in group.iter().zip(rows.chunks_exact_mut(L::WIDTH)) {
            interpolate(march.k, cells).store(row);
        }
    }
}

/// The samples from the first of each of a cell's edges on, as many of each: what lies in one lies in all.
struct Edges<'v, S> {
    samples: [&'v [S]; 4],
    width: usize,
    height: usize,
    /// Whether an index is a number of binary32 with bits to spare.
    is_small: bool,
}

impl<'v, S: Sample> Edges<'v, S> {
    fn of(field: &Field<'v, S>) -> Option<Self> {
        let [width, height, _] = field.dimensions;
        let offsets = [0, width, width * height, width * height + width];
        let count = field.samples.len().checked_sub(offsets[3])?;
        let mut samples = [field.samples; 4];
        for (edge, offset) in samples.iter_mut().zip(offsets) {
            *edge = field.samples.get(offset..offset + count)?;
        }
        Some(Edges {
            samples,
            width,
            height,
            is_small: field.samples.len() < 1 << (f32::MANTISSA_DIGITS - 2),
        })
    }

    /// The cell of each lane's place.
    #[inline(always)]
    fn fetch<L: Lanes<Element: Number>>(
        &self,
        [x, y, z]: [L; 3],
        [last_x, last_y, last_z]: [L; 3],
        cells: &mut Cells<L::Element>,
    ) {
        let (i, in_x, from_x) = cell(x, last_x);
        let (j, in_y, from_y) = cell(y, last_y);
        let (k, in_z, from_z) = cell(z, last_z);
        in_x.store(&mut cells.parts[0]);
        in_y.store(&mut cells.parts[1]);
        in_z.store(&mut cells.parts[2]);
        let mut places = [[L::Element::ZERO; MOST]; 3];
        if self.is_small {
            let count = |count: usize| L::Element::rounded(count as f64);
            let (width, height) = (x.all(count(self.width)), x.all(count(self.height)));
            let (_, shifted) = nearest_integer(i + width * (j + height * k));
            shifted.store(&mut places[0]);
            for (lane, place) in places[0].iter().enumerate().take(L::WIDTH) {
                self.fetch_one(place.index(), lane, cells);
            }
        } else {
            from_x.store(&mut places[0]);
            from_y.store(&mut places[1]);
            from_z.store(&mut places[2]);
            for lane in 0..L::WIDTH {
                let [i, j, k] = super::indices(&places, lane);
                self.fetch_one(i + self.width * (j + self.height * k), lane, cells);
            }
        }
    }

    /// The value at the place of one ray, for which nothing is laid out side by side.
    #[inline(always)]
    fn of_one<T: Number, L: Lanes<Element = T>>(&self, [x, y, z]: [L; 3], last: [L; 3]) -> T {
        let [(_, x, i), (_, y, j), (_, z, k)] = [
            cell(alone(x), alone(last[0])),
            cell(alone(y), alone(last[1])),
            cell(alone(z), alone(last[2])),
        ];
        let first = i.index() + self.width * (j.index() + self.height * k.index());
        let edge = |samples: &[S]| match samples.get(first..first + 2) {
            Some(&[near, far]) => {
                let [near, far] = [near, far].map(T::rounded);
                between(x, near, far)
            }
            _ => T::nan(),
        };
        let [a, b, c, d] = self.samples;
        between(
            z,
            between(y, edge(a), edge(b)),
            between(y, edge(c), edge(d)),
        )
    }

    #[inline(always)]
    fn fetch_one<T: Number>(&self, first: usize, lane: usize, cells: &mut Cells<T>) {
        for (samples, edge) in self.samples.iter().zip(&mut cells.edges) {
            edge[lane] = match samples.get(first..first + 2) {
                Some(&[near, far]) => [T::rounded(near), T::rounded(far)],
                _ => [T::nan(); 2],
            };
        }
    }
}

/// The cell along an axis, where in it x is, from 0 to 1, and the cell again with the index in its bits: which of two cells a
/// place between them belongs to is all the same.
#[inline(always)]
fn cell<L: Lanes<Element: Number>>(x: L, last: L) -> (L, L, L) {
    let (cell, shifted) = nearest_integer((x - x.all(L::Element::HALF)).least(last));
    (cell, x - cell, shifted)
}

#[inline(always)]
fn interpolate<L: Lanes>(zero: L, cells: &Cells<L::Element>) -> L {
    let [x, y, z] = &cells.parts;
    let (x, y, z) = (zero.load(x), zero.load(y), zero.load(z));
    let [a, b, c, d] = &cells.edges;
    let near = between(y, edge(x, a), edge(x, b));
    let far = between(y, edge(x, c), edge(x, d));
    between(z, near, far)
}

#[inline(always)]
fn edge<L: Lanes>(x: L, ends: &[[L::Element; 2]; MOST]) -> L {
    let ends = ends.as_flattened();
    let (near, far) = x.load(ends).unzipped(x.load(&ends[L::WIDTH..]));
    between(x, near, far)
}

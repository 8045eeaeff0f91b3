//! Transfer functions in the numbers of rays.

use super::bundle::alone;
use super::number::Number;
use crate::real::lanes::{Lanes, MOST};
use crate::volume::{ControlPoint, TransferFunction};

/// Up to so many control points all are looked at.
const FEW: usize = 8;

/// τ and C of some channels, linear from one s to the next.
#[derive(Clone, Debug)]
pub(super) struct Table<T, const C: usize> {
    /// Below which the first piece holds.
    low: T,
    /// From which on the last piece has its far value.
    high: T,
    first: Piece<T, C>,
    others: Vec<Piece<T, C>>,
}

/// From `s` on.
#[derive(Clone, Copy, Debug)]
struct Piece<T, const C: usize> {
    s: T,
    /// 1 by its width; 0 where it is one value.
    inverse: T,
    extinction: [T; 2],
    emission: [[T; 2]; C],
}

/// A piece for each lane: its s and inverse, τ and C at both of its ends.
type Chosen<L, const C: usize> = (L, L, [L; 2], [[L; 2]; C]);

/// τ and C.
#[derive(Clone, Copy)]
pub(super) struct Values<L, const C: usize> {
    pub(super) extinction: L,
    pub(super) emission: [L; C],
}

impl<T: Number, const C: usize> Table<T, C> {
    /// Of the channels from one on; 0 for those that are not there.
    pub(super) fn new(transfer: &TransferFunction, channel: usize) -> Option<Self> {
        let (first, last) = (transfer.points.first()?, transfer.points.last()?);
        let held = |point| Piece::new(point, point, T::ZERO, channel);
        let low = T::rounded(first.s);
        let mut is_jump = false;
        let mut pieces = Vec::with_capacity(transfer.points.len());
        let behind = transfer.points.iter().skip(1);
        for (near, far) in transfer.points.iter().zip(behind) {
            let inverse = T::ONE / (T::rounded(far.s) - T::rounded(near.s));
            is_jump = !(inverse > T::ZERO && inverse.is_finite());
            if !is_jump {
                pieces.push(Piece::new(near, far, inverse, channel));
            } else if pieces.is_empty() {
                // A jump at the least s: the first point holds below.
                pieces.push(Piece {
                    s: T::min_value(),
                    ..held(near)
                });
            }
        }
        // A jump at the largest s, or one value everywhere.
        if !pieces.last().is_some_and(|piece| piece.inverse > T::ZERO) || is_jump {
            pieces.push(held(last));
        }
        let has_jump = pieces.first().is_some_and(|piece| piece.s < low);
        let first = *pieces.first()?;
        Some(Table {
            low: if has_jump { T::min_value() } else { low },
            high: T::rounded(last.s),
            first,
            others: pieces.split_off(1),
        })
    }

    #[inline(always)]
    pub(super) fn at<L: Lanes<Element = T>>(&self, s: L) -> Values<L, C> {
        // Infinite values are held; what is no number stays none.
        let (low, high) = (s.all(self.low), s.all(self.high));
        let s = L::select(s.below(low), low, s);
        let s = L::select(high.below(s), high, s);
        let (from, inverse, extinction, emission) = if L::WIDTH == 1 {
            self.piece(alone(s)).everywhere(s)
        } else if self.others.len() > FEW {
            self.searched(s)
        } else {
            self.chosen(s)
        };
        let one = s.all(T::ONE);
        let part = (s - from) * inverse;
        let part = L::select(one.below(part), one, part);
        let rest = one - part;
        let mut values = Values {
            extinction: extinction[0] * rest + extinction[1] * part,
            emission: [one; C],
        };
        for (value, [near, far]) in values.emission.iter_mut().zip(emission) {
            *value = near * rest + far * part;
        }
        values
    }

    /// Every piece, one over the other.
    #[inline(always)]
    fn chosen<L: Lanes<Element = T>>(&self, s: L) -> Chosen<L, C> {
        let (mut from, mut inverse, mut extinction, mut emission) = self.first.everywhere(s);
        for piece in &self.others {
            let start = s.all(piece.s);
            let is_before = s.below(start);
            from = L::select(is_before, from, start);
            inverse = L::select(is_before, inverse, s.all(piece.inverse));
            let [near, far] = piece.extinction;
            extinction = [
                L::select(is_before, extinction[0], s.all(near)),
                L::select(is_before, extinction[1], s.all(far)),
            ];
            for (lanes, [near, far]) in emission.iter_mut().zip(piece.emission) {
                *lanes = [
                    L::select(is_before, lanes[0], s.all(near)),
                    L::select(is_before, lanes[1], s.all(far)),
                ];
            }
        }
        (from, inverse, extinction, emission)
    }

    /// The piece of each lane, lane by lane.
    #[inline(always)]
    fn searched<L: Lanes<Element = T>>(&self, s: L) -> Chosen<L, C> {
        let row = [T::ZERO; MOST];
        let mut places = row;
        s.store(&mut places);
        let (mut from, mut inverse, mut extinction) = (row, row, [row; 2]);
        let mut emission = [[row; 2]; C];
        for lane in 0..L::WIDTH {
            let piece = self.piece(places[lane]);
            from[lane] = piece.s;
            inverse[lane] = piece.inverse;
            for side in 0..2 {
                extinction[side][lane] = piece.extinction[side];
                for (rows, values) in emission.iter_mut().zip(&piece.emission) {
                    rows[side][lane] = values[side];
                }
            }
        }
        let mut emissions = [[s; 2]; C];
        for (lanes, [near, far]) in emissions.iter_mut().zip(&emission) {
            *lanes = [s.load(near), s.load(far)];
        }
        let [near, far] = &extinction;
        let extinction = [s.load(near), s.load(far)];
        (s.load(&from), s.load(&inverse), extinction, emissions)
    }

    #[inline(always)]
    fn piece(&self, s: T) -> &Piece<T, C> {
        let before = if self.others.len() > FEW {
            self.others.partition_point(|piece| piece.s <= s)
        } else {
            let later = self.others.iter().position(|piece| s < piece.s);
            later.unwrap_or(self.others.len())
        };
        before
            .checked_sub(1)
            .and_then(|last| self.others.get(last))
            .unwrap_or(&self.first)
    }
}

impl<T: Number, const C: usize> Piece<T, C> {
    fn new(near: &ControlPoint, far: &ControlPoint, inverse: T, channel: usize) -> Self {
        let of = |point: &ControlPoint, channel| {
            let value = point.emission.get(channel).copied();
            T::rounded(value.unwrap_or(0.0))
        };
        Piece {
            s: T::rounded(near.s),
            inverse,
            extinction: [T::rounded(near.extinction), T::rounded(far.extinction)],
            emission: std::array::from_fn(|c| [of(near, channel + c), of(far, channel + c)]),
        }
    }

    /// The same for all lanes.
    #[inline(always)]
    fn everywhere<L: Lanes<Element = T>>(&self, zero: L) -> Chosen<L, C> {
        let [near, far] = self.extinction;
        let mut emission = [[zero; 2]; C];
        for (lanes, [near, far]) in emission.iter_mut().zip(self.emission) {
            *lanes = [zero.all(near), zero.all(far)];
        }
        let extinction = [zero.all(near), zero.all(far)];
        (
            zero.all(self.s),
            zero.all(self.inverse),
            extinction,
            emission,
        )
    }
}

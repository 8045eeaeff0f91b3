//! Rays side by side, as they are cut.

use super::number::Number;
use super::span::{Span, Steps};
use crate::real::lanes::{LaneFloat, Lanes, MOST};

/// As many rays as there are lanes; those that miss the box have no segment.
#[derive(Clone, Debug)]
pub(super) struct Bundle<T> {
    /// Where each begins, in places of the grid, axis by axis.
    start: [[T; MOST]; 3],
    /// How the place changes over a step.
    step: [[T; MOST]; 3],
    /// The length of a step.
    length: [T; MOST],
    /// Where its last segment ends, in steps.
    end: [T; MOST],
    /// How many segments the longest has.
    pub(super) segments: usize,
}

impl<T: Number> Bundle<T> {
    pub(super) fn new(rays: &[Option<(Span, Steps)>]) -> Self {
        let zeros = [T::ZERO; MOST];
        let mut bundle = Bundle {
            start: [zeros; 3],
            step: [zeros; 3],
            length: zeros,
            end: zeros,
            segments: 0,
        };
        for (lane, ray) in rays.iter().enumerate().take(MOST) {
            let Some((span, steps)) = ray else { continue };
            for axis in 0..3 {
                bundle.start[axis][lane] = T::rounded(span.start[axis]);
                bundle.step[axis][lane] = T::rounded(span.direction[axis] * steps.step);
            }
            bundle.length[lane] = T::rounded(steps.step);
            bundle.end[lane] = T::rounded(steps.end);
            bundle.segments = bundle.segments.max(steps.count);
        }
        bundle
    }

    #[inline(always)]
    pub(super) fn in_lanes<L: Lanes<Element = T>>(&self, zero: L) -> Rays<L> {
        let [x, y, z] = &self.start;
        let [u, v, w] = &self.step;
        Rays {
            start: [zero.load(x), zero.load(y), zero.load(z)],
            step: [zero.load(u), zero.load(v), zero.load(w)],
            length: zero.load(&self.length),
            end: zero.load(&self.end),
        }
    }
}

/// The same as vectors.
#[derive(Clone, Copy)]
pub(super) struct Rays<L> {
    pub(super) start: [L; 3],
    pub(super) step: [L; 3],
    length: L,
    end: L,
}

impl<L: Lanes> Rays<L> {
    /// Where segment k has a sample, in steps: at a part of it. Behind the end all segments are there, and have no length.
    #[inline(always)]
    pub(super) fn sample(self, k: L, offset: L) -> L {
        let front = k.least(self.end);
        let back = (k + k.all(L::Element::ONE)).least(self.end);
        front + offset * (back - front)
    }

    /// The length of segment k.
    #[inline(always)]
    pub(super) fn segment(self, k: L) -> L {
        let front = k.least(self.end);
        let back = (k + k.all(L::Element::ONE)).least(self.end);
        (back - front) * self.length
    }
}

/// The number, where there is one lane.
#[inline(always)]
pub(super) fn alone<L: Lanes>(lane: L) -> L::Element {
    let mut number = [L::Element::ZERO];
    lane.store(&mut number);
    number[0]
}

//! The ray cut where the program takes another way: what is left goes one way each.

use super::branches::{Branches, Taken, branches};
use crate::symbolic::{Interval, Program};
use rug::Float;

/// A part of the ray.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) from: Float,
    pub(super) to: Float,
    /// The way it goes; `None` in what is too short to tell.
    pub(super) branches: Option<Branches>,
}

impl Stretch {
    /// It in a power of 2 of parts, or in fewer where there are no numbers between.
    pub(super) fn cut(self, parts: u32) -> Vec<Stretch> {
        let middle = Float::with_val(self.from.prec(), &self.from + &self.to) / 2_u32;
        if parts < 2 || middle <= self.from || middle >= self.to {
            return vec![self];
        }
        let front = Stretch {
            to: middle.clone(),
            ..self.clone()
        };
        let back = Stretch {
            from: middle,
            ..self
        };
        let halves = [front, back].into_iter();
        halves.flat_map(|half| half.cut(parts / 2)).collect()
    }
}

/// More parts are not looked at.
const MAX_PARTS: usize = 1 << 16;

/// Cuts the ray at `cuts`, in their order, and wherever the way changes, to a length of `shortest`.
/// `None` where there is no end of it.
pub(super) fn stretches(
    program: &Program,
    constants: &[Interval],
    cuts: &[Float],
    shortest: &Float,
) -> Option<Vec<Stretch>> {
    let mut found: Vec<Stretch> = Vec::new();
    let mut open: Vec<(Float, Float)> = cuts
        .windows(2)
        .rev()
        .filter(|pair| pair[0] < pair[1])
        .map(|pair| (pair[0].clone(), pair[1].clone()))
        .collect();
    let mut parts = 0;
    while let Some((from, to)) = open.pop() {
        parts += 1;
        if parts > MAX_PARTS {
            return None;
        }
        let middle = Float::with_val(from.prec(), &from + &to) / 2_u32;
        let panel = Interval::exactly(&from).union(&Interval::exactly(&to));
        let taken = branches(program, constants, &panel, &Interval::exactly(&middle));
        let width = Float::with_val(64, &to - &from);
        let branches = match taken {
            Taken::Known(branches) => Some(branches),
            Taken::Open if width <= *shortest || middle <= from || middle >= to => None,
            Taken::Open => {
                open.push((middle.clone(), to));
                open.push((from, middle));
                continue;
            }
        };
        match found.last_mut() {
            Some(last) if last.branches == branches => last.to = to,
            _ => found.push(Stretch { from, to, branches }),
        }
    }
    Some(found)
}

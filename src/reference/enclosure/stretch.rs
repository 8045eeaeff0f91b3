//! The ray cut where the program takes another way, and where it is not analytic: what is left goes one way each, and
//! is analytic between its ends and, in the right variable, at them.

use super::branches::{Taken, branches};
use super::crossing::{Comparison, Crossing, ROUGH_BITS};
use super::run::Branches;
use super::substitution::{End, Substitution};
use crate::symbolic::{Interval, Program};
use rug::{Float, Rational};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A part of the ray, from one u to another; u is λ where nothing is substituted.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) from: Float,
    pub(super) to: Float,
    /// The way it goes; `None` in what is too short to tell.
    pub(super) branches: Option<Branches>,
    /// What λ is of u.
    pub(super) substitution: Option<Arc<Substitution>>,
}

impl Stretch {
    /// λ at u.
    pub(super) fn lambda(&self, u: &Interval) -> Interval {
        match &self.substitution {
            Some(substitution) => substitution.lambda(u),
            None => u.clone(),
        }
    }

    /// λ at both ends.
    pub(super) fn ends(&self) -> [Interval; 2] {
        [&self.from, &self.to].map(|u| self.lambda(&Interval::exactly(u)))
    }

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

/// What the ray is made of before anything is substituted.
enum Part {
    /// From one number to another, one way or too short to tell.
    Along {
        from: Float,
        to: Float,
        branches: Option<Branches>,
    },
    /// A place that is known to lie between two numbers, where the way changes.
    Across { from: Float, to: Float, end: End },
}

/// What is still to be looked at.
enum Open {
    Along(Float, Float),
    Across(Float, Float, End),
}

/// A ray as a program.
pub(super) struct Ray<'p> {
    pub(super) program: &'p Program,
    pub(super) constants: &'p [Interval],
    /// The same in [`ROUGH_BITS`].
    pub(super) rough: &'p [Interval],
    /// D.
    pub(super) length: &'p Rational,
    /// Kinks and jumps that are known of.
    pub(super) breaks: &'p [Interval],
    /// To what length the ray is cut where no better is known.
    pub(super) shortest: &'p Float,
}

impl Ray<'_> {
    /// The ray up to `end` cut wherever the way changes. `None` where there is no end of it.
    pub(super) fn stretches(&self, end: &Float) -> Option<Vec<Stretch>> {
        Some(self.substituted(&self.parts(end)?))
    }

    fn parts(&self, end: &Float) -> Option<Vec<Part>> {
        let mut found: Vec<Part> = Vec::new();
        let mut open = vec![Open::Along(Float::new(end.prec()), end.clone())];
        let mut looked_at = 0;
        while let Some(next) = open.pop() {
            looked_at += 1;
            if looked_at > MAX_PARTS {
                return None;
            }
            let (from, to) = match next {
                Open::Along(from, to) => (from, to),
                Open::Across(from, to, end) => {
                    found.push(Part::Across { from, to, end });
                    continue;
                }
            };
            let branches = match self.way(&from, &to) {
                Way::One(branches) => Some(branches),
                Way::Short => None,
                Way::Cut(cuts) => {
                    let mut ends = vec![from];
                    ends.extend(cuts);
                    ends.push(to);
                    let pairs = ends.windows(2).rev().filter(|pair| pair[0] < pair[1]);
                    open.extend(pairs.map(|pair| Open::Along(pair[0].clone(), pair[1].clone())));
                    continue;
                }
                Way::Changes { below, above, end } => {
                    open.push(Open::Along(above.clone(), to));
                    open.push(Open::Across(below.clone(), above, *end));
                    open.push(Open::Along(from, below));
                    continue;
                }
            };
            match found.last_mut() {
                Some(Part::Along {
                    branches: last,
                    to: end,
                    ..
                }) if *last == branches => *end = to,
                _ => found.push(Part::Along { from, to, branches }),
            }
        }
        Some(found)
    }

    /// Which way the program goes between two numbers.
    fn way(&self, from: &Float, to: &Float) -> Way {
        let middle = Float::with_val(from.prec(), from + to) / 2_u32;
        let mut wide = Interval::exactly(from).union(&Interval::exactly(to));
        let mut within = Interval::exactly(&middle);
        let width = Float::with_val(64, to - from);
        // Few bits are enough where they tell the ends well apart.
        let mut constants = self.constants;
        if width > Float::with_val(64, to >> (ROUGH_BITS / 2)) {
            constants = self.rough;
            wide = wide.to_bits(ROUGH_BITS);
            within = within.to_bits(ROUGH_BITS);
        }
        let mut known = BTreeMap::new();
        loop {
            let taken = branches(self.program, constants, &wide, &within, &known);
            let (taken, place) = match taken {
                Taken::Known(branches) => return Way::One(branches),
                Taken::Open { taken, place } => (taken, place),
            };
            if width <= *self.shortest || middle <= *from || middle >= *to {
                return Way::Short;
            }
            let comparison = Comparison {
                program: self.program,
                constants: self.constants,
                rough: self.rough,
                taken: &taken,
                place,
            };
            match comparison.crossing(from, to, self.shortest) {
                // A way that is known already tells nothing new.
                Crossing::Never(way) if known.insert(place, way).is_none() => {}
                Crossing::Once { below, above, end } => return Way::Changes { below, above, end },
                _ => return Way::Cut(self.breaks_between(from, to).unwrap_or(vec![middle])),
            }
        }
    }

    /// The bounds of the first known break between two numbers.
    fn breaks_between(&self, from: &Float, to: &Float) -> Option<Vec<Float>> {
        let mut breaks = self.breaks.iter();
        let found = breaks.find(|place| place.lower() > from && place.upper() < to)?;
        let bound = |x: &Float| Float::with_val(from.prec(), x);
        Some(vec![bound(found.lower()), bound(found.upper())])
    }

    /// The parts in variables in which they are analytic at their ends.
    fn substituted(&self, parts: &[Part]) -> Vec<Stretch> {
        let powers: Vec<[u32; 2]> = (0..parts.len()).map(|i| self.powers(parts, i)).collect();
        // A place where the way changes is the very end of both sides where one of them has a root there.
        let is_end = |i: usize| {
            let before = i.checked_sub(1).and_then(|i| powers.get(i));
            let after = powers.get(i + 1);
            before
                .zip(after)
                .is_some_and(|(before, after)| before[1] > 1 || after[0] > 1)
        };
        let mut stretches = Vec::new();
        for (i, part) in parts.iter().enumerate() {
            let (from, to, branches) = match part {
                Part::Along { from, to, branches } => (from, to, branches),
                Part::Across { from, to, .. } if from < to && !is_end(i) => {
                    stretches.push(Stretch {
                        from: from.clone(),
                        to: to.clone(),
                        branches: None,
                        substitution: None,
                    });
                    continue;
                }
                Part::Across { .. } => continue,
            };
            let [near, far] = powers[i];
            let is_across =
                |i: usize| matches!(parts.get(i), Some(Part::Across { .. })) && is_end(i);
            let at_near = near > 1 || i.checked_sub(1).is_some_and(is_across);
            let at_far = far > 1 || is_across(i + 1);
            let plain = |from: &Float, to: &Float| Stretch {
                from: from.clone(),
                to: to.clone(),
                branches: branches.clone(),
                substitution: None,
            };
            let ends = self.ends(parts, i);
            let middle = Float::with_val(from.prec(), from + to) / 2_u32;
            match (at_near, at_far) {
                (false, false) => stretches.push(plain(from, to)),
                (true, false) => {
                    stretches.push(in_power(plain(from, to), &ends[0], near, false));
                }
                (false, true) => stretches.push(in_power(plain(from, to), &ends[1], far, true)),
                (true, true) => stretches.extend([
                    in_power(plain(from, &middle), &ends[0], near, false),
                    in_power(plain(&middle, to), &ends[1], far, true),
                ]),
            }
        }
        stretches
    }

    /// The ends of a part, as well as they are known.
    fn ends(&self, parts: &[Part], i: usize) -> [End; 2] {
        let Some(Part::Along { from, to, .. }) = parts.get(i) else {
            return [(), ()].map(|()| End::rational(64, &Rational::new()));
        };
        let across = |i: Option<usize>| match i.map(|i| parts.get(i)) {
            Some(Some(Part::Across { end, .. })) => Some(end.clone()),
            _ => None,
        };
        let near = across(i.checked_sub(1)).unwrap_or_else(|| End::exactly(from));
        let far = if i + 1 == parts.len() {
            End::rational(to.prec(), self.length)
        } else {
            across(Some(i + 1)).unwrap_or_else(|| End::exactly(to))
        };
        [near, far]
    }

    /// The powers at both ends of a part.
    fn powers(&self, parts: &[Part], i: usize) -> [u32; 2] {
        let Some(Part::Along {
            from,
            to,
            branches: Some(branches),
        }) = parts.get(i)
        else {
            return [1, 1];
        };
        let width = &Interval::exactly(to) - &Interval::exactly(from);
        let [near, far] = self.ends(parts, i);
        let power = |end: &End, is_far: bool| {
            Substitution::power_at(self.program, self.constants, branches, end, &width, is_far)
        };
        [power(&near, false), power(&far, true)]
    }
}

/// Which way a program goes between two numbers.
enum Way {
    /// The same way everywhere, but for single places.
    One(Branches),
    /// They are too near to each other to tell.
    Short,
    /// It is not known: to be cut there.
    Cut(Vec<Float>),
    /// It changes between these two.
    Changes {
        below: Float,
        above: Float,
        end: Box<End>,
    },
}

/// The same part of the ray with λ = a ± w vᵖ, a one of its ends.
fn in_power(part: Stretch, end: &End, power: u32, is_far: bool) -> Stretch {
    let bits = part.from.prec();
    let integer = |n: i32| Float::with_val(bits, n);
    let (width, u) = if is_far {
        (&end.place - &Interval::exactly(&part.from), [-1, 0])
    } else {
        (&Interval::exactly(&part.to) - &end.place, [0, 1])
    };
    Stretch {
        from: integer(u[0]),
        to: integer(u[1]),
        substitution: Some(Arc::new(Substitution {
            end: end.clone(),
            width,
            power,
            is_far,
        })),
        branches: part.branches,
    }
}

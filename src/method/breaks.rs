//! What a place where the medium is not analytic leaves of a rule's order.
//!
//! Near a break b an integrand is smooth plus a multiple of (λ − b)₊^α. A rule on [0, 1] with nodes xᵢ and
//! weights wᵢ integrates that wrong by
//!
//! ```text
//! E_α(θ) = Σ wᵢ (xᵢ − θ)₊^α − (1 − θ)^(1+α)/(1 + α)
//! ```
//!
//! where θ is the break's place in its segment, so that a composite rule errs by `E_α(θ)·d^(1+α)` once. On a
//! boundary, θ = 1 of the segment that ends there, `E_α` vanishes for α ≥ 1, whereas for a jump it is the
//! weight of the end: the value there is the right-hand one, as cases are evaluated. Where `E_α` vanishes at
//! every level, the next power that the smooth factor brings, α + 1, decides; once that reaches the
//! rule's own order, the break limits nothing.

use super::Limit;
use super::limit::Part;
use crate::case::Break;
use crate::quadrature::{Rule, UnitRule};
use rug::Rational;
use rug::ops::Pow;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Bits of a rule's table here, and what counts as 0: Gauss–Legendre's nodes are irrational.
const BITS: u32 = 128;
const ZERO_BITS: u32 = 150;

/// What a break allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Allowed {
    /// Whatever order the rule has.
    All,
    /// That order.
    Order(f64),
    /// Nobody knows.
    Unknown,
}

impl Allowed {
    /// The limit that this is for a part of a method, if it is one.
    pub(super) fn limit(self, part: Part) -> Option<Limit> {
        match self {
            Allowed::All => None,
            Allowed::Order(order) => Some(Limit::new(part, order)),
            Allowed::Unknown => Some(Limit::unknown(part)),
        }
    }
}

/// A break as a rule meets it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting<'a> {
    /// Its part of D, where that is rational.
    pub(super) part: Option<&'a Rational>,
    /// Its power α.
    pub(super) power: &'a Rational,
    /// The numbers of segments that are run; `None` where none is known, when the break lies off the nodes.
    pub(super) ladder: Option<&'a [u64]>,
}

impl<'a> Meeting<'a> {
    /// The meeting with that break of a function which has that power there.
    pub(super) fn of(place: &'a Break, power: &'a Rational, ladder: Option<&'a [u64]>) -> Self {
        Meeting {
            part: place.part.as_ref(),
            power,
            ladder,
        }
    }

    /// What it allows a rule that is laid over groups of `group` segments. The rule is `None` where its
    /// nodes are random, inside the segments. `peeks`: besides whole groups, places inside them are looked at,
    /// where an error of the break's own group counts for this one group only.
    pub(super) fn allows(&self, rule: Option<Rule>, group: u64, peeks: bool) -> Allowed {
        let generic = Allowed::Order(1.0 + self.power.to_f64());
        let Some(places) = self.places(group) else {
            return generic;
        };
        let on_boundary = places.iter().all(|place| *place == 1);
        let whole = *self.power.denom() == 1 && *self.power >= 0;
        if !whole {
            return generic;
        }
        let Some((table, order)) =
            rule.and_then(|rule| Some((rule.table(BITS).ok()?, rule.order())))
        else {
            let jump_at_end = rule.is_some() && *self.power == 0;
            return if on_boundary && !jump_at_end {
                Allowed::All
            } else {
                generic
            };
        };
        let mut power = self.power.numer().to_u32().unwrap_or(u32::MAX);
        let last = if peeks && !on_boundary {
            order.min(power.saturating_add(2))
        } else if on_boundary {
            // Beyond the jump itself every E vanishes there.
            order.min(power.saturating_add(1))
        } else {
            order
        };
        while power < last {
            if places.iter().any(|place| !vanishes(&table, place, power)) {
                return Allowed::Order(1.0 + f64::from(power));
            }
            power += 1;
        }
        if last < order && !on_boundary {
            Allowed::Order(f64::from(last))
        } else {
            Allowed::All
        }
    }

    /// The places θ in (0, 1] of the break in its group, over all levels; none where they are not known.
    fn places(&self, group: u64) -> Option<BTreeSet<Rational>> {
        let part = self.part?;
        let one = Rational::from(1);
        if *part == 0 || *part == 1 {
            return Some(BTreeSet::from([one]));
        }
        let place = |&n: &u64| {
            let groups = Rational::from(part * n) / group.max(1);
            let before = Rational::from(groups.ceil_ref()) - 1;
            groups - before
        };
        let places: BTreeSet<Rational> = self.ladder?.iter().map(place).collect();
        (!places.is_empty()).then_some(places)
    }

    /// Whether it lies on a boundary of segments at every level.
    pub(super) fn is_on_nodes(&self) -> bool {
        self.places(1)
            .is_some_and(|places| places.iter().all(|place| *place == 1))
    }
}

/// Whether E of that power is 0 at a place.
fn vanishes(table: &Arc<UnitRule>, place: &Rational, power: u32) -> bool {
    let mut error = Rational::new();
    for (node, weight) in table.nodes.iter().zip(&table.weights) {
        if node >= place {
            // 0⁰ = 1: the value at a jump is the right-hand one.
            error += Rational::from(node - place).pow(power) * weight;
        }
    }
    let rest = Rational::from(1 - place).pow(power.saturating_add(1));
    error -= rest / (u64::from(power) + 1);
    error.abs() < Rational::from((1, rug::Integer::from(1) << ZERO_BITS))
}

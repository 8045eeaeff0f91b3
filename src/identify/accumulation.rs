//! In what order a kernel adds, by swamping: what is added to a sum that is too large for it is lost.
//!
//! One sample shines so brightly that all others are less than half a unit of its last place. What was summed before
//! it is met counts for as much as it is; what comes one by one afterwards is lost. So each place of the bright one tells
//! what is summed before it is met, which is the tree of the sum (as `FPRev`, Xie et al. 2024, arXiv 2411.00442, reads it off sums).

use super::NotIdentified;
use super::ray::{Emission, Layers};
use super::rule::{Curve, Node, Rule, Whole};
use super::session::Session;
use super::weights::Answers;
use serde::Serialize;
use std::fmt;

/// The order in which contributions are added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Accumulation {
    /// One by one from the eye on.
    FrontToBack,
    /// One by one towards the eye.
    BackToFront,
    /// Neighbours first, then their sums.
    Tree,
    /// In so many sums, of every so many-th each.
    Lanes(usize),
    /// So many neighbours one by one, then their sums.
    Blocks(usize),
    /// With more digits than answers have.
    Wider,
}

impl fmt::Display for Accumulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Accumulation::FrontToBack => f.write_str("front to back, one by one"),
            Accumulation::BackToFront => f.write_str("back to front, one by one"),
            Accumulation::Tree => f.write_str("as a tree, neighbours first"),
            Accumulation::Lanes(count) => {
                write!(f, "in {count} sums of every {count}th")
            }
            Accumulation::Blocks(count) => {
                write!(f, "in blocks of {count}, whose sums are added")
            }
            Accumulation::Wider => f.write_str("with more digits than answers have"),
        }
    }
}

const ALL: [Accumulation; 12] = [
    Accumulation::FrontToBack,
    Accumulation::BackToFront,
    Accumulation::Tree,
    Accumulation::Lanes(2),
    Accumulation::Lanes(4),
    Accumulation::Lanes(8),
    Accumulation::Lanes(16),
    Accumulation::Blocks(2),
    Accumulation::Blocks(4),
    Accumulation::Blocks(8),
    Accumulation::Blocks(16),
    Accumulation::Wider,
];

/// Samples of the ray: more than twice as many as there are lanes.
const COUNT: usize = 40;
/// The bright one stands at one of so many neighbours.
const EVERY: usize = 2;
/// What the bright one adds, amid the numbers that have one unit.
const BRIGHT: f64 = 1.5;
/// What each other adds, in units in the last place of that.
const DIM: [f64; 2] = [0.4, 0.05];
/// Units in the last place, in the mean, that what an order keeps may be off; and no other may be within as many more.
const OFF: f64 = 0.1;
/// The same of back to front, where the sum is multiplied at every step and rounded by up to half a unit: two such walks of k
/// steps are √(2/π) √(k/6) units apart in the mean, which for all k from 0 to n is (2/3) √(2/π) √(n/6).
const OFF_MULTIPLIED: f64 = 0.2172;
/// The same of trees, whose sums are multiplied at a few merges: a small part of such a step.
const OFF_MERGED: f64 = 0.2;

impl Accumulation {
    /// The units in the last place that are left of `dim` units from each of all but one of n, beside a bright one at each
    /// of the places.
    fn kept(self, n: usize, dim: f64) -> Vec<f64> {
        let ulp = f64::EPSILON;
        let of = |at: usize| {
            let mut all = vec![dim * ulp; n];
            all[at] = BRIGHT;
            match self {
                // Beside a number that is as precise as can be: the rest rounds once.
                Accumulation::Wider => ((n - 1) as f64 * dim).round(),
                _ => (self.sum(&all) - BRIGHT) / ulp,
            }
        };
        places(n).map(of).collect()
    }

    fn sum(self, all: &[f64]) -> f64 {
        let one_by_one = |some: &mut dyn Iterator<Item = f64>| some.fold(0.0, |sum, x| sum + x);
        match self {
            Accumulation::FrontToBack | Accumulation::Wider => one_by_one(&mut all.iter().copied()),
            Accumulation::BackToFront => one_by_one(&mut all.iter().rev().copied()),
            Accumulation::Tree => tree(all.to_vec()),
            Accumulation::Lanes(count) => {
                let (whole, rest) = all.split_at(all.len() / count * count);
                let of = |lane| one_by_one(&mut whole.iter().skip(lane).step_by(count).copied());
                let lanes = tree((0..count).map(of).collect());
                one_by_one(&mut std::iter::once(lanes).chain(rest.iter().copied()))
            }
            Accumulation::Blocks(count) => one_by_one(
                &mut all
                    .chunks(count)
                    .map(|block| one_by_one(&mut block.iter().copied())),
            ),
        }
    }
}

/// Where the bright one stands among n: in turns at the first and the last of neighbours.
fn places(n: usize) -> impl Iterator<Item = usize> {
    (0..n / EVERY).map(|k| EVERY * k + k % EVERY)
}

/// The sum of neighbours, of those neighbours, and so on.
fn tree(mut level: Vec<f64>) -> f64 {
    while level.len() > 1 {
        level = level.chunks(2).map(|pair| pair.iter().sum()).collect();
    }
    level.first().copied().unwrap_or(0.0)
}

/// The order in which the samples of a rule are added; `None` where none of those known is the only one that explains what
/// is kept. `extinction` is that of a thin segment of length 1.
pub(super) fn accumulation(
    session: &mut Session<'_>,
    rule: &Rule,
    answers: &Answers,
    extinction: f64,
) -> Result<Option<Accumulation>, NotIdentified> {
    let n = COUNT.next_multiple_of(session.multiple);
    let is_plain = rule.output.curve == Curve::Linear
        && rule.output.quantum.is_none()
        && rule.output.high.is_none()
        && rule.emission_max.is_none()
        && rule.whole == Whole::One
        && (rule.background, rule.offset) == (0.0, 0.0);
    if !is_plain || answers.noise > 0.0 || answers.grain > 0.0 || n > session.most_samples {
        return Ok(None);
    }
    let layers = Layers::of(1.0, &vec![extinction; n]);
    let dark = layers.ray("dark".into(), &[]);
    let composed = rule.composed(&dark.segments, 1.0, crate::real::Native::<f64>::new());
    let terms: Vec<(Node, f64)> = composed.terms;
    let distinct = |k: usize| terms.iter().filter(|(node, _)| *node == terms[k].0).count() == 1;
    if terms.len() < n / 2 || !(0..terms.len()).all(distinct) {
        return Ok(None);
    }
    let ulp = 2.0 * answers.unit;
    let scale = |(_, weight): &(Node, f64)| composed.factor * weight;
    if !terms.iter().all(|term| scale(term) > 0.0) {
        return Ok(None);
    }
    let lit = |at: usize, dim: f64| {
        let mut emission = Emission::even(n, 0.0);
        for (k, term) in terms.iter().enumerate() {
            let adds = if k == at { BRIGHT } else { dim * ulp };
            *emission.at_mut(term.0) = adds / scale(term);
        }
        emission
    };
    let count = terms.len();
    let levels = std::iter::once(0.0).chain(DIM);
    let all: Vec<Emission> = levels
        .flat_map(|dim| places(count).map(move |at| (at, dim)))
        .map(|(at, dim)| lit(at, dim))
        .collect();
    let ray = session.ray(&layers, &all);
    let got = session.ask(&ray)?;
    let mut levels = got.chunks(places(count).count());
    let alone = levels.next().unwrap_or_default();
    let kept = levels.map(|level| {
        let both = level.iter().zip(alone);
        both.map(|(with, alone)| (with - alone) / ulp).collect()
    });
    Ok(nearest(count, &kept.collect::<Vec<_>>()))
}

/// The order by which what was kept is explained, where it is the only one.
fn nearest(n: usize, kept: &[Vec<f64>]) -> Option<Accumulation> {
    let off = |order: Accumulation| {
        let mut sum = 0.0;
        let mut count = 0;
        for (dim, kept) in DIM.iter().zip(kept) {
            let expected = order.kept(n, *dim);
            let both = kept.iter().zip(expected);
            sum += both.map(|(got, want)| (got - want).abs()).sum::<f64>();
            count += kept.len();
        }
        sum / count as f64
    };
    let mut all: Vec<(f64, Accumulation)> = ALL.iter().map(|order| (off(*order), *order)).collect();
    all.sort_by(|u, v| u.0.total_cmp(&v.0));
    let [(best, order), (second, _), ..] = all.as_slice() else {
        return None;
    };
    let most = match order {
        Accumulation::BackToFront => OFF_MULTIPLIED * (n as f64).sqrt(),
        Accumulation::Tree => OFF_MERGED,
        _ => OFF,
    };
    (*best <= most && *second > best + most).then_some(*order)
}

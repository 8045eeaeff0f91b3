//! The smallest ray that shows a difference: what a user debugs with.
//!
//! Small rays are asked first, by their numbers of segments; a larger one that is known to show it, or is found to, is
//! shrunk as by `QuickCheck` (Claessen and Hughes 2000): fewer segments, then round numbers, as long as a good part of the
//! difference is left.

mod doubt;
mod shape;
mod shrink;
mod small;
mod task;
mod unit_test;

pub use task::TaskError;

pub(super) use doubt::{AgainstKernel, Doubt, Shown, answers};
pub(super) use small::Nodes;

use super::part::short;
use super::rule::{Place, Rule, Scheme};
use super::session::{Budget, Session, Spent};
use super::{Identification, Ray};
use crate::kernel::{Closure, Declaration, Kernel};
use crate::real::Native;
use doubt::{AgainstRules, precision};
use shape::{Shape, per_segment};
use std::fmt;

/// A ray that shows a difference.
#[derive(Clone, Debug)]
pub struct Witness {
    /// The ray.
    pub ray: Ray,
    /// The channel that differs most.
    pub channel: usize,
    /// What the kernel answers there.
    pub got: f64,
    /// What it is to be.
    pub want: f64,
    /// How far from it rounding may lead.
    pub tolerance: f64,
}

/// Digits shown at least.
const DIGITS: usize = 4;
/// Of a difference, so many more are shown than agree.
const MORE: usize = 3;

impl Witness {
    /// n.
    #[must_use]
    pub fn segments(&self) -> usize {
        self.ray.segments.count()
    }

    /// The answer and what it is to be, with as many digits as tell them apart.
    #[must_use]
    pub fn values(&self) -> [String; 2] {
        told_apart(self.got, self.want)
    }

    fn of(ray: Ray, shown: &Shown) -> Self {
        Witness {
            ray,
            channel: shown.channel,
            got: shown.got,
            want: shown.want,
            tolerance: shown.tolerance,
        }
    }
}

impl fmt::Display for Witness {
    /// `n = 2, d = 1, τ = 1 1, C = 0 1: 0.6321 where the rule gives 0.2325`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let segments = &self.ray.segments;
        f.write_str(&described(&self.ray))?;
        let of = |edges: &[f64], middles: &[f64]| per_segment(edges, middles);
        let all = segments.edges.emission.iter();
        let all = all.zip(&segments.middles.emission);
        let all: Vec<String> = all.map(|(edges, middles)| of(edges, middles)).collect();
        let [got, want] = self.values();
        write!(f, ", C = {}", all.join(" | "))?;
        if all.len() > 1 {
            write!(f, ", channel {}", self.channel)?;
        }
        write!(f, ": {got} where the rule gives {want}")
    }
}

/// Two numbers with as many digits as tell them apart.
pub(super) fn told_apart(got: f64, want: f64) -> [String; 2] {
    let part = (got - want).abs() / got.abs().max(want.abs());
    let digits = if part.is_finite() && part > 0.0 {
        // At most 17.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let same = (-part.log10()).clamp(0.0, 17.0) as usize;
        (same + MORE).clamp(DIGITS, 17)
    } else {
        DIGITS
    };
    [got, want].map(|y| significant(y, digits))
}

/// `n = 2, d = 1, τ = 1 1`: a ray without its emission.
pub(super) fn described(ray: &Ray) -> String {
    let segments = &ray.segments;
    let tau = per_segment(&segments.edges.extinction, &segments.middles.extinction);
    let last = segments.lengths().last().unwrap_or(0.0);
    let shorter = if last < ray.step * (1.0 - 1e-9) {
        format!(", the last {}", short(last))
    } else {
        String::new()
    };
    let (n, step) = (segments.count(), short(ray.step));
    format!("n = {n}, d = {step}{shorter}, τ = {tau}")
}

/// A number to so many digits, without an exponent where it is neither large nor small.
fn significant(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return x.to_string().replace("inf", "infinity");
    }
    let scientific = format!("{x:.*e}", digits.saturating_sub(1));
    let exponent = scientific.split_once('e').map_or("0", |(_, e)| e);
    match exponent.parse::<i32>() {
        Ok(exponent @ -4..=5) => {
            let after = usize::try_from(exponent + 1).unwrap_or(0);
            let zeros = usize::try_from(-exponent - 1).unwrap_or(0);
            format!("{x:.*}", (digits + zeros).saturating_sub(after))
        }
        _ => scientific,
    }
}

/// The smallest ray found on which a kernel answers otherwise than each of `rules`; `from` shows that already.
///
/// What is `known` of the kernel says how precise it is; where its rule is named, rays are sought on the rule, at no cost,
/// and only what is found there is asked. At most `budget` is spent; the same kernel has the same witness.
pub fn witness(
    kernel: &mut dyn Kernel,
    rules: &[Rule],
    known: &Identification,
    from: Option<&Ray>,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Option<Witness> {
    let nodes = Nodes::of(rules);
    // A model is asked segments as they are.
    let unplaced: Vec<Rule> = rules.iter().map(on_segments).collect();
    if let Some(rule) = known.named() {
        let declaration = Declaration {
            step_divides: kernel.declaration().step_divides,
            multiple_of: kernel.declaration().multiple_of,
            ..Declaration::new("a rule")
        };
        let rule = on_segments(rule);
        let mut model = Closure::new(declaration, move |task, channel| {
            let answers = task
                .cut()
                .map(|segments| rule.answers(segments, task.step, Native::<f64>::new()));
            let answer = answers.and_then(|answers| answers.get(channel).copied());
            answer.unwrap_or(f64::NAN)
        });
        let free = Budget {
            rays: FREE,
            channels: budget.channels,
            time: budget.time,
        };
        let mut unheard = |_: &Spent| ();
        let session = Session::new(&mut model, free, &mut unheard);
        let nothing_read = Identification {
            optics: None,
            ..known.clone()
        };
        let found = search(
            &mut AgainstRules::new(session, &unplaced, &nothing_read, "model"),
            nodes,
            from,
        );
        if let Some((ray, _)) = found {
            let session = Session::new(&mut *kernel, budget, &mut *heard);
            let mut doubt = AgainstRules::new(session, rules, known, "found");
            if let Some(shown) = doubt.of(&ray) {
                return Some(Witness::of(ray, &shown));
            }
        }
    }
    let mut session = Session::new(kernel, budget, heard);
    let measured = precision(&mut session, known);
    let known = measured.as_ref().unwrap_or(known);
    let mut doubt = AgainstRules::new(session, rules, known, "sought");
    let (ray, shown) = if known.scattered.is_some() {
        // One segment that is the same everywhere has one answer, wherever its sample lies.
        let ones = small::few(nodes).into_iter().take(1).collect();
        let limits = doubt.limits();
        let (shape, shown) = small::search(&mut doubt, ones, limits)?;
        (shape.ray(), shown)
    } else {
        search(&mut doubt, nodes, from)?
    };
    // Answers that are others every time show nothing.
    let again = doubt.of(&ray)?;
    let off = (again.got - shown.got).abs();
    let is_same = off <= shown.tolerance || !(shown.got.is_finite() || again.got.is_finite());
    is_same.then(|| Witness::of(ray, &shown))
}

/// The rule on segments that lie where they are said to.
fn on_segments(rule: &Rule) -> Rule {
    Rule {
        lattice: None,
        ..rule.clone()
    }
}

/// Rays that are sought without asking a kernel.
const FREE: u64 = 20_000;

/// The smallest ray found that shows something.
pub(super) fn search(
    doubt: &mut dyn Doubt,
    nodes: Nodes,
    from: Option<&Ray>,
) -> Option<(Ray, Shown)> {
    let limits = doubt.limits();
    let start = small::search(doubt, small::few(nodes), limits);
    let start = match start {
        Some(found) => Some(found),
        None => match from.map(Shape::of) {
            Some(shape) => doubt.of(&shape.ray()).map(|shown| (shape, shown)),
            None => None,
        },
    };
    let start = match start {
        Some(found) => Some(found),
        None => small::search(doubt, small::many(nodes), limits),
    };
    let (nodes, start) = match start {
        Some(found) => (nodes, Some(found)),
        None => (Nodes::All, small::search(doubt, small::scattered(), limits)),
    };
    let (shape, shown) = start?;
    let (shape, shown) = shrink::shrink(doubt, shape, shown, limits, nodes);
    Some((shape.ray(), shown))
}

impl Nodes {
    /// Where these rules have values.
    pub(super) fn of(rules: &[Rule]) -> Self {
        let mut places = rules.iter().map(|rule| match &rule.scheme {
            Scheme::Sample { place, .. } => match place {
                Place::Front => Nodes::Front,
                Place::Middle => Nodes::Middle,
                Place::Back => Nodes::Back,
            },
            Scheme::Segments { .. } => Nodes::All,
        });
        let first = places.next().unwrap_or(Nodes::Middle);
        if places.all(|place| place == first) {
            first
        } else {
            // Rules of several places are asked only what is the same to all.
            Nodes::Front
        }
    }
}

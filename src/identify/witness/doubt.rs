//! Whether the answers to a ray differ from what they are to be.

use super::super::Identification;
use super::super::holdout::{Compared, SLOPE, compare};
use super::super::output;
use super::super::pose::Steps;
use super::super::precision::Precision;
use super::super::ray::{Emission, Layers, Ray};
use super::super::rule::Rule;
use super::super::session::Session;
use super::super::silence::Silence;
use super::super::state::Repeat;
use super::super::volume::{Optics, tabulated};
use super::super::weights::Answers;
use crate::kernel::Segments;
use std::borrow::Cow;

/// What a ray shows.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::identify) struct Shown {
    /// The channel that differs most.
    pub(in crate::identify) channel: usize,
    pub(in crate::identify) got: f64,
    pub(in crate::identify) want: f64,
    /// What rounding may do.
    pub(in crate::identify) tolerance: f64,
    /// The difference as a part of the larger; 1 of what is not finite.
    pub(in crate::identify) part: f64,
}

/// What rays may be asked.
#[derive(Clone, Copy, Debug)]
pub(in crate::identify) struct Limits {
    /// Numbers of segments are multiples of this.
    pub(in crate::identify) multiple: usize,
    /// Steps divide the ray.
    pub(in crate::identify) divides: bool,
}

/// Somebody who may differ.
pub(in crate::identify) trait Doubt {
    /// What the answers to a ray show; `None` where they are within rounding, or do not come.
    fn of(&mut self, ray: &Ray) -> Option<Shown>;

    /// Whether nothing more can be asked.
    fn is_spent(&self) -> bool;

    fn limits(&self) -> Limits;
}

/// So many times what rounding does is a difference.
const CLEAR: f64 = 10.0;
/// And so many quanta.
const QUANTA: f64 = 3.0;
/// 2^(−p) of a kernel of which nothing is known: that of binary16, so that none is said to differ which only rounds.
const COARSE: f64 = 1.0 / 2048.0;

/// A kernel against rules.
pub(super) struct AgainstRules<'k> {
    session: Session<'k>,
    rules: &'k [Rule],
    answers: Answers,
    /// What answers are multiples of, whatever they are to be.
    quantum: f64,
    /// What is to be read of a volume.
    optics: Option<Optics>,
    spent: bool,
    names: Names,
}

/// Names that no ray had: some kernels remember answers by these.
struct Names {
    stem: &'static str,
    given: u64,
}

impl Names {
    fn next(&mut self, ray: &Ray) -> Ray {
        self.given += 1;
        Ray {
            name: format!("{}-{}", self.stem, self.given),
            ..ray.clone()
        }
    }
}

impl<'k> AgainstRules<'k> {
    pub(super) fn new(
        mut session: Session<'k>,
        rules: &'k [Rule],
        known: &Identification,
        stem: &'static str,
    ) -> Self {
        let state = known.state.as_ref();
        session.twice = state.is_some_and(|state| state.repeat == Repeat::Previous);
        AgainstRules {
            session,
            rules,
            answers: answers(known),
            quantum: quantum(known),
            optics: known.optics.map(|optics| optics.right()),
            spent: false,
            names: Names { stem, given: 0 },
        }
    }
}

impl AgainstRules<'_> {
    /// The segments between which a kernel's samples lie on a ray, and the step.
    fn cut<'r>(&self, rule: &Rule, ray: &'r Ray) -> (Cow<'r, Segments>, f64) {
        match &self.optics {
            Some(optics) => {
                let (segments, step) = optics.cut(&tabulated(ray), &Steps::of(ray));
                (Cow::Owned(segments), step)
            }
            None => rule.cut(ray),
        }
    }
}

/// No precision is assumed of a kernel that is better than that of binary32: what is summed in that is often answered in
/// binary64.
const SINGLE: f64 = 1.0 / 16_777_216.0;
/// Emissions of the ray that shows the precision of a kernel of which nothing is known.
const UNEVEN: [f64; 8] = [0.831, 0.717, 0.593, 0.469, 0.371, 0.297, 0.183, 0.119];

/// What is known of a kernel with the precision that its answers show, where that is not known.
pub(super) fn precision(
    session: &mut Session<'_>,
    known: &Identification,
) -> Option<Identification> {
    if known.parts.unit.is_some() {
        return None;
    }
    let n = 3_usize.next_multiple_of(session.multiple);
    let layers = Layers::of(0.7, &vec![0.9; n]);
    let emission = UNEVEN.map(|c| Emission::of(n, |i| c + i / 7.0));
    let answers = session
        .ask(&layers.ray("precision".into(), &emission))
        .ok()?;
    let mut known = known.clone();
    let quantum = output::quantum(&answers);
    known.parts.unit = Some(match quantum {
        Some(_) => SINGLE,
        None => Precision::of(&answers).unit().max(SINGLE),
    });
    let output = known.parts.output.get_or_insert_default();
    output.quantum = output.quantum.or(quantum);
    Some(known)
}

/// How precise a kernel is, as far as that is known.
pub(in crate::identify) fn answers(known: &Identification) -> Answers {
    Answers {
        unit: known.parts.unit.unwrap_or(COARSE),
        noise: known.parts.noise,
        ..Answers::default()
    }
}

impl Doubt for AgainstRules<'_> {
    fn of(&mut self, ray: &Ray) -> Option<Shown> {
        // Where a channel is to stand the rules say, and not what is known of the kernel.
        self.session.channels = self.rules.first()?.channels;
        let got = match self.session.ask_any(&self.names.next(ray)) {
            Ok(got) => got,
            Err(Silence::Budget(_)) => {
                self.spent = true;
                return None;
            }
            Err(_) => return None,
        };
        let is_placed = self.optics.is_some() || self.rules.iter().any(|r| r.lattice.is_some());
        // A place is known to its rounding, times the medium's slope there.
        let places = if is_placed { SLOPE } else { 1.0 };
        let wide = Answers {
            unit: places * CLEAR * self.answers.unit,
            noise: CLEAR * self.answers.noise,
            ..self.answers.clone()
        };
        let of_rule = |rule: &Rule| {
            let (segments, step) = self.cut(rule, ray);
            let all = compare(rule, &wide, &segments, step, &got);
            let quantum = QUANTA * self.quantum.max(rule.output.quantum.unwrap_or(0.0));
            let all = all.into_iter().enumerate();
            all.map(|(channel, one)| shown(ray, channel, one, quantum, self.answers.unit))
                .collect::<Vec<_>>()
        };
        let all: Vec<Vec<Option<Shown>>> = self.rules.iter().map(of_rule).collect();
        // Of each channel the rule that it is nearest to, where it is near none.
        let channels = (0..got.len()).filter_map(|channel| {
            let mut nearest: Option<Shown> = None;
            for rule in &all {
                let one = rule.get(channel).cloned().flatten()?;
                if nearest.as_ref().is_none_or(|best| one.part < best.part) {
                    nearest = Some(one);
                }
            }
            nearest
        });
        largest(channels)
    }

    fn is_spent(&self) -> bool {
        self.spent
    }

    fn limits(&self) -> Limits {
        Limits {
            multiple: self.session.multiple,
            divides: self.session.divides,
        }
    }
}

fn shown(ray: &Ray, channel: usize, compared: Compared, quantum: f64, unit: f64) -> Option<Shown> {
    let Compared { got, want, .. } = compared;
    let difference = (got - want).abs();
    let is_clear = !compared.agrees && want.is_finite();
    let is_clear = is_clear && (difference > quantum || !got.is_finite());
    is_clear.then(|| Shown {
        channel,
        got,
        want,
        tolerance: rounding(ray, channel, want, unit) + quantum / QUANTA,
        part: part(got, want),
    })
}

/// By how much answers to a ray may differ that are rounded to `unit`.
fn rounding(ray: &Ray, channel: usize, want: f64, unit: f64) -> f64 {
    let segments = &ray.segments;
    let all = [&segments.edges.emission, &segments.middles.emission];
    let all = all.into_iter().filter_map(|of| of.get(channel)).flatten();
    let bright = all.map(|c| c.abs()).fold(0.0, f64::max);
    unit * (16.0 + 4.0 * segments.count() as f64) * (want.abs() + bright)
}

fn part(got: f64, want: f64) -> f64 {
    let part = (got - want).abs() / got.abs().max(want.abs());
    if part.is_finite() { part } else { 1.0 }
}

/// The first of those that differ most.
fn largest(shown: impl Iterator<Item = Shown>) -> Option<Shown> {
    shown.fold(None, |best, one| match best {
        Some(best) if best.part >= one.part => Some(best),
        _ => Some(one),
    })
}

fn quantum(known: &Identification) -> f64 {
    let output = known.parts.output.as_ref();
    output.and_then(|output| output.quantum).unwrap_or(0.0)
}

/// A kernel against another.
pub(in crate::identify) struct AgainstKernel<'k> {
    one: Session<'k>,
    other: Session<'k>,
    unit: f64,
    noise: f64,
    quantum: f64,
    spent: bool,
    names: Names,
}

impl<'k> AgainstKernel<'k> {
    pub(in crate::identify) fn new(
        one: (Session<'k>, &Identification),
        other: (Session<'k>, &Identification),
    ) -> Self {
        let [first, second] = [one.1, other.1].map(answers);
        AgainstKernel {
            unit: first.unit + second.unit,
            noise: first.noise + second.noise,
            quantum: quantum(one.1) + quantum(other.1),
            one: one.0,
            other: other.0,
            spent: false,
            names: Names {
                stem: "both",
                given: 0,
            },
        }
    }

    /// What two rows of answers show.
    pub(in crate::identify) fn compare(
        &self,
        ray: &Ray,
        got: &[f64],
        want: &[f64],
    ) -> Option<Shown> {
        let channels = got.iter().zip(want).enumerate();
        largest(channels.filter_map(|(channel, (&got, &want))| {
            if got.is_nan() && want.is_nan() {
                return None;
            }
            let size = got.abs().max(want.abs());
            let tolerance =
                rounding(ray, channel, size, self.unit) + self.noise * size + self.quantum;
            let near = (got - want).abs() <= CLEAR * tolerance;
            (!near).then(|| Shown {
                channel,
                got,
                want,
                tolerance,
                part: part(got, want),
            })
        }))
    }
}

impl Doubt for AgainstKernel<'_> {
    fn of(&mut self, ray: &Ray) -> Option<Shown> {
        let asked = self.names.next(ray);
        let mut both = Vec::new();
        for session in [&mut self.one, &mut self.other] {
            match session.ask_any(&asked) {
                Ok(answers) => both.push(answers),
                Err(silence) => {
                    self.spent |= matches!(silence, Silence::Budget(_));
                    return None;
                }
            }
        }
        match &both[..] {
            [got, want] => self.compare(ray, got, want),
            _ => None,
        }
    }

    fn is_spent(&self) -> bool {
        self.spent
    }

    fn limits(&self) -> Limits {
        Limits {
            // Both take what is a multiple of both.
            multiple: self.one.multiple.saturating_mul(self.other.multiple),
            divides: self.one.divides || self.other.divides,
        }
    }
}

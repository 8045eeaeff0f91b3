//! Two kernels: in which parts their rules differ, and whether their answers do.

use super::holdout::{self, Terms};
use super::part::{Stated, parts};
use super::ray::Ray;
use super::session::{Budget, Session, Spent};
use super::silence::Silence;
use super::weights::Answers;
use super::witness::{AgainstKernel, Nodes, Witness, search};
use super::{Identification, Rule, VacuumFails};
use crate::kernel::{Declaration, Kernel, KernelError, Rendering, Task};

/// How two kernels compare.
#[derive(Clone, Debug, Default)]
pub struct Against {
    /// Part by part, what their rules do otherwise; empty where one has no rule.
    pub differences: Vec<Difference>,
    /// Rays that both answered.
    pub rays: usize,
    /// Of these, with the same bits in all channels.
    pub same: usize,
    /// Of these, with a difference that is more than rounding.
    pub differ: usize,
    /// Rays that one did not answer, or both.
    pub unanswered: usize,
    /// The smallest ray that shows a difference: `got` is the first one's answer, `want` the second one's.
    pub witness: Option<Witness>,
}

impl Against {
    /// Whether nothing was found that one does and the other does not.
    #[must_use]
    pub fn agree(&self) -> bool {
        self.differences.is_empty() && self.differ == 0 && self.rays > 0
    }
}

/// A part in which two rules differ, in the words of both; `None` where it is plain.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The part, by a name that stays.
    pub part: &'static str,
    /// What the first one does.
    pub one: Option<String>,
    /// What the second one does.
    pub other: Option<String>,
}

/// Part by part, in what two rules differ.
#[must_use]
pub fn differences(one: &Rule, other: &Rule) -> Vec<Difference> {
    let (first, second) = (parts(one), parts(other));
    let of = |all: &[Stated], stated: &Stated| {
        let same = all.iter().find(|own| own.part == stated.part);
        same.map(|own| own.words.clone())
    };
    let mut found: Vec<Difference> = Vec::new();
    for stated in first.iter().chain(&second) {
        let part = stated.part.name();
        let (one, other) = (of(&first, stated), of(&second, stated));
        if one != other && found.iter().all(|known| known.part != part) {
            found.push(Difference { part, one, other });
        }
    }
    found
}

/// Two kernels asked the same at once; the first one's answer counts.
#[derive(Debug)]
struct Pair<'k> {
    one: &'k mut dyn Kernel,
    other: &'k mut dyn Kernel,
    declaration: Declaration,
    asked: Vec<Asked>,
}

/// What both answered to a ray.
#[derive(Debug)]
struct Asked {
    ray: Ray,
    answers: [Vec<f64>; 2],
}

impl Kernel for Pair<'_> {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let first = self.one.render(task)?;
        let second = self.other.render(task)?;
        let read = |answer: &Rendering| answer.radiance.iter().map(rug::Float::to_f64).collect();
        if let Some(segments) = task.cut() {
            self.asked.push(Asked {
                ray: Ray {
                    name: task.subject.name().into(),
                    channels: task.subject.channels().to_vec(),
                    length: task.subject.length().clone(),
                    step: task.step,
                    seed: task.seed,
                    segments: segments.clone(),
                },
                answers: [read(&first), read(&second)],
            });
        }
        Ok(first)
    }

    fn renew(&mut self) {
        self.one.renew();
        self.other.renew();
    }
}

/// A kernel and what was found out about it.
#[derive(Debug)]
pub struct Known<'k> {
    /// The kernel.
    pub kernel: &'k mut dyn Kernel,
    /// What was found out.
    pub found: &'k Identification,
}

/// Compares the rules of two kernels, and their answers to the rays that rules are held out against.
///
/// # Errors
/// [`Silence::Budget`] where the budget is spent before all is asked.
pub fn against(
    one: Known<'_>,
    other: Known<'_>,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Result<Against, Silence> {
    let (first, one) = (one.kernel, one.found);
    let (second, other) = (other.kernel, other.found);
    let mut found = Against::default();
    if let (Some(a), Some(b)) = (one.named(), other.named()) {
        found.differences = differences(a, b);
    }
    let start = ask_both((first, one), (second, other), budget, heard, &mut found)?;
    if found.differ > 0 || !found.differences.is_empty() {
        let mut unheard = |_: &Spent| ();
        let sessions = (
            (Session::new(first, budget, heard), one),
            (Session::new(second, budget, &mut unheard), other),
        );
        let mut doubt = AgainstKernel::new(sessions.0, sessions.1);
        let rules: Vec<Rule> = [one, other]
            .iter()
            .filter_map(|known| known.rule.clone())
            .collect();
        let shown = search(&mut doubt, Nodes::of(&rules), start.as_ref());
        found.witness = shown.map(|(ray, shown)| Witness {
            ray,
            channel: shown.channel,
            got: shown.got,
            want: shown.want,
            tolerance: shown.tolerance,
        });
    }
    Ok(found)
}

/// Asks both the rays of a hold-out; returns one on which they differ.
fn ask_both(
    (first, one): (&mut dyn Kernel, &Identification),
    (second, other): (&mut dyn Kernel, &Identification),
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
    found: &mut Against,
) -> Result<Option<Ray>, Silence> {
    let declaration = Declaration {
        step_divides: first.declaration().step_divides || second.declaration().step_divides,
        multiple_of: first
            .declaration()
            .multiple_of
            .saturating_mul(second.declaration().multiple_of),
        ..Declaration::new("two kernels")
    };
    let mut pair = Pair {
        one: first,
        other: second,
        declaration,
        asked: Vec::new(),
    };
    let rule = one.rule.clone().unwrap_or_default();
    let fails = |known: &Identification| known.parts.vacuum_fails == Some(VacuumFails::Segment);
    let mut session = Session::new(&mut pair, budget, heard);
    let held = holdout::hold_out(
        &mut session,
        &rule,
        &Terms {
            answers: &Answers::default(),
            typical: 1.0,
            no_vacuum: fails(one) || fails(other),
            by_name: false,
            negative: false,
            right: None,
        },
    )?;
    found.unanswered = held.kinds.iter().map(|kind| kind.unanswered).sum();
    let asked = std::mem::take(&mut pair.asked);
    let mut unheard = [|_: &Spent| (), |_: &Spent| ()];
    let [a, b] = &mut unheard;
    let judge = AgainstKernel::new(
        (Session::new(&mut *pair.one, budget, a), one),
        (Session::new(&mut *pair.other, budget, b), other),
    );
    let mut start: Option<(Ray, f64)> = None;
    for Asked { ray, answers } in asked {
        let [got, want] = answers;
        found.rays += 1;
        let bits = |row: &[f64]| row.iter().map(|y| y.to_bits()).collect::<Vec<u64>>();
        found.same += usize::from(bits(&got) == bits(&want));
        if let Some(shown) = judge.compare(&ray, &got, &want) {
            found.differ += 1;
            if start.as_ref().is_none_or(|(_, part)| shown.part > *part) {
                start = Some((ray, shown.part));
            }
        }
    }
    Ok(start.map(|(ray, _)| ray))
}

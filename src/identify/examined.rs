//! A kernel from all sides: what it computes, in what that deviates from what it is to be, and a ray that shows it.

use super::deviation::{Deviation, deviations, misbehaviour, plain};
use super::expected::expected;
use super::opacity_answered::{self, OpacityAnswered};
use super::rule::Rule;
use super::session::{Budget, Spent};
use super::witness::{Witness, witness};
use super::{Identification, NotIdentified, covered, exponential, identify, precision, volume};
use crate::kernel::{Declaration, Kernel};

/// What was found out about a kernel, and what that means.
#[derive(Clone, Debug)]
pub struct Examined {
    /// What it says of itself.
    pub declaration: Declaration,
    /// What it computes.
    pub found: Identification,
    /// In what that deviates; empty too where no rule is named.
    pub deviations: Vec<Deviation>,
    /// The smallest ray that shows it.
    pub witness: Option<Witness>,
    /// A ray whose opacity is answered otherwise than 1 − T.
    pub opacity: Option<OpacityAnswered>,
    /// Rays asked for the witness.
    pub searched: Spent,
}

/// What an examination comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// A rule was identified to the last part, and does not deviate.
    Right,
    /// A rule was identified, or a part of it, and deviates.
    Deviates,
    /// No rule was identified, or a part of what is computed was not.
    NotIdentified,
    /// There was no answer at all.
    NoAnswer,
}

impl Verdict {
    /// In one word, for programs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Right => "right",
            Verdict::Deviates => "deviates",
            Verdict::NotIdentified => "not-identified",
            Verdict::NoAnswer => "no-answer",
        }
    }
}

impl Examined {
    /// Takes the rule back, which does not hold elsewhere: what it deviates in is nobody's.
    pub(crate) fn withdraw(&mut self, reason: &str) {
        (self.found.rule, self.found.method) = (None, None);
        self.found.not_identified.push(NotIdentified::new(reason));
        self.deviations = all_deviations(&self.found, &[], &self.declaration, None);
        (self.witness, self.opacity) = (None, None);
    }

    /// What it comes to.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let spent = self.found.spent;
        if spent.rays == spent.unanswered && spent.rays > 0 {
            Verdict::NoAnswer
        } else if !self.deviations.is_empty() {
            Verdict::Deviates
        } else if self.found.method.is_some()
            || (self.found.not_identified.is_empty()
                && (self.found.named().is_some() || self.found.scattered.is_some()))
        {
            Verdict::Right
        } else {
            Verdict::NotIdentified
        }
    }
}

/// Identifies what a kernel computes, and seeks a ray that shows in what that deviates; each may spend the budget.
pub fn examine(kernel: &mut dyn Kernel, budget: Budget, heard: &mut dyn FnMut(&Spent)) -> Examined {
    let claimed = kernel.declaration().order;
    examine_for(kernel, claimed, budget, heard)
}

/// The same of a kernel of which that order is wanted, whatever it declares.
pub(crate) fn examine_for(
    kernel: &mut dyn Kernel,
    claimed: Option<f64>,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Examined {
    let declaration = Declaration {
        order: claimed,
        ..kernel.declaration().clone()
    };
    let found = identify(kernel, budget, heard);
    let rules = expected(&found, &declaration);
    let opacity = match found.named() {
        Some(rule) if found.hold_out.opacity.agree < found.hold_out.opacity.answered => {
            opacity_answered::smallest(kernel, rule, &found, budget, heard)
        }
        _ => None,
    };
    let all = all_deviations(&found, &rules, &declaration, opacity.as_ref());
    let mut examined = Examined {
        declaration,
        found,
        deviations: all,
        witness: None,
        opacity,
        searched: Spent::default(),
    };
    // A right radiance beside another opacity is shown already.
    let mut of_radiance = examined.deviations.iter();
    let wanted = match examined.verdict() {
        Verdict::Deviates => {
            of_radiance.any(|d| d.name != opacity_answered::NAME && d.shows_on_one_ray())
        }
        Verdict::NotIdentified => true,
        Verdict::Right | Verdict::NoAnswer => false,
    };
    // Of answers that scatter none shows anything, but where only places are drawn.
    let state = examined.found.state.as_ref();
    let is_silent = super::silent(&examined.declaration).is_some();
    let scatters =
        is_silent || examined.declaration.stochastic || state.is_some_and(|state| state.seed);
    if wanted && (!scatters || examined.found.scattered.is_some()) {
        let misses = examined.found.hold_out.misses.iter();
        let from = misses
            .min_by_key(|miss| miss.ray.segments.count())
            .map(|miss| miss.ray.clone());
        let mut searched = Spent::default();
        let mut hear = |spent: &Spent| {
            searched = *spent;
            heard(spent);
        };
        let shown = witness(
            kernel,
            &rules,
            &examined.found,
            from.as_ref(),
            budget,
            &mut hear,
        );
        (examined.witness, examined.searched) = (shown, searched);
    }
    examined
}

/// In what a kernel deviates, part by part.
fn all_deviations(
    found: &Identification,
    rules: &[Rule],
    declaration: &Declaration,
    opacity: Option<&OpacityAnswered>,
) -> Vec<Deviation> {
    let mut all = Vec::new();
    if let (Some(rule), Some(right)) = (found.named(), rules.first()) {
        all.extend(deviations(rule, right, &found.brackets));
        all.extend(rule.lattice.iter().flat_map(covered::deviations));
        all.extend(found.optics.iter().flat_map(volume::deviations));
        all.extend(opacity_answered::deviation(
            &found.hold_out.opacity,
            opacity,
        ));
    }
    all.extend(precision::deviation(found, declaration));
    all.extend(exponential::deviation(found, declaration));
    if let (Some(method), Some(declared)) = (&found.method, &declaration.method)
        && method != declared
    {
        all.push(Deviation {
            instead_of: Some(declared.name()),
            ..plain(
                "method",
                "all rays that were held out",
                &format!("answers are those of {}", method.name()),
            )
        });
    }
    let kinds = found.hold_out.kinds.iter().filter(|kind| kind.holds());
    let kinds: Vec<String> = kinds.map(|kind| kind.name.clone()).collect();
    for deviation in &mut all {
        deviation.validated.clone_from(&kinds);
    }
    if let Some(scattered) = &found.scattered {
        all.extend(scattered.deviations(found));
    }
    let excused = |deviation: &Deviation| declaration.stochastic && deviation.name == "seed";
    all.extend(misbehaviour(found).into_iter().filter(|d| !excused(d)));
    all
}

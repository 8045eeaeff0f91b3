//! A kernel from all sides: what it computes, in what that deviates from what it is to be, and a ray that shows it.

use super::deviation::{Deviation, deviations, misbehaviour};
use super::promised::{misplaced, promised};
use super::session::{Budget, Spent};
use super::witness::{Witness, witness};
use super::{Identification, NotIdentified, identify};
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
    /// Rays asked for the witness.
    pub searched: Spent,
}

/// What an examination comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// A rule was identified, and does not deviate.
    Right,
    /// A rule was identified, or a part of it, and deviates.
    Deviates,
    /// No rule was identified.
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
        self.found.rule = None;
        self.found.not_identified.push(NotIdentified::new(reason));
        self.deviations = behaviour(&self.found, &self.declaration);
        self.witness = None;
    }

    /// What it comes to.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let spent = self.found.spent;
        if spent.rays == spent.unanswered {
            Verdict::NoAnswer
        } else if !self.deviations.is_empty() {
            Verdict::Deviates
        } else if self.found.named().is_some() {
            Verdict::Right
        } else {
            Verdict::NotIdentified
        }
    }
}

/// Identifies what a kernel computes, and seeks a ray that shows in what that deviates; each may spend the budget.
pub fn examine(kernel: &mut dyn Kernel, budget: Budget, heard: &mut dyn FnMut(&Spent)) -> Examined {
    let declaration = kernel.declaration().clone();
    let found = identify(kernel, budget, heard);
    let rules = promised(&found, &declaration);
    let mut all = Vec::new();
    if let (Some(rule), Some(right)) = (found.named(), rules.first()) {
        all.extend(misplaced(&found, rule, &declaration));
        all.extend(deviations(rule, right, &found.brackets));
    }
    all.extend(behaviour(&found, &declaration));
    let mut examined = Examined {
        declaration,
        found,
        deviations: all,
        witness: None,
        searched: Spent::default(),
    };
    let wanted = matches!(
        examined.verdict(),
        Verdict::Deviates | Verdict::NotIdentified
    );
    // Of answers that scatter none shows anything.
    if wanted && !examined.declaration.stochastic {
        let misses = &examined.found.hold_out.misses;
        let from = misses.first().map(|miss| miss.ray.clone());
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

/// What answers depend on beside rays, but for what is declared.
fn behaviour(found: &Identification, declaration: &Declaration) -> Vec<Deviation> {
    let excused = |deviation: &Deviation| declaration.stochastic && deviation.name == "seed";
    let mut all = misbehaviour(found);
    all.retain(|deviation| !excused(deviation));
    all
}

//! Kernels that compute a rule, for tests.

use rug::Float;
use volver::identify::Rule;
use volver::identify::rule::{Law, Place, Scheme};
use volver::kernel::{Data, Declaration, FormKind, Kernel, KernelError, Rendering, Task};
use volver::real::Native;

/// What a rule says, in binary64.
#[derive(Debug)]
pub(super) struct OfRule {
    rule: Rule,
    declaration: Declaration,
}

impl OfRule {
    pub(super) fn new(rule: Rule) -> Self {
        OfRule {
            rule,
            declaration: Declaration::new("composed"),
        }
    }
}

impl Kernel for OfRule {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let Data::Segments(segments) = task.data else {
            return Err(KernelError::Form {
                given: task.data.kind(),
                wanted: FormKind::Segments,
            });
        };
        let answers = self.rule.answers(segments, task.step, Native::<f64>::new());
        Ok(Rendering {
            radiance: answers.iter().map(|y| Float::with_val(53, *y)).collect(),
            ..Rendering::default()
        })
    }
}

/// One sample a segment with an opacity of 1 − e^(−τd).
pub(super) fn plain(place: Place) -> Rule {
    Rule {
        scheme: Scheme::Sample {
            place,
            law: Law::default(),
        },
        ..Rule::default()
    }
}

/// The law of one sample a segment.
pub(super) fn law(rule: &mut Rule) -> &mut Law {
    match &mut rule.scheme {
        Scheme::Sample { law, .. } => law,
        Scheme::Segments { .. } => panic!("several values a segment"),
    }
}

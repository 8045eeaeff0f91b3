//! Kernels that compute a rule, for tests.

use volver::identify::Rule;
use volver::identify::rule::{Law, Place, RuleKernel, Scheme};
use volver::kernel::Declaration;

/// What a rule says, in binary64.
pub(super) fn of_rule(rule: Rule) -> RuleKernel {
    RuleKernel::new(rule, Declaration::new("composed"))
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

//! The opacity that comes with an answer, beside 1 − T of the rule.

use super::Identification;
use super::deviation::Deviation;
use super::holdout::{OpacityCheck, check_opacity};
use super::ray::{Emission, Layers, Ray};
use super::rule::Rule;
use super::session::{Budget, Session, Spent};
use super::witness::{answers, described, told_apart};
use crate::kernel::{FormKind, Kernel};
use std::fmt;

/// A ray whose opacity is answered otherwise.
#[derive(Clone, Debug)]
pub struct OpacityAnswered {
    /// The ray.
    pub ray: Ray,
    /// The opacity that the kernel answers.
    pub got: f64,
    /// 1 − T.
    pub want: f64,
}

impl fmt::Display for OpacityAnswered {
    /// `n = 1, d = 1, τ = 1: 0.5 where 1 − T is 0.6321`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [got, want] = told_apart(self.got, self.want);
        let ray = described(&self.ray);
        write!(f, "{ray}: {got} where 1 − T is {want}")
    }
}

/// The deviation.
pub(crate) const NAME: &str = "opacity-answered";

/// Extinctions of the rays that are asked, of 1, 2 and 5 segments.
const TAUS: [f64; 6] = [1.0, 3.0, 0.1, 10.0, 0.001, 50.0];
const COUNTS: [usize; 3] = [1, 2, 5];

/// Where opacities that were answered are not 1 − T.
pub(super) fn deviation(
    check: &OpacityCheck,
    shown: Option<&OpacityAnswered>,
) -> Option<Deviation> {
    if check.agree == check.answered {
        return None;
    }
    let which = if check.agree == 0 {
        "the opacity answered is not 1 − T of the ray"
    } else {
        "the opacity answered is not 1 − T of every ray"
    };
    let on = shown.map_or_else(String::new, |shown| format!(": {shown}"));
    Some(Deviation {
        name: NAME,
        value: None,
        bracket: None,
        exact: false,
        probe: "opacities that came with the answers of the hold-out",
        validated: Vec::new(),
        does: format!("{which}{on}"),
        instead_of: None,
    })
}

/// The first small ray on which they differ.
pub(super) fn smallest(
    kernel: &mut dyn Kernel,
    rule: &Rule,
    known: &Identification,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Option<OpacityAnswered> {
    // Of other forms a segment's depth is known to the precision of places alone.
    if kernel.declaration().form != FormKind::Segments {
        return None;
    }
    let mut session = Session::new(kernel, budget, heard);
    let answers = answers(known);
    for n in COUNTS {
        if !n.is_multiple_of(session.multiple) {
            continue;
        }
        for tau in TAUS {
            let layers = Layers::of(1.0, &vec![tau; n]);
            let ray = layers.ray(format!("opacity-{n}-{tau}"), &[Emission::even(n, 1.0)]);
            let Ok((_, Some(got))) = session.once(&ray) else {
                continue;
            };
            let mut check = OpacityCheck::default();
            let cut = (&ray.segments, ray.step);
            let want = check_opacity(rule, &answers, cut, got, &mut check);
            if check.agree == 0 {
                return Some(OpacityAnswered { ray, got, want });
            }
        }
    }
    None
}

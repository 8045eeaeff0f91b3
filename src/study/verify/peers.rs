//! The methods of an order, on the levels that a kernel was asked: what all of them show can be seen there, and what none of
//! them does is the kernel's own.

use super::peer::Peer;
use crate::convergence::{FitError, Sample, Verdict};
use crate::method::{Expected, MethodError};
use crate::parallel;
use crate::real::FormatName;
use crate::study::verify::asked::Run;
use crate::study::verify::remark::Seen;
use rug::Float;

/// What a kernel is measured by.
#[derive(Clone, Debug)]
pub(super) enum Peers {
    /// Nothing.
    None,
    /// The declared method, exactly and in the declared format.
    OfMethod([Peer; 2]),
    /// Methods of the declared order in the declared format.
    OfOrder(Vec<Peer>),
}

impl Peers {
    /// The declared method.
    ///
    /// # Errors
    /// [`FitError`], which levels of a kernel do not cause.
    pub(super) fn of_method(
        exact: Vec<Sample>,
        in_format: Vec<Sample>,
        expected: Option<Expected>,
    ) -> Result<Peers, FitError> {
        let (exact, in_format) = (Peer::new(exact, expected)?, Peer::new(in_format, expected)?);
        Ok(Peers::OfMethod([exact, in_format]))
    }

    /// Methods of an order at the kernel's levels and with its floors.
    ///
    /// # Errors
    /// [`FitError`], which levels of a kernel do not cause.
    pub(super) fn of_order(
        methods: &[Run<'_>],
        expected: Option<Expected>,
        format: FormatName,
        exact: &Float,
        levels: &[(u64, Sample)],
    ) -> Result<Peers, FitError> {
        let mut peers = Vec::with_capacity(methods.len());
        for method in methods {
            let run = |(n, _): &(u64, Sample)| method.on(format, *n);
            let radiances: Result<Vec<Float>, MethodError> = parallel::try_map(levels, run);
            // A method that does not run on these levels is no measure.
            let Ok(radiances) = radiances else { continue };
            let samples = levels.iter().zip(radiances).map(|((_, level), radiance)| {
                let error = Float::with_val(exact.prec(), radiance - exact);
                Sample {
                    error,
                    ..level.clone()
                }
            });
            peers.push(Peer::new(samples.collect(), expected)?);
        }
        Ok(Peers::OfOrder(peers))
    }

    /// All of them.
    pub(super) fn all(&self) -> &[Peer] {
        match self {
            Peers::None => &[],
            Peers::OfMethod(both) => both,
            Peers::OfOrder(peers) => peers,
        }
    }

    /// The errors of a kernel's levels beside the largest of theirs; nothing where there are none, or no light.
    pub(super) fn beside(&self, exact: &Float, levels: &[(u64, Sample)]) -> Vec<Seen> {
        let methods = self.all();
        if methods.is_empty() || exact.is_zero() {
            return Vec::new();
        }
        let seen = levels.iter().enumerate();
        seen.map(|(place, level)| Seen::new(exact, level, methods, place))
            .collect()
    }

    /// The verdict on the declared method itself.
    pub(super) fn verdict_of_method(&self) -> Option<Verdict> {
        match self {
            Peers::OfMethod([exact, _]) => Some(exact.verdict),
            Peers::None | Peers::OfOrder(_) => None,
        }
    }

    /// Those on methods of the declared order.
    pub(super) fn verdicts_of_order(&self) -> Vec<Verdict> {
        match self {
            Peers::OfOrder(peers) => peers.iter().map(|peer| peer.verdict).collect(),
            Peers::None | Peers::OfMethod(_) => Vec::new(),
        }
    }

    /// Whether all of them show what is expected.
    pub(super) fn all_show(&self, expected: Option<Expected>) -> bool {
        let all = self.all();
        !all.is_empty() && all.iter().all(|peer| peer.verdict.passes(expected))
    }

    /// Whether it can be seen at all: by the declared method also in its format, else by any of the methods.
    pub(super) fn resolvable(&self, expected: Option<Expected>) -> Option<bool> {
        let mut all = self.all().iter().map(|peer| peer.verdict.passes(expected));
        match self {
            Peers::OfOrder(peers) if !peers.is_empty() => Some(all.any(|shows| shows)),
            Peers::OfMethod(_) => Some(all.all(|shows| shows)),
            Peers::None | Peers::OfOrder(_) => None,
        }
    }
}

//! The methods of an order, on the levels that a kernel was asked: what all of them show can be seen there, and what none of
//! them does is the kernel's own.

use crate::case::SymbolicCase;
use crate::convergence::{FitError, Sample, Verdict, fit};
use crate::kernel::radiance_in;
use crate::method::{Expected, Method, MethodError};
use crate::parallel;
use crate::real::FormatName;
use rug::Float;

/// Methods by their order: those that renderers use and textbooks have, each with another leading error.
const METHODS: [(f64, &[&str]); 4] = [
    (
        1.0,
        &[
            "front-to-back/front/expm1",
            "front-to-back/back/expm1",
            "riemann-left/riemann-left",
        ],
    ),
    (
        2.0,
        &[
            "front-to-back/middle/expm1",
            "trapezoid/trapezoid",
            "midpoint/midpoint",
        ],
    ),
    (4.0, &["simpson/simpson", "gauss-2/gauss-2"]),
    (6.0, &["boole/boole", "gauss-3/gauss-3"]),
];

/// A method on the levels of a kernel.
#[derive(Clone, Debug)]
pub(super) struct Peer {
    /// Its signed errors.
    pub(super) samples: Vec<Sample>,
    /// What they say of the order expected.
    pub(super) verdict: Verdict,
}

impl Peer {
    /// With these errors.
    ///
    /// # Errors
    /// [`FitError`], which levels of a kernel do not cause.
    pub(super) fn new(samples: Vec<Sample>, expected: Option<Expected>) -> Result<Peer, FitError> {
        let verdict = fit(&samples, expected)?.verdict;
        Ok(Peer { samples, verdict })
    }
}

/// What the methods of that order give in that format, at the kernel's levels and with its floors; nothing for an order
/// that has no method.
///
/// # Errors
/// As [`Peer::new`].
pub(super) fn of_order(
    order: f64,
    expected: Option<Expected>,
    case: &SymbolicCase,
    format: FormatName,
    exact: &Float,
    levels: &[(u64, Sample)],
) -> Result<Vec<Peer>, FitError> {
    let names = METHODS.iter().find(|(own, _)| *own == order);
    let names = names.map_or(&[][..], |(_, names)| names);
    let methods: Vec<Method> = names.iter().filter_map(|name| name.parse().ok()).collect();
    let mut peers = Vec::with_capacity(methods.len());
    for method in methods {
        let radiances = parallel::try_map(levels, |(n, _)| radiance_in(format, &method, case, *n));
        let Ok(radiances): Result<Vec<Float>, MethodError> = radiances else {
            continue;
        };
        let samples = levels
            .iter()
            .zip(radiances)
            .map(|((_, level), radiance)| Sample {
                error: Float::with_val(exact.prec(), radiance - exact),
                ..level.clone()
            });
        peers.push(Peer::new(samples.collect(), expected)?);
    }
    Ok(peers)
}

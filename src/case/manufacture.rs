//! The method of manufactured solutions: cases from a chosen depth and radiance, checked rigorously.
//!
//! With t and I given, τ = t′ and C = I′/(τ e^(−t)) make I the exact radiance. Or, with t and a polynomial
//! P ≥ 0 given, C = P(t) and I = P̃(0) − P̃(t) e^(−t), P̃ = P + P′ + P″ + …, since
//! (−P̃(t) e^(−t))′ = (P̃ − P̃′)(t) t′ e^(−t) = P(t) τ e^(−t); this cannot fail. Or everything is given, and
//! t′ = τ and I′ = C τ e^(−t) are claims. A medium alone, τ and C, is a case without a closed form.
//!
//! Whatever the way, the same statements are tested of the result, so that it does not matter whether
//! the derivation has a mistake: see [`Statement`]. What they rest on is the zero test and interval
//! arithmetic of [`symbolic`](crate::symbolic).

mod checks;
mod derive;
mod ends;
mod error;
mod lit;
mod places;
mod polynomial;
mod regularity;
mod statement;
mod structure;

pub use error::{Contradiction, ManufactureError};
pub(crate) use lit::lit;
pub use statement::{Check, Outcome, Statement};

use super::file::{ChannelDescription, Description};
use super::{Case, Formulas, SymbolicCase, Unproved};
use crate::symbolic::Expr;

/// A case that was derived or claimed, with what was checked of it.
#[derive(Clone, Debug)]
pub struct Manufactured {
    /// The channel it is; a case without channels has one without a name.
    pub channel: Option<String>,
    /// The case. Its name is the file's, with the channel's behind a slash.
    pub case: SymbolicCase,
    /// τ(s(λ)), of `lambda`.
    pub extinction: Expr,
    /// C(s(λ)), of `lambda`.
    pub emission: Expr,
    /// What was checked, in the order of [`Statement`].
    pub checks: Vec<Check>,
}

impl Manufactured {
    /// Whether t and I have a closed form, proved or not.
    #[must_use]
    pub fn has_closed_form(&self) -> bool {
        let formulas = self.case.formulas();
        formulas.optical_depth.is_some() && formulas.radiance.is_some()
    }

    /// Whether there is a closed form and it is proved: every statement but those on signs. The radiance of a
    /// medium without one is known by reference only.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        let mut needed = self.checks.iter();
        let is_proved = |check: &Check| check.outcome == Outcome::Proved;
        self.has_closed_form()
            && needed.all(|check| is_proved(check) || !check.statement.is_of_closed_form())
    }

    /// Whether every statement is proved, τ ≥ 0 and C ≥ 0 with them, as a renderer has a right to expect.
    #[must_use]
    pub fn suits_kernels(&self) -> bool {
        let mut checks = self.checks.iter();
        checks.all(|check| check.outcome == Outcome::Proved)
    }

    /// Every statement that is not proved, in the order of [`Statement`], with what became of it.
    #[must_use]
    pub fn unproved(&self) -> &[Unproved] {
        self.case.unproved()
    }

    /// Whether s, τ and C certainly have finite values everywhere, which every theorem on orders asks for.
    #[must_use]
    pub fn meets_theorems(&self) -> bool {
        let mut checks = self.checks.iter();
        checks.all(|check| {
            check.outcome == Outcome::Proved || !check.statement.is_asked_by_theorems()
        })
    }

    /// Whether C·τ is the same everywhere, so that the case cannot show an error of interpolated sources.
    #[must_use]
    pub fn is_degenerate_for_preintegration(&self) -> bool {
        self.case.structure().source_is_constant()
    }
}

/// Derives the case of each channel, and checks it.
///
/// # Errors
/// [`ManufactureError`] where a case cannot be derived, or a statement is refuted that no case can do
/// without. C < 0 is none of those: an analytic case may have it, a renderer may not.
pub fn manufacture(description: &Description) -> Result<Vec<Manufactured>, ManufactureError> {
    let channels = description.channels.iter();
    channels.map(|channel| one(description, channel)).collect()
}

fn one(
    description: &Description,
    channel: &ChannelDescription,
) -> Result<Manufactured, ManufactureError> {
    let derived = derive::derive(description, channel)?;
    let checks = checks::all(description, &derived);
    checks::refuse(&checks)?;
    let (structure, places) = structure::of(&description.length, &derived);
    let name = match &channel.name {
        Some(channel) => format!("{}/{channel}", description.name),
        None => description.name.clone(),
    };
    let formulas = Formulas {
        field: derived.field,
        extinction: derived.extinction_of_field,
        emission: derived.emission_of_field,
        optical_depth: derived.depth,
        radiance: derived.radiance,
    };
    Ok(Manufactured {
        channel: channel.name.clone(),
        case: SymbolicCase::new(&name, description.length.clone(), formulas, structure)?
            .with_break_places(places)
            .with_unproved(checks.iter().filter_map(Check::unproved).collect()),
        extinction: derived.extinction,
        emission: derived.emission,
        checks,
    })
}

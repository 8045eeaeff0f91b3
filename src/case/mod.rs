//! Cases: a field, two transfer functions, a ray length, and the exact answer.

pub mod catalogue;
mod counted;
pub mod file;
mod homogeneous_slab;
pub mod manufacture;
pub(crate) mod nodes;
pub mod random;
mod reciprocal;
mod sine_squared;
mod structure;
mod symbolic;
mod unproved;
#[cfg(feature = "studies")]
pub mod volume;

pub use counted::CountedCase;
pub use file::{ChannelDescription, Description, FileError, FileProblem, Recipe};
pub use homogeneous_slab::HomogeneousSlab;
pub use nodes::{AnyNodes, Column, Fresh, Nodes, Number, Recorded, Recording, Replayed, Shared};
pub(crate) use nodes::{Places, Rows};
pub use reciprocal::{Reciprocal, ReciprocalSquare};
pub use sine_squared::SineSquared;
pub use structure::{Along, Break, END_DERIVATIVES, PolynomialTransfer, Structure};
pub use symbolic::{Formulas, SymbolicCase};
pub use unproved::Unproved;

use crate::real::{Real, row};
use crate::symbolic::{Interval, Program};
use rug::Rational;
use std::fmt::Debug;

/// What the two transfer functions say of one field value.
#[derive(Clone, Debug, PartialEq)]
pub struct Transfer<R> {
    /// C(s), dimensionless radiance emitted per unit of optical depth.
    pub emission: R,
    /// τ(s), extinction per unit of length.
    pub extinction: R,
}

/// One ray through one medium, with its exact radiance where that has a closed form.
///
/// I(λ) = ∫₀^λ C(s(x)) τ(s(x)) exp(−t(x)) dx with t(x) = ∫₀ˣ τ(s(u)) du, for 0 ≤ λ ≤ D.
///
/// Everything is evaluated in the format of its argument; an implementation takes its constants from
/// [`Format::ratio`](crate::real::Format::ratio) and never from binary64.
pub trait Case: Debug + Send + Sync {
    /// A short name.
    fn name(&self) -> &str;

    /// D, the length of the ray.
    fn length(&self) -> Rational;

    /// s(λ).
    fn field<R: Real>(&self, lambda: &R) -> R;

    /// C(s) and τ(s), together because they often share work.
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R>;

    /// Whether [`Case::fields`] and [`Case::transfers`] are quicker than one place after the other.
    const IN_ROWS: bool = false;

    /// s at many places: the bits of [`Case::field`].
    fn fields<R: Real>(&self, lambda: &[R]) -> Vec<R> {
        row(lambda.iter().map(|lambda| self.field(lambda)))
    }

    /// C and τ at many field values: the bits of [`Case::transfer`].
    fn transfers<R: Real>(&self, s: &[R]) -> Transfer<Vec<R>> {
        let mut transfers = Transfer {
            emission: Vec::with_capacity(s.len()),
            extinction: Vec::with_capacity(s.len()),
        };
        for s in s {
            let one = self.transfer(s);
            transfers.emission.push(one.emission);
            transfers.extinction.push(one.extinction);
        }
        transfers
    }

    /// τ(s) alone.
    fn extinction<R: Real>(&self, s: &R) -> R {
        self.transfer(s).extinction
    }

    /// Which way the comparisons in s, C and τ go at λ, in a fixed order: two formats that differ here stand
    /// on different sides of a jump or a kink. Empty where nothing is compared.
    fn branches<R: Real>(&self, lambda: &R) -> Vec<bool> {
        self.transfer_branches(&self.field(lambda))
    }

    /// Which way the comparisons in C and τ go at the field value s.
    fn transfer_branches<R: Real>(&self, _s: &R) -> Vec<bool> {
        Vec::new()
    }

    /// The exact optical depth t(λ); `None`, at every λ, where no closed form is known.
    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R>;

    /// The exact radiance I(λ); `None`, at every λ, where no closed form is known.
    fn radiance<R: Real>(&self, lambda: &R) -> Option<R>;

    /// What is known of its smoothness and algebraic form.
    fn structure(&self) -> Structure;

    /// C and τ along the ray, in this order, as a program of λ; `None` where they are code and no formulas, so that
    /// nothing can be known of them between the places that they are asked at.
    fn integrand(&self) -> Option<Program> {
        None
    }

    /// t(λ) and I(λ) as programs of λ, where they have closed forms that are formulas.
    fn closed_forms(&self) -> [Option<Program>; 2] {
        [None, None]
    }

    /// Where along λ the breaks of its structure are, in their order, enclosed in about `bits` bits; `None`
    /// where that is not known.
    fn break_places(&self, bits: u32) -> Vec<Option<Interval>> {
        let length = self.length();
        let breaks = self.structure().breaks.into_iter();
        breaks
            .map(|b| Some(Interval::point(bits, &(b.part? * &length))))
            .collect()
    }
}

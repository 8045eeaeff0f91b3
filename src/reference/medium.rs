//! What a reference asks of a case, whichever it is: the integration is compiled once.

use super::Quantity;
use crate::case::{Case, Structure, Transfer};
use crate::real::{CountedReal, MpfrReal};
use crate::symbolic::{Interval, Program};
use rug::Rational;

/// A case in MPFR.
pub(super) trait Medium {
    /// D.
    fn length(&self) -> Rational;
    /// What is known of its smoothness.
    fn structure(&self) -> Structure;
    /// Where its breaks are.
    fn break_places(&self, bits: u32) -> Vec<Option<Interval>>;
    /// C and τ along the ray as a program of λ, where they are formulas.
    fn integrand(&self) -> Option<Program>;
    /// t(λ) or I(λ) as a program of λ, where its closed form is a formula.
    fn closed_form(&self, quantity: Quantity) -> Option<Program>;
    /// C and τ at λ.
    fn at(&self, lambda: &CountedReal<MpfrReal>) -> Transfer<CountedReal<MpfrReal>>;
    /// t(λ), where it has a closed form.
    fn optical_depth(&self, lambda: &MpfrReal) -> Option<MpfrReal>;
    /// I(λ), where it has a closed form.
    fn radiance(&self, lambda: &MpfrReal) -> Option<MpfrReal>;
}

impl<C: Case> Medium for C {
    fn length(&self) -> Rational {
        Case::length(self)
    }
    fn structure(&self) -> Structure {
        Case::structure(self)
    }
    fn break_places(&self, bits: u32) -> Vec<Option<Interval>> {
        Case::break_places(self, bits)
    }
    fn integrand(&self) -> Option<Program> {
        Case::integrand(self)
    }
    fn closed_form(&self, quantity: Quantity) -> Option<Program> {
        let [depth, radiance] = Case::closed_forms(self);
        match quantity {
            Quantity::Depth => depth,
            Quantity::Radiance => radiance,
        }
    }
    fn at(&self, lambda: &CountedReal<MpfrReal>) -> Transfer<CountedReal<MpfrReal>> {
        self.transfer(&self.field(lambda))
    }
    fn optical_depth(&self, lambda: &MpfrReal) -> Option<MpfrReal> {
        Case::optical_depth(self, lambda)
    }
    fn radiance(&self, lambda: &MpfrReal) -> Option<MpfrReal> {
        Case::radiance(self, lambda)
    }
}

//! The ray of a case with another emission along it: other quantities than the radiance are radiances of such rays.

use super::derive::Derived;
use super::structure;
use crate::case::{Case, Formulas, SymbolicCase};
use crate::symbolic::{CompileError, Expr};

/// The extinction of a case with that emission, of `lambda`, under another name.
///
/// The field is λ itself, since the emission need be no function of the case's field. The optical depth keeps its closed
/// form; the radiance has none. Nothing is checked that was not checked of the case.
///
/// # Errors
/// [`CompileError`] where the emission has another symbol.
pub(crate) fn lit(
    case: &SymbolicCase,
    name: &str,
    emission: &Expr,
) -> Result<SymbolicCase, CompileError> {
    let of = case.formulas();
    let extinction = of.extinction.substitute("s", &of.field);
    let (lambda, field) = (Expr::symbol("lambda"), Expr::symbol("s"));
    let derived = Derived {
        extinction_of_field: extinction.substitute("lambda", &field),
        emission_of_field: emission.substitute("lambda", &field),
        extinction,
        emission: emission.clone(),
        inverse: None,
        depth: of.optical_depth.clone(),
        radiance: None,
        emission_of_depth: None,
        field: lambda,
    };
    let length = case.length();
    let (structure, places) = structure::of(&length, &derived);
    let formulas = Formulas {
        field: derived.field,
        extinction: derived.extinction_of_field,
        emission: derived.emission_of_field,
        optical_depth: derived.depth,
        radiance: None,
    };
    Ok(SymbolicCase::new(name, length, formulas, structure)?
        .with_break_places(places)
        .with_unproved(case.unproved().to_vec()))
}

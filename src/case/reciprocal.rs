//! The case of the paper's Table 2, and the one like it whose source term is not constant.

use super::symbolic::program_of;
use super::{Case, PolynomialTransfer, Structure, Transfer};
use crate::real::{Format, Real};
use crate::symbolic::Program;
use rug::Rational;

/// s = 1/(1+λ), τ = s, C = 1/s on [0, 1]; t(λ) = I(λ) = ln(1 + λ).
///
/// Its source term C·τ = 1 is constant, which makes it degenerate for pre-integration.
///
/// Source: Etiene, Kirby and Silva (2013), section 4. The closed form is proved in `proofs/theory/Cases.v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reciprocal;

/// s = 1/(1+λ), τ = s, C = s on [0, 1]; t(λ) = ln(1 + λ), I(λ) = (1 − (1+λ)⁻²)/2.
///
/// Here C·τ = s² varies, so that errors of the interpolated source show. The closed form is proved in
/// `proofs/theory/Cases.v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReciprocalSquare;

fn reciprocal_field<R: Real>(lambda: &R) -> R {
    let one = lambda.format().int(1);
    let mut denominator = one.clone();
    denominator += lambda;
    one / &denominator
}

fn powers(extinction: &[i32], source: &[i32]) -> PolynomialTransfer {
    let rationals = |c: &[i32]| c.iter().map(|&k| Rational::from(k)).collect();
    PolynomialTransfer {
        extinction: rationals(extinction),
        source: rationals(source),
    }
}

impl Case for Reciprocal {
    fn name(&self) -> &'static str {
        "reciprocal"
    }

    fn length(&self) -> Rational {
        Rational::from(1)
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        reciprocal_field(lambda)
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        Transfer {
            emission: s.format().int(1) / s,
            extinction: s.clone(),
        }
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(lambda.clone().ln_1p())
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(lambda.clone().ln_1p())
    }

    fn integrand(&self) -> Option<Program> {
        program_of(&["1 + lambda", "1/(1 + lambda)"])
    }

    fn closed_forms(&self) -> [Option<Program>; 2] {
        [
            program_of(&["ln(1 + lambda)"]),
            program_of(&["ln(1 + lambda)"]),
        ]
    }

    fn structure(&self) -> Structure {
        Structure {
            field_degree: None,
            transfer: Some(powers(&[0, 1], &[1])),
            ..Structure::default()
        }
    }
}

impl Case for ReciprocalSquare {
    fn name(&self) -> &'static str {
        "reciprocal-square"
    }

    fn length(&self) -> Rational {
        Rational::from(1)
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        reciprocal_field(lambda)
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        Transfer {
            emission: s.clone(),
            extinction: s.clone(),
        }
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(lambda.clone().ln_1p())
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        // (1 − s²)/2 = (1 − s)(1 + s)/2 = λ s (1 + s)/2, without cancellation at small λ.
        let format = lambda.format();
        let s = reciprocal_field(lambda);
        let mut sum = format.int(1);
        sum += &s;
        Some(s * lambda * &sum / &format.int(2))
    }

    fn integrand(&self) -> Option<Program> {
        program_of(&["1/(1 + lambda)", "1/(1 + lambda)"])
    }

    fn closed_forms(&self) -> [Option<Program>; 2] {
        [
            program_of(&["ln(1 + lambda)"]),
            program_of(&["(1 - (1 + lambda)^(-2))/2"]),
        ]
    }

    fn structure(&self) -> Structure {
        Structure {
            field_degree: None,
            transfer: Some(powers(&[0, 1], &[0, 0, 1])),
            ..Structure::default()
        }
    }
}

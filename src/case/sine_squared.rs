//! The case of the paper's Table 1.

use super::symbolic::program_of;
use super::{Case, Structure, Transfer};
use crate::real::{Format, Real};
use crate::symbolic::Program;
use rug::Rational;

/// s = λ, C = sin s², τ = s cos s² on [0, 1]; t(λ) = sin(λ²)/2 and
/// I(λ) = 2 − (sin λ² + 2) exp(−sin(λ²)/2).
///
/// Source: Etiene, Kirby and Silva (2013), section 3. The closed form is proved in `proofs/theory/Cases.v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SineSquared;

impl Case for SineSquared {
    fn name(&self) -> &'static str {
        "sine-squared"
    }

    fn length(&self) -> Rational {
        Rational::from(1)
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let (sin, cos) = (s.clone() * s).sin_cos();
        Transfer {
            emission: sin,
            extinction: cos * s,
        }
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        let (sin, _) = (lambda.clone() * lambda).sin_cos();
        Some(sin / &lambda.format().int(2))
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        let two = lambda.format().int(2);
        let (sin, _) = (lambda.clone() * lambda).sin_cos();
        let transmittance = (-(sin.clone() / &two)).exp();
        // 2 (1 − T) − sin λ² T: the first difference without its cancellation at small λ.
        let opacity = -(-(sin.clone() / &two)).exp_m1();
        Some(opacity * &two - &(sin * &transmittance))
    }

    fn integrand(&self) -> Option<Program> {
        program_of(&["sin(lambda^2)", "lambda*cos(lambda^2)"])
    }

    fn closed_forms(&self) -> [Option<Program>; 2] {
        [
            program_of(&["sin(lambda^2)/2"]),
            program_of(&["2 - (sin(lambda^2) + 2)*exp(-sin(lambda^2)/2)"]),
        ]
    }

    fn structure(&self) -> Structure {
        Structure {
            field_degree: Some(1),
            transfer: None,
            ..Structure::default()
        }
    }
}

//! The medium that is the same everywhere.

use super::{Case, PolynomialTransfer, Structure, Transfer};
use crate::real::{Format, Real};
use crate::symbolic::{Expr, Program};
use rug::Rational;

/// τ = κ and C = c on [0, D] whatever the field (here s = 1); t(λ) = κλ, I(λ) = c (1 − exp(−κλ)).
///
/// Source: Max (1995), equation 5. The closed form is proved in `proofs/theory/Cases.v`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HomogeneousSlab {
    /// D > 0.
    pub length: Rational,
    /// κ ≥ 0, per unit of length.
    pub extinction: Rational,
    /// c.
    pub emission: Rational,
}

impl Case for HomogeneousSlab {
    fn name(&self) -> &'static str {
        "homogeneous-slab"
    }

    fn length(&self) -> Rational {
        self.length.clone()
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.format().int(1)
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let format = s.format();
        Transfer {
            emission: format.ratio(&self.emission),
            extinction: format.ratio(&self.extinction),
        }
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(lambda.format().ratio(&self.extinction) * lambda)
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        let depth = self.optical_depth(lambda)?;
        let opacity = -(-depth).exp_m1();
        Some(opacity * &lambda.format().ratio(&self.emission))
    }

    fn integrand(&self) -> Option<Program> {
        let values = [&self.emission, &self.extinction];
        Program::new(&values.map(|q| Expr::from(q.clone())), &["lambda"]).ok()
    }

    fn closed_forms(&self) -> [Option<Program>; 2] {
        let depth = Expr::from(self.extinction.clone()) * Expr::symbol("lambda");
        let opacity = Expr::from(1) - (-&depth).exp();
        let radiance = Expr::from(self.emission.clone()) * opacity;
        [depth, radiance].map(|formula| Program::new(&[formula], &["lambda"]).ok())
    }

    fn structure(&self) -> Structure {
        Structure {
            field_degree: Some(0),
            transfer: Some(PolynomialTransfer {
                extinction: vec![self.extinction.clone()],
                source: vec![Rational::from(&self.extinction * &self.emission)],
            }),
            ..Structure::default()
        }
    }
}

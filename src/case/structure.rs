//! What theory needs to know of a case to say which order a method shows on it.

use rug::Rational;

/// Transfer functions that are polynomials in the field value: coefficient k belongs to sᵏ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PolynomialTransfer {
    /// τ(s).
    pub extinction: Vec<Rational>,
    /// The source term C(s)·τ(s).
    pub source: Vec<Rational>,
}

/// The algebraic form of a case, as far as it is known. Theory takes every case to be
/// analytic on [0, D]: on one that is not, a method may show less than its expected order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// The degree of s(λ), where the field is a polynomial.
    pub field_degree: Option<usize>,
    /// τ(s) and C(s)·τ(s), where both are polynomials.
    pub transfer: Option<PolynomialTransfer>,
}

impl Structure {
    /// The degree of τ(s(λ)) in λ, where that is a polynomial.
    #[must_use]
    pub fn extinction_degree(&self) -> Option<usize> {
        match self.field_degree {
            Some(field) => self.extinction_degree_of(field),
            // τ may still be constant, whatever the field.
            None => self.extinction_degree_of(1).filter(|&d| d == 0),
        }
    }

    /// The degree of τ(s) where s is a polynomial of degree `field`, if τ is a polynomial or s constant.
    #[must_use]
    pub fn extinction_degree_of(&self, field: usize) -> Option<usize> {
        match &self.transfer {
            Some(transfer) => Some(degree(&transfer.extinction) * field),
            None => Some(0).filter(|_| field == 0),
        }
    }

    /// Whether C·τ is 0 everywhere: then so is the radiance, by every method. `false` also where it is
    /// unknown.
    #[must_use]
    pub fn source_is_zero(&self) -> bool {
        self.transfer
            .as_ref()
            .is_some_and(|transfer| transfer.source.iter().all(|c| *c == 0))
    }

    /// Whether C·τ is the same everywhere: then an interpolation error of the field cannot show in
    /// the source term. `false` also where it is unknown.
    #[must_use]
    pub fn source_is_constant(&self) -> bool {
        self.field_degree == Some(0)
            || self
                .transfer
                .as_ref()
                .is_some_and(|transfer| degree(&transfer.source) == 0)
    }
}

/// The degree of a polynomial, 0 for a constant and for no coefficients at all.
fn degree(coefficients: &[Rational]) -> usize {
    coefficients.iter().rposition(|c| *c != 0).unwrap_or(0)
}

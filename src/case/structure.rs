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

/// A place of the ray where τ or C·τ is not analytic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Break {
    /// The place as a part of D, where that is rational.
    pub part: Option<Rational>,
    /// The power α of the strongest |λ − b|^α in τ at the place b: 0 for a jump, 1 for a kink; `None`
    /// where τ is analytic.
    pub extinction: Option<Rational>,
    /// The same of C·τ.
    pub source: Option<Rational>,
}

impl Break {
    /// The power of C·τ·e^(−t), the strongest of C·τ and of t, which is smoother than τ by one.
    #[must_use]
    pub fn under_transmittance(&self) -> Option<Rational> {
        let of_depth = self
            .extinction
            .as_ref()
            .map(|power| Rational::from(power + 1));
        match (self.source.clone(), of_depth) {
            (Some(source), Some(depth)) => Some(source.min(depth)),
            (source, depth) => source.or(depth),
        }
    }
}

/// The algebraic form of a case, as far as it is known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// The degree of s(λ), where the field is a polynomial.
    pub field_degree: Option<usize>,
    /// τ(s) and C(s)·τ(s), where both are polynomials.
    pub transfer: Option<PolynomialTransfer>,
    /// What is known of τ and C·τ as functions of λ beyond what follows from the field and `transfer`.
    pub along: Along,
    /// Where the case is not analytic on [0, D]; everywhere else it is.
    pub breaks: Vec<Break>,
}

/// How many derivatives of C τ e^(−t) are compared at the ends of the ray: what limits rules up to order 8.
pub const END_DERIVATIVES: usize = 8;

/// What is known of τ and C·τ along the ray. The default is to know nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
// Facts that do not depend on each other.
#[allow(clippy::struct_excessive_bools)]
pub struct Along {
    /// The degree of τ in λ, where that is a polynomial.
    pub extinction_degree: Option<usize>,
    /// C·τ is certainly the same everywhere.
    pub source_is_constant: bool,
    /// C·τ is certainly 0 everywhere.
    pub source_is_zero: bool,
    /// A parabola through both ends and the middle of each segment certainly makes no error of order 4 in
    /// the source term, wherever it is: with w = d(C τ)/ds e^(−t) it makes d⁴/2880 ∫ (w s⁗ + 4 w′ s‴).
    pub parabolas_hide_source: bool,
    /// C is certainly the same everywhere.
    pub emission_is_constant: bool,
    /// C is certainly above 0 everywhere, or below it.
    pub emission_has_no_zero: bool,
    /// On a ray that is analytic throughout certainly C τ at the front, less C τ e^(−t) at the far end, is τ at the
    /// front times the radiance: what one sample at an end of each segment errs by in the first order is
    /// proportional to the difference.
    pub end_samples_cancel: bool,
    /// Whether derivative k of C τ e^(−t) is certainly the same at both ends of a ray that is analytic
    /// throughout: by the Euler–Maclaurin formula a rule's error of order k + 1 is proportional to the
    /// difference.
    pub equal_at_ends: [bool; END_DERIVATIVES],
}

impl Structure {
    /// The degree of τ(s(λ)) in λ, where that is a polynomial.
    #[must_use]
    pub fn extinction_degree(&self) -> Option<usize> {
        if self.along.extinction_degree.is_some() {
            return self.along.extinction_degree;
        }
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
            // What is constant along the ray is so whatever stands in for the field; or the field is.
            None => Some(0).filter(|_| field == 0 || self.along.extinction_degree == Some(0)),
        }
    }

    /// Whether derivative `k` of C τ e^(−t) is certainly the same at both ends of the ray.
    #[must_use]
    pub fn is_equal_at_ends(&self, k: usize) -> bool {
        self.along.equal_at_ends.get(k).is_some_and(|equal| *equal)
    }

    /// Whether C·τ is 0 everywhere: then so is the radiance, by every method. `false` also where it is
    /// unknown.
    #[must_use]
    pub fn source_is_zero(&self) -> bool {
        let by_transfer = self.transfer.as_ref();
        self.along.source_is_zero
            || by_transfer.is_some_and(|transfer| transfer.source.iter().all(|c| *c == 0))
    }

    /// Whether C·τ is the same everywhere: then an interpolation error of the field cannot show in
    /// the source term. `false` also where it is unknown.
    #[must_use]
    pub fn source_is_constant(&self) -> bool {
        self.field_degree == Some(0)
            || self.along.source_is_constant
            || self
                .transfer
                .as_ref()
                .is_some_and(|transfer| degree(&transfer.source) == 0)
    }

    /// Whether C is the same everywhere. `false` also where it is unknown.
    #[must_use]
    pub fn emission_is_constant(&self) -> bool {
        let is_multiple = |transfer: &PolynomialTransfer| {
            let PolynomialTransfer { extinction, source } = transfer;
            let leading = degree(extinction);
            let Some(top) = extinction.get(leading).filter(|top| **top != 0) else {
                return false;
            };
            let zero = Rational::new();
            let of = |k: usize| source.get(k).unwrap_or(&zero);
            let terms = extinction.iter().enumerate();
            degree(source) <= leading
                && terms
                    .into_iter()
                    .all(|(k, c)| Rational::from(of(k) * top) == Rational::from(of(leading) * c))
        };
        self.field_degree == Some(0)
            || self.along.emission_is_constant
            || (self.extinction_degree() == Some(0) && self.source_is_constant())
            || self.transfer.as_ref().is_some_and(is_multiple)
    }
}

/// The degree of a polynomial, 0 for a constant and for no coefficients at all.
fn degree(coefficients: &[Rational]) -> usize {
    coefficients.iter().rposition(|c| *c != 0).unwrap_or(0)
}

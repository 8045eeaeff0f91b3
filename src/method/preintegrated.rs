//! Pre-integration: each segment's emission and opacity integrated along an interpolated field.

mod color;
mod integration;
mod interpolant;
mod opacity;
mod polynomial;
mod series;

pub use color::Color;
pub use integration::Integration;
pub use interpolant::{Interpolant, LastSegment};
pub use opacity::Opacity;
pub use series::attenuated_integral;

use super::{Limit, MethodError, Part};
use crate::case::{Nodes, Number, Structure};
use crate::real::{Format, Real};
use std::fmt;

/// Pre-integrated volume rendering: I ≈ Σᵢ C̃ᵢ ∏_{j<i} α̃ⱼ with
/// α̃ = exp(−∫ τ(s̄)) and C̃ = ∫ C(s̄) τ(s̄) exp(−∫ τ(s̄)) over a segment, s̄ interpolating the field.
///
/// Source: Etiene, Kirby and Silva (2013), section 4, equations 23 to 31; Engel, Kraus and Ertl (2001);
/// El Hajjar et al. (2008).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Preintegrated {
    /// How C̃ is computed.
    pub color: Color,
    /// How α̃ is computed.
    pub opacity: Opacity,
}

impl Preintegrated {
    /// The radiance on n segments.
    ///
    /// # Errors
    /// [`MethodError::Segments`] or [`MethodError::TooFewSegments`] where n does not suit the interpolant, [`MethodError::NoClosedForm`]
    /// where a closed form is asked for and the transfer functions are not polynomials.
    pub fn radiance<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Number<N>, MethodError> {
        let colors = self.color.segments(nodes, n)?;
        let transmittances = self.opacity.segments(nodes, n)?;
        Ok(composite(nodes.format(), &colors, &transmittances))
    }

    /// What limits the order on a case of that structure.
    ///
    /// An interpolant of order m and degree k leaves O(dᵐ) in the source and in the opacity, and
    /// O(d^(k+2)) in the attenuation inside a segment; N sub-intervals of a rule of order r leave O(dʳ)
    /// for fixed N; neglecting the attenuation inside leaves O(d). Where C·τ is constant the source
    /// has no interpolation error.
    ///
    /// Breaks: where the interpolant is the field itself, they limit the sub-intervals' rule as any rule.
    /// Where it is not, an interpolated break lies elsewhere than the true one, by an unknown distance if the
    /// field is flat there, and a structure does not tell a broken field from a broken transfer
    /// function: the order is unknown.
    #[must_use]
    pub fn limits(&self, structure: &Structure) -> Vec<Limit> {
        self.limits_at(structure, None)
    }

    /// What limits the order on these numbers of segments, where each break has its known place.
    #[must_use]
    pub fn limits_on(&self, structure: &Structure, ladder: &[u64]) -> Vec<Limit> {
        self.limits_at(structure, Some(ladder))
    }

    fn limits_at(&self, structure: &Structure, ladder: Option<&[u64]>) -> Vec<Limit> {
        if structure.source_is_zero() {
            return Vec::new();
        }
        let mut limits = self.color.limits(structure);
        limits.extend(self.opacity.limits(structure));
        for place in &structure.breaks {
            let color = self.color.allowed_by(structure, place, ladder);
            limits.extend(color.limit(Part::SourceBreak));
            let opacity = self.opacity.allowed_by(structure, place, ladder);
            limits.extend(opacity.limit(Part::ExtinctionBreak));
        }
        limits
    }
}

impl fmt::Display for Preintegrated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "preintegrated {} × {}", self.color, self.opacity)
    }
}

/// Σᵢ Cᵢ ∏_{j<i} αⱼ, front to back.
pub fn composite<R: Real>(format: R::Format, colors: &[R], transmittances: &[R]) -> R {
    let mut radiance = format.int(0);
    let mut transmittance = format.int(1);
    for (color, segment) in colors.iter().zip(transmittances) {
        radiance += &(transmittance.clone() * color);
        transmittance *= segment;
    }
    radiance
}

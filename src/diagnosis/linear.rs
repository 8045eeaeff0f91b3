//! Segments in which C and τ are linear, integrated as exactly as the format holds.

use crate::case::Transfer;
use crate::quadrature::Rule;
use crate::real::{Format, Real};

/// Bits of a result that one Gauss–Legendre point is good for, in segments of an optical depth that
/// renderers meet (up to about 20).
const BITS_A_POINT: u32 = 3;

/// Gauss–Legendre points for ∫ C τ e^(−t) over one segment: the integrand is an entire function, so that its
/// error falls faster than any power.
pub struct LinearSegments<R> {
    /// (x, w, x²/2) on the unit interval.
    points: Vec<(R, R, R)>,
    half: R,
}

impl<R: Real> LinearSegments<R> {
    /// For numbers of that format.
    #[must_use]
    pub fn new(format: R::Format) -> Self {
        Self::with_points(format, (format.bits() / BITS_A_POINT).clamp(8, 100))
    }

    /// With that many points, 1 to 100: N of them leave x^(2N)/(4^N (2N)!) of a segment of optical depth x.
    #[must_use]
    pub fn with_points(format: R::Format, count: u32) -> Self {
        let bits = format.bits();
        let half = format.fraction(1, 2);
        let points = match Rule::GaussLegendre(count).table(bits) {
            Ok(table) => {
                let points = table.nodes.iter().zip(&table.weights);
                let points = points.map(|(x, w)| {
                    let x = format.ratio(x);
                    let square = x.clone() * &x * &half;
                    (x, format.ratio(w), square)
                });
                points.collect()
            }
            // Of 8 to 100 points there is a table.
            Err(_) => Vec::new(),
        };
        LinearSegments { points, half }
    }

    /// (∫₀ʰ C τ e^(−t) dx, e^(−t(h))) with C and τ linear from `near` to `far`.
    pub fn segment(&self, near: &Transfer<R>, far: &Transfer<R>, length: &R) -> (R, R) {
        let slope = |near: &R, far: &R| far.clone() - near;
        let of_extinction = slope(&near.extinction, &far.extinction);
        let of_emission = slope(&near.emission, &far.emission);
        let mut sum = near.extinction.format().int(0);
        for (x, weight, half_square) in &self.points {
            let extinction = of_extinction.clone() * x + &near.extinction;
            let emission = of_emission.clone() * x + &near.emission;
            let depth = near.extinction.clone() * x + &(of_extinction.clone() * half_square);
            let light = (-(depth * length)).exp() * &extinction * &emission;
            sum += &(light * weight);
        }
        let whole = (near.extinction.clone() + &far.extinction) * &self.half * length;
        (sum * length, (-whole).exp())
    }
}

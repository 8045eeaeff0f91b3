//! The light of a stretch by each model.

use super::Model;
use crate::case::Transfer;
use crate::method::{MethodError, attenuated_integral};
use crate::quadrature::Collocation;
use crate::real::{Format, Real};
use std::any::Any;

/// What a stretch does to light from behind: x becomes E + e^(−t) x.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Light<R> {
    /// E.
    pub(super) radiance: R,
    /// t.
    pub(super) depth: R,
}

impl<R: Real> Light<R> {
    /// Of an empty stretch.
    pub(super) fn none(format: R::Format) -> Self {
        Light {
            radiance: format.int(0),
            depth: format.int(0),
        }
    }

    /// E = C (1 − e^(−t)).
    pub(super) fn of_constant_emission(emission: &R, depth: R) -> Self {
        let opacity = -(-depth.clone()).exp_m1();
        Light {
            radiance: opacity * emission,
            depth,
        }
    }

    /// C and τ linear over a length.
    ///
    /// Nothing is seen of what lies behind a depth of [`opaque`]: there the integral ends.
    ///
    /// # Errors
    /// [`MethodError::ThickSegment`] where the numbers are beyond the format's range.
    pub(super) fn linear(
        front: &Transfer<R>,
        back: &Transfer<R>,
        length: &R,
    ) -> Result<Self, MethodError> {
        let format = length.format();
        let half = format.fraction(1, 2);
        let slope = back.extinction.clone() - &front.extinction;
        let rise = back.emission.clone() - &front.emission;
        // C τ h as a polynomial on [0, 1].
        let mut source = [
            front.emission.clone() * &front.extinction * length,
            (rise.clone() * &front.extinction + &(front.emission.clone() * &slope)) * length,
            rise * &slope * length,
        ];
        let mut depth = [front.extinction.clone() * length, slope * length * &half];
        let whole = depth[0].clone() + &depth[1];
        let seen = format.int(opaque(format.bits()));
        if whole > seen {
            let part = part_of_depth(&depth, seen);
            let mut power = part.clone();
            for (k, coefficient) in source.iter_mut().enumerate() {
                *coefficient *= &power;
                if let Some(depth) = depth.get_mut(k) {
                    *depth *= &power;
                }
                power *= &part;
            }
        }
        Ok(Light {
            radiance: attenuated_integral(&source, &depth)?,
            depth: whole,
        })
    }
}

/// The depth behind which light is below 2^(−32) units in the last place of that in front, and below any
/// tolerance. Three times it is no segment too thick for the closed form.
pub(super) fn opaque(bits: u32) -> i64 {
    const OF_EVERY_TOLERANCE: i64 = 1 << 14;
    // ln 2 is below 7/10.
    let of_format = (i64::from(bits) + 32) * 7 / 10 + 1;
    of_format.min(OF_EVERY_TOLERANCE)
}

/// Where on [0, 1] t = a x + b x² has that value, which is less than at 1; t never falls.
///
/// x = 2 t/(a + √(a² + 4 b t)), all divided by the larger of a and √(4 |b| t), whose squares may be no numbers.
fn part_of_depth<R: Real>([a, b]: &[R; 2], depth: R) -> R {
    let format = depth.format();
    let twice = format.int(2) * &depth;
    let bend = b.clone().abs().sqrt() * &(format.int(2) * &depth.sqrt());
    let unit = if *a > bend { a.clone() } else { bend.clone() };
    let (straight, bent) = (a.clone() / &unit, bend / &unit);
    let mut square = straight.clone() * &straight;
    if *b < format.int(0) {
        square -= &(bent.clone() * &bent);
    } else {
        square += &(bent.clone() * &bent);
    }
    // Rounding alone makes it negative, where t has its largest value.
    let root = if square > format.int(0) {
        square.sqrt()
    } else {
        format.int(0)
    };
    twice / &unit / &(straight + &root)
}

/// The sums that a rule makes of C and τ at its points.
pub(super) struct Sums<R> {
    /// ∑ w τ.
    pub(super) depth: R,
    /// ∑ w C τ.
    pub(super) source: R,
}

/// ∑ w τ and ∑ w C τ over a length.
pub(super) fn sums<R: Real>(
    emission: &[R],
    extinction: &[R],
    table: &Collocation<R>,
    length: &R,
) -> Sums<R> {
    let zero = || length.format().int(0);
    let (mut depth, mut source) = (zero(), zero());
    for ((c, tau), weight) in emission.iter().zip(extinction).zip(&table.weights) {
        let weighted = tau.clone() * weight;
        depth += &weighted;
        source += &(weighted * c);
    }
    Sums {
        depth: depth * length,
        source: source * length,
    }
}

/// ∑ w C τ e^(−t) with t of the polynomial through τ.
pub(super) fn attenuated<R: Real>(
    emission: &[R],
    extinction: &[R],
    table: &Collocation<R>,
    length: &R,
) -> R {
    let format = length.format();
    let mut radiance = format.int(0);
    for (j, row) in table.integrals.iter().enumerate() {
        let mut depth = format.int(0);
        for (a, tau) in row.iter().zip(extinction) {
            depth += &(tau.clone() * a);
        }
        let transmittance = (-(depth * length)).exp();
        radiance += &(transmittance * &emission[j] * &extinction[j] * &table.weights[j]);
    }
    radiance * length
}

/// The light by a model of points.
pub(super) fn by_points<R: Real>(
    model: Model,
    emission: &[R],
    extinction: &[R],
    table: &Collocation<R>,
    length: &R,
) -> Light<R> {
    let format = length.format();
    let Sums { depth, source } = sums(emission, extinction, table, length);
    match model {
        Model::EmissionOnly { .. } => Light {
            radiance: source,
            depth: format.int(0),
        },
        Model::AbsorptionOnly { .. } => Light {
            radiance: format.int(0),
            depth,
        },
        Model::ConstantEmission { .. } => match emission.first() {
            Some(emission) => Light::of_constant_emission(emission, depth),
            None => Light::none(format),
        },
        _ => Light {
            radiance: attenuated(emission, extinction, table, length),
            depth,
        },
    }
}

/// |x| in binary64, for bounds; of a number below its range 0.
pub(super) fn size<R: Real>(x: &R) -> f64 {
    // The planner looks at thousands of differences, most of them in binary64.
    match (x as &dyn Any).downcast_ref::<f64>() {
        Some(x) => x.abs(),
        None => x.log2_abs().exp2(),
    }
}

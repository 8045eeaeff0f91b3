//! What of an error is not the kernel's: its rounding, and what is left by what is not refined.

use super::allowance::Allowance;
use super::sampled::{at, cancelling, radiance};
use super::{Asked, Level, Wanted};
use crate::identify::rule::{Place, Rule};
use crate::identify::stated;
use crate::kernel::{Cut, Quantity, Sampling};
use crate::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use crate::quadrature;
use crate::real::Native;
use crate::study::verify::nominal::{Given, Nominal};
use crate::study::verify::{Axis, GRID_SEGMENTS, VerifyError, truth};
use rug::Float;

/// No floor passes for more than this part of what the answer is made of: with the margin of fits, 23 % off is seen.
const VISIBLE: f64 = 1.0 / 128.0;

impl Asked<'_> {
    /// What of an error may be rounding: that of the declared method where there is one, measured; else of as many terms as
    /// there are segments, of the size of the answer, or of what cancels in it.
    pub(super) fn floor(
        &self,
        wanted: &Wanted,
        exact: &Float,
        level: &Level,
        declared: Option<&Nominal>,
        given: &Given<'_>,
        allowance: Allowance,
    ) -> Float {
        let bits = exact.prec();
        let mut scale = Float::with_val(bits, exact.abs_ref());
        if let Some(terms) = cancelling(given.segments, given.step, given.channel) {
            scale = scale.max(&Float::with_val(bits, terms));
        }
        if let Some(unit) = self.unit(wanted, given) {
            scale = scale.max(&Float::with_val(bits, unit));
        }
        // By its exponent: binary64 has no unit of so many bits as MPFR may have.
        let mut floor = scale.clone() >> self.declaration.format.bits();
        if let Some(Nominal {
            exact, in_format, ..
        }) = declared
        {
            let rounding = Float::with_val(bits, in_format - exact).abs();
            // Not where the format has no number for it.
            if rounding.is_finite() && rounding > floor {
                floor = rounding;
            }
        } else {
            // Roundings of as many segments, by chance up and down; but an answer that is all rounding is no answer.
            floor *= (level.count as f64).sqrt();
            floor = floor.min(&Float::with_val(bits, &scale * VISIBLE));
        }
        // Nor is one that is all errors of functions, however bad they are said to be.
        floor += Float::with_val(bits, allowance.functions).min(&(scale * VISIBLE));
        floor + allowance.chance + allowance.stored
    }

    /// What the rounding of another quantity than a radiance is at least measured by: 1 − T and −ln T are known to a unit of
    /// 1, and with them what is weighted by them.
    fn unit(&self, wanted: &Wanted, given: &Given<'_>) -> Option<f64> {
        let length = self.subject.length().to_f64();
        match wanted.quantity {
            // The emission is a sum of what is given.
            Quantity::Radiance | Quantity::Emission => None,
            Quantity::Opacity | Quantity::OpticalDepth => Some(1.0),
            Quantity::ExpectedDepth if wanted.is_divided() => {
                let composed =
                    at(Place::Middle).composed(given.segments, given.step, Native::<f64>::new());
                Some(length / (1.0 - composed.passes)).filter(|unit| unit.is_finite())
            }
            Quantity::ExpectedDepth => Some(length),
        }
    }

    /// What the step leaves of an error while the grid is refined: not what this kernel shows, which may be wrong,
    /// but what one does that samples as it says.
    pub(super) fn not_refined(&self, level: &Level, given: &Given<'_>) -> Result<f64, VerifyError> {
        let (Axis::Grid, Some(volume)) = (self.settings.axis, &level.volume) else {
            return Ok(0.0);
        };
        let rule = self.declaration.method.as_ref().and_then(stated);
        let rule = rule.unwrap_or_else(|| {
            match (self.declaration.sampling, self.declaration.order) {
                (Some(Sampling::Middle), _) => at(Place::Middle),
                (Some(Sampling::Ends), _) => trapezoids(),
                (Some(Sampling::Back), _) => at(Place::Back),
                (None, Some(order)) if order > 1.0 => at(Place::Middle),
                // Of nobody knows which, the one that leaves most.
                (Some(Sampling::Front | Sampling::Jittered) | None, _) => at(Place::Front),
            }
        });
        let sampled = radiance(&rule, given.segments, given.step, given.channel);
        let bits = f64::MANTISSA_DIGITS;
        let wanted = Wanted::radiance(self.subject, given.channel)?;
        let whole = truth::of_volume(volume, self.subject.length(), &wanted, bits);
        Ok((sampled - whole.to_f64()).abs())
    }

    /// What tables leave of an error, however fine the grid; 0 where the step is refined, which leads to the
    /// radiance of the tables themselves.
    pub(super) fn of_tables(&self, channel: usize) -> Result<f64, VerifyError> {
        let finest = self.levels.last().and_then(|level| level.volume.as_ref());
        let (Axis::Grid, Some(volume)) = (self.settings.axis, finest) else {
            return Ok(0.0);
        };
        let exact = self.subject.segments(Cut::Segments(GRID_SEGMENTS));
        let exact = exact.map_err(|error| self.cut_error(error))?;
        let mut tabled = exact.clone();
        let mut emission = vec![0.0; self.subject.channels().len()];
        for (index, lambda) in exact.middles.lambda.iter().enumerate() {
            let s = self.subject.field(*lambda);
            tabled.middles.extinction[index] = volume.table.at(s, &mut emission);
            tabled.middles.emission[channel][index] = emission[channel];
        }
        let step = self.subject.length().to_f64() / GRID_SEGMENTS as f64;
        let of = |segments| radiance(&at(Place::Middle), segments, step, channel);
        Ok((of(&tabled) - of(&exact)).abs())
    }
}

/// Trapezoid rules for depth and radiance.
fn trapezoids() -> Rule {
    let method = Method::Nested(Nested {
        inner: Inner::PerSegment(quadrature::Rule::Trapezoid),
        outer: Outer(quadrature::Rule::Trapezoid),
        exponential: Exponential::Exact,
        scope: Scope::PerSegment,
    });
    // It looks at both ends of every segment: there is one.
    stated(&method).unwrap_or_default()
}

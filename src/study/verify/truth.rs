//! The radiance that a kernel should give.

use super::VerifyError;
use crate::case::{Case, SymbolicCase, Transfer, Unproved};
use crate::identify::rule::LinearSegments;
use crate::kernel::Volume;
use crate::real::{Format, Mpfr, MpfrReal, Real};
use crate::reference;
use rug::{Float, Rational};

/// How far in front of the end of a ray, as a part of it, its last samples are still looked for.
const LAST_SAMPLE: (u32, u32) = (1, 10_000);

/// The length that renderers give the last segment to make a wall of it: what absorbs nothing stays clear.
const WALL_LENGTH: i64 = 10_000_000_000;

/// The radiance of one channel of a case, with what stands at the end of the ray.
///
/// I + T(D) C(s(D)) where there is a far wall, and something in front of it that absorbs. With it what is not proved of
/// either.
pub(super) fn of_case(
    case: &SymbolicCase,
    bits: u32,
    far_wall: bool,
) -> Result<(Float, Vec<Unproved>), VerifyError> {
    let failed = |error| VerifyError::Reference {
        case: case.name().into(),
        error,
    };
    let found = reference::radiance(case, bits).map_err(failed)?;
    let unproved = found.unproved(case);
    let mut radiance = found.value;
    if far_wall {
        let depth = reference::optical_depth(case, bits).map_err(failed)?.value;
        let format = Mpfr {
            bits: radiance.prec(),
        };
        let length = case.length();
        let wall = case.transfer(&case.field(&format.ratio(&length)));
        // The last sample lies just in front of the end, where a medium may vanish.
        let before = length - case.length() * Rational::from(LAST_SAMPLE);
        let extinction = case.extinction(&case.field(&format.ratio(&before)));
        let opacity = -(-(extinction * &format.int(WALL_LENGTH))).exp_m1();
        radiance += (-depth).exp() * (wall.emission * &opacity).to_float();
    }
    Ok((radiance, unproved))
}

/// The exact radiance of one channel of the medium that a volume stands for: the sum over stretches in which C
/// and τ are linear.
pub(super) fn of_volume(volume: &Volume, length: &Rational, channel: usize, bits: u32) -> Float {
    let format = Mpfr { bits };
    // What is no number stays none: it must not pass for a medium that is empty.
    let exact = |x: f64| format.binary64(x);
    let mut emission = vec![0.0; volume.table.emission.len()];
    let mut at = |part: f64| {
        let extinction = volume.table.at(volume.field_at(part), &mut emission);
        Transfer {
            extinction: exact(extinction),
            emission: exact(emission.get(channel).copied().unwrap_or(f64::NAN)),
        }
    };
    let rule = LinearSegments::new(format);
    let length = format.ratio(length);
    let mut radiance = format.int(0);
    let mut transmittance = format.int(1);
    let knots = volume.knots();
    let mut ends = knots.iter().map(|part| (*part, at(*part)));
    let Some(mut near) = ends.next() else {
        return radiance.to_float();
    };
    for far in ends {
        let width: MpfrReal = (exact(far.0) - &exact(near.0)) * &length;
        let (adds, passes) = rule.segment(&near.1, &far.1, &width);
        radiance += &(adds * &transmittance);
        transmittance *= &passes;
        near = far;
    }
    radiance.to_float()
}

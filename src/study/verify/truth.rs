//! What a kernel should answer.

use super::VerifyError;
use super::asked::Wanted;
use crate::case::{Case, SymbolicCase, Transfer, Unproved};
use crate::identify::rule::LinearSegments;
use crate::kernel::{Quantity, Volume, WallAt};
use crate::real::{Format, Mpfr, MpfrReal, Native, Real};
use crate::reference::{self, Reference};
use rug::{Float, Rational};

/// How far in front of the end of a ray, as a part of it, its last samples are still looked for.
const LAST_SAMPLE: (u32, u32) = (1, 10_000);

/// The length that renderers give the last segment to make a wall of it: what absorbs nothing stays clear.
const WALL_LENGTH: i64 = 10_000_000_000;

/// A value, and what it rests on that is not proved.
type Truth = (Float, Vec<Unproved>);

/// What is wanted of a case, with what stands at the end of the ray; `None` of a mean depth where nothing absorbs.
pub(super) fn of(
    wanted: &Wanted,
    bits: u32,
    wall: Option<WallAt>,
) -> Result<Option<Truth>, VerifyError> {
    let case = &wanted.case;
    match wanted.quantity {
        Quantity::OpticalDepth | Quantity::Emission => depth(case, bits).map(Some),
        Quantity::Opacity => opacity(case, bits, wall).map(Some),
        Quantity::ExpectedDepth if wanted.is_divided() => {
            let (opacity, mut unproved) = opacity(case, bits, wall)?;
            if opacity.is_zero() {
                return Ok(None);
            }
            let (weighted, more) = of_case(case, bits, wall)?;
            unproved.extend(
                more.into_iter()
                    .filter(|one| !unproved.contains(one))
                    .collect::<Vec<_>>(),
            );
            Ok(Some((weighted / opacity, unproved)))
        }
        Quantity::Radiance if wanted.background != 0.0 => {
            let (radiance, unproved) = of_case(&wanted.ray, bits, wall)?;
            let (depth, _) = depth(&wanted.ray, bits)?;
            Ok(Some((
                radiance + (-depth).exp() * wanted.background,
                unproved,
            )))
        }
        Quantity::Radiance | Quantity::ExpectedDepth => of_case(case, bits, wall).map(Some),
    }
}

/// t(D).
fn depth(case: &SymbolicCase, bits: u32) -> Result<Truth, VerifyError> {
    let found = found(case, reference::optical_depth(case, bits))?;
    let unproved = found.unproved_of("t(D)", case);
    Ok((found.value, unproved))
}

/// 1 − e^(−t(D)); 1 less what a wall lets through behind it.
fn opacity(case: &SymbolicCase, bits: u32, wall: Option<WallAt>) -> Result<Truth, VerifyError> {
    let (depth, unproved) = depth(case, bits)?;
    let mut opacity = -(-depth.clone()).exp_m1();
    if let Some(at) = wall {
        let wall = wall_opacity(case, at, Mpfr { bits: depth.prec() });
        opacity += (-depth).exp() * wall.to_float();
    }
    Ok((opacity, unproved))
}

/// What a wall made of the last sample absorbs.
pub(in crate::study) fn wall_opacity(case: &SymbolicCase, at: WallAt, format: Mpfr) -> MpfrReal {
    let length = case.length();
    let extinction = match at {
        // A medium may vanish at the end, but not where it is sampled.
        WallAt::BeforeEnd => {
            let before = &length - &length * Rational::from(LAST_SAMPLE);
            case.extinction(&case.field(&format.ratio(&before)))
        }
        // As it is given: what binary64 leaves of a medium that vanishes there makes part of a wall.
        WallAt::End => {
            let end = Native::<f64>::new().ratio(&length);
            format.binary64(case.extinction(&case.field(&end)))
        }
    };
    -(-(extinction * &format.int(WALL_LENGTH))).exp_m1()
}

fn found(
    case: &SymbolicCase,
    reference: Result<Reference, reference::ReferenceError>,
) -> Result<Reference, VerifyError> {
    reference.map_err(|error| VerifyError::Reference {
        case: case.name().into(),
        error,
    })
}

/// The radiance of a case, with what stands at the end of the ray.
///
/// I + T(D) C(s(D)) where there is a far wall, and something in front of it that absorbs. With it what is not proved of
/// either.
fn of_case(case: &SymbolicCase, bits: u32, wall: Option<WallAt>) -> Result<Truth, VerifyError> {
    let reference = found(case, reference::radiance(case, bits))?;
    let unproved = reference.unproved(case);
    let mut radiance = reference.value;
    if let Some(at) = wall {
        let depth = found(case, reference::optical_depth(case, bits))?.value;
        let format = Mpfr {
            bits: radiance.prec(),
        };
        let wall = case.transfer(&case.field(&format.ratio(&case.length())));
        let opacity = wall_opacity(case, at, format);
        radiance += (-depth).exp() * (wall.emission * &opacity).to_float();
    }
    Ok((radiance, unproved))
}

/// What is wanted of the medium that a volume stands for, exactly: sums over stretches in which C and τ are linear.
pub(super) fn of_volume(volume: &Volume, length: &Rational, wanted: &Wanted, bits: u32) -> Float {
    let even = Float::with_val(bits, 1);
    match wanted.quantity {
        Quantity::OpticalDepth | Quantity::Emission => depth_of_volume(volume, length, bits),
        Quantity::Opacity => radiance_of_volume(volume, length, bits, |_, _| even.clone()),
        Quantity::ExpectedDepth => {
            let of = |part: f64, _: &[f64]| Float::with_val(bits, length) * part;
            let weighted = radiance_of_volume(volume, length, bits, of);
            if wanted.is_divided() {
                weighted / radiance_of_volume(volume, length, bits, |_, _| even.clone())
            } else {
                weighted
            }
        }
        Quantity::Radiance => {
            let of = |_: f64, emission: &[f64]| {
                let of_channel = emission.get(wanted.channel);
                Float::with_val(bits, of_channel.copied().unwrap_or(f64::NAN))
            };
            let passes = (-depth_of_volume(volume, length, bits)).exp();
            radiance_of_volume(volume, length, bits, of) + passes * wanted.background
        }
    }
}

/// τ is linear between knots.
fn depth_of_volume(volume: &Volume, length: &Rational, bits: u32) -> Float {
    let mut emission = vec![0.0; volume.table.emission.len()];
    let mut at = |part: f64| {
        let extinction = volume.table.at(volume.field_at(part), &mut emission);
        Float::with_val(bits, extinction)
    };
    let mut depth = Float::new(bits);
    for ends in volume.knots().windows(2) {
        let &[near, far] = ends else { continue };
        let width = (Float::with_val(bits, far) - near) * length;
        depth += width * (at(near) + at(far)) / 2_u32;
    }
    depth
}

/// The radiance of that medium with an emission that is linear between knots, of a place as a part of the ray and the
/// emission of all channels there.
fn radiance_of_volume(
    volume: &Volume,
    length: &Rational,
    bits: u32,
    emitted: impl Fn(f64, &[f64]) -> Float,
) -> Float {
    let format = Mpfr { bits };
    // What is no number stays none: it must not pass for a medium that is empty.
    let exact = |x: f64| format.binary64(x);
    let mut emission = vec![0.0; volume.table.emission.len()];
    let mut at = |part: f64| {
        let extinction = volume.table.at(volume.field_at(part), &mut emission);
        Transfer {
            extinction: exact(extinction),
            emission: MpfrReal::from(emitted(part, &emission)),
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

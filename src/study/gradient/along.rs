//! What theory says along a ray: τ, C, T, and what comes from behind.

use super::GradientError;
use super::integrated::{self, Integrals};
use crate::case::{Case, SymbolicCase, Transfer, Unproved};
use crate::kernel::{Subject, WallAt};
use crate::real::{Format, Mpfr, MpfrReal, Real};
use crate::reference::{self, Reference};
use crate::study::verify::wall_opacity;
use rug::Float;

/// Bits of theory: what cancels in a closed form would have to be 2^180 times what is left to be seen in binary64.
const BITS: u32 = 256;

/// Theory at the places of a level, by place.
pub(super) struct Along {
    /// τ.
    pub(super) extinction: Vec<Float>,
    /// T.
    pub(super) transmittance: Vec<Float>,
    /// C, by channel.
    pub(super) emission: Vec<Vec<Float>>,
    /// R, what comes from behind, by channel.
    pub(super) behind: Vec<Vec<Float>>,
    /// By how much T and R may be off where they are integrals; 0 of closed forms.
    pub(super) error: f64,
}

/// The rays of a case, with what is seen at their ends.
pub(super) struct Theory<'a> {
    subject: &'a Subject,
    /// I(D) and what comes from the end of the ray, by channel.
    whole: Vec<Float>,
    /// What that rests on and is not proved.
    pub(super) unproved: Vec<Unproved>,
}

impl<'a> Theory<'a> {
    pub(super) fn new(subject: &'a Subject, wall: Option<WallAt>) -> Result<Self, GradientError> {
        let mut unproved = Vec::new();
        let mut whole = Vec::new();
        for (channel, case) in subject.cases().iter().enumerate() {
            let radiance = found(case, reference::radiance(case, BITS))?;
            let depth = found(case, reference::optical_depth(case, BITS))?;
            for one in radiance.unproved(case) {
                if !unproved.contains(&one) {
                    unproved.push(one);
                }
            }
            let seen = (-depth.value).exp();
            let end = of_end(subject, case, channel, wall);
            whole.push(radiance.value + seen * end);
        }
        Ok(Theory {
            subject,
            whole,
            unproved,
        })
    }

    /// Theory at these places, which ascend.
    pub(super) fn at(&self, places: &[f64]) -> Along {
        let format = Mpfr { bits: BITS };
        let lambda: Vec<MpfrReal> = places.iter().map(|x| format.binary64(*x)).collect();
        let cases = self.subject.cases();
        let mut along = Along {
            extinction: Vec::new(),
            transmittance: Vec::new(),
            emission: Vec::new(),
            behind: Vec::new(),
            error: 0.0,
        };
        for (case, whole) in cases.iter().zip(&self.whole) {
            let Integrals {
                depth,
                radiance,
                error,
            } = closed(case, &lambda).unwrap_or_else(|| integrated::integrals(case, places));
            along.error = along.error.max(error);
            let transfers: Transfer<Vec<MpfrReal>> = case.transfers(&case.fields(&lambda));
            let floats = |values: Vec<MpfrReal>| values.into_iter().map(Float::from).collect();
            along.emission.push(floats(transfers.emission));
            along.extinction = floats(transfers.extinction);
            let behind = radiance
                .iter()
                .map(|before| Float::with_val(BITS, whole - before));
            along.behind.push(behind.collect());
            along.transmittance = depth.into_iter().map(|depth| (-depth).exp()).collect();
        }
        along
    }
}

/// What stands at the end of the ray: a background, or a wall of what the last sample emits.
fn of_end(subject: &Subject, case: &SymbolicCase, channel: usize, wall: Option<WallAt>) -> Float {
    let format = Mpfr { bits: BITS };
    if let Some(at) = wall {
        let wall = case.transfer(&case.field(&format.ratio(subject.length())));
        return (wall.emission * &wall_opacity(case, at, format)).to_float();
    }
    let behind = subject.background().get(channel);
    Float::with_val(BITS, behind.copied().unwrap_or(0.0))
}

/// t and I at these places by their closed forms, where these are there and have values.
fn closed(case: &SymbolicCase, lambda: &[MpfrReal]) -> Option<Integrals> {
    let all = |of: &dyn Fn(&MpfrReal) -> Option<MpfrReal>| {
        let values = lambda.iter().map(|lambda| {
            let value = Float::from(of(lambda)?);
            value.is_finite().then_some(value)
        });
        values.collect::<Option<Vec<Float>>>()
    };
    Some(Integrals {
        depth: all(&|lambda| case.optical_depth(lambda))?,
        radiance: all(&|lambda| case.radiance(lambda))?,
        error: 0.0,
    })
}

fn found(
    case: &SymbolicCase,
    reference: Result<Reference, reference::ReferenceError>,
) -> Result<Reference, GradientError> {
    reference.map_err(|error| GradientError::Reference {
        case: case.name().into(),
        error,
    })
}

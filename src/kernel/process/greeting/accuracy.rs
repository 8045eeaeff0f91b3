//! What a greeting says of how exact a kernel is, and of what it takes.

use super::{above_zero, named, of_second};
use crate::kernel::process::message::{
    KernelHello, NumberOr, WireEmission, WireSubnormals, WireUlp,
};
use crate::kernel::process::{SECOND, number::Number};
use crate::kernel::{Declaration, Quantum, UlpBound};
use std::num::NonZeroUsize;

/// A declaration that says this alone.
pub(super) fn of(version: u64, hello: &KernelHello) -> Result<Declaration, String> {
    let is_relative = matches!(hello.quantum, Some(NumberOr::Object(_)));
    let of_the_second = [
        ("output", hello.output.is_some()),
        ("quantum of the largest emission", is_relative),
        ("exp_ulp", hello.exp_ulp.is_some()),
        ("expm1_ulp", hello.expm1_ulp.is_some()),
        ("pow_ulp", hello.pow_ulp.is_some()),
        ("subnormals", hello.subnormals.is_some()),
        ("noise", hello.noise.is_some()),
        ("channels", hello.channels.is_some()),
        ("emission", hello.emission.is_some()),
        ("source", hello.source.is_some()),
    ];
    let early = of_the_second.into_iter().find(|(_, given)| *given);
    if let Some((key, _)) = early.filter(|_| version < SECOND) {
        return Err(of_second(key, version));
    }
    let output = hello.output.as_deref();
    let declaration = Declaration {
        output: output.map(|name| named("output", name)).transpose()?,
        quantum: match &hello.quantum {
            None => None,
            Some(NumberOr::Number(number)) => {
                above_zero("quantum", Some(number))?.map(Quantum::Absolute)
            }
            Some(NumberOr::Object(part)) => {
                above_zero("quantum: relative", Some(&part.relative))?.map(Quantum::Relative)
            }
        },
        exp_ulp: ulp("exp_ulp", hello.exp_ulp.as_ref())?,
        expm1_ulp: ulp("expm1_ulp", hello.expm1_ulp.as_ref())?,
        pow_ulp: ulp("pow_ulp", hello.pow_ulp.as_ref())?,
        subnormals_lost: hello.subnormals.is_some_and(|WireSubnormals::Lost| true),
        noise: above_zero("noise", hello.noise.as_ref())?,
        channels: channels(hello.channels)?,
        positive_emission: hello.emission.is_some_and(|WireEmission::Positive| true),
        source: hello.source.map(Into::into).unwrap_or_default(),
        ..Declaration::new(&hello.name)
    };
    Ok(declaration)
}

fn channels(count: Option<u64>) -> Result<Option<NonZeroUsize>, String> {
    let Some(count) = count else {
        return Ok(None);
    };
    let channels = usize::try_from(count).ok().and_then(NonZeroUsize::new);
    match channels {
        Some(_) => Ok(channels),
        None => Err(format!("channels {count} (allowed: 1 or more)")),
    }
}

fn ulp(key: &str, bound: Option<&NumberOr<WireUlp>>) -> Result<Option<UlpBound>, String> {
    let (a, b) = match bound {
        None => return Ok(None),
        Some(NumberOr::Number(a)) => (a.to_f64(), 0.0),
        Some(NumberOr::Object(WireUlp { a, b })) => {
            (a.to_f64(), b.as_ref().map_or(0.0, Number::to_f64))
        }
    };
    let bound = UlpBound::new(a, b);
    bound.map(Some).map_err(|error| format!("{key}: {error}"))
}

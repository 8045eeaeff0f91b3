//! Ray marchers as people write them, right and wrong: plain loops in binary64, which share nothing with the models
//! that they are compared with.

use volver::kernel::{Data, Declaration, FormKind, Segments, Task, Volume};

/// What a marcher does wrong, or in its own way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    SampleMiddle,
    SampleBack,
    FirstDropped,
    LastDropped,
    FirstDoubled,
    LastDoubled,
    OneExtra,
    LinearOpacity,
    /// α = 1 − e^(−τ ℓ).
    Uncorrected(f64),
    /// The exponent d/ℓ with another ℓ: by this factor.
    WrongReference(f64),
    /// No correction for the step where the opacity per unit of length is not above this.
    SkipUnder(f64),
    StopUnder(f64),
    /// Fixed point of that many bits, rounded.
    Bits(u32),
    /// Unsigned normalised integers of that many bits, cut off.
    ImageBits(u32),
    Unattenuated,
    EmissionUnweighted,
    EmissionTwice,
    Swapped,
    FarWall,
    Binary32,
    /// Transfer functions sampled again, at that many entries.
    Table(usize),
    NearestEntry,
    Jittered,
}

/// The radiance of one channel.
pub(crate) fn march(task: &Task<'_>, channel: usize, faults: &[Fault]) -> f64 {
    let has = |fault: Fault| faults.contains(&fault);
    let mut samples: Vec<(f64, f64, f64)> = match task.data {
        Data::Segments(segments) => of_segments(segments, channel, faults),
        Data::Volume(volume) => of_volume(task, volume, channel, faults),
        Data::Function => jittered(task, channel),
        Data::Formula(_) => panic!("no formula was asked for"),
    };
    let first = samples[0];
    let last = samples[samples.len() - 1];
    if has(Fault::FirstDropped) {
        samples.remove(0);
    }
    if has(Fault::LastDropped) {
        samples.pop();
    }
    if has(Fault::FirstDoubled) {
        samples.insert(0, first);
    }
    if has(Fault::LastDoubled) {
        samples.push(last);
    }
    if has(Fault::OneExtra) {
        let Data::Segments(segments) = task.data else {
            panic!("segments are asked for")
        };
        let edge = if has(Fault::SampleBack) {
            0
        } else {
            segments.count()
        };
        let edges = &segments.edges;
        let extra = (
            edges.extinction[edge],
            edges.emission[channel][edge],
            task.step,
        );
        if has(Fault::SampleBack) {
            samples.insert(0, extra);
        } else {
            samples.push(extra);
        }
    }
    if has(Fault::Binary32) {
        return narrow(&samples);
    }
    if has(Fault::Swapped) {
        samples.reverse();
    }
    let quantize = |x: f64| {
        faults.iter().fold(x, |x, fault| match fault {
            Fault::Bits(bits) => (x * f64::from(1 << bits)).round() / f64::from(1 << bits),
            Fault::ImageBits(bits) => {
                let most = f64::from((1 << bits) - 1);
                (x * most).floor() / most
            }
            _ => x,
        })
    };
    let stop = faults.iter().find_map(|fault| match fault {
        Fault::StopUnder(threshold) => Some(*threshold),
        _ => None,
    });
    let count = samples.len();
    let mut radiance = 0.0;
    let mut transmittance = 1.0;
    for (index, (extinction, emission, length)) in samples.into_iter().enumerate() {
        let mut opacity = opacity(extinction, length, faults);
        let mut passes = 1.0 - opacity;
        if has(Fault::Unattenuated) {
            opacity = extinction * length;
            passes = (-opacity).exp();
        }
        if has(Fault::FarWall) && index == count - 1 {
            opacity = 1.0;
            passes = 0.0;
        }
        let light = if has(Fault::EmissionUnweighted) {
            emission
        } else if has(Fault::EmissionTwice) {
            emission * opacity * opacity
        } else {
            emission * opacity
        };
        radiance = quantize(radiance + transmittance * light);
        transmittance = quantize(transmittance * passes);
        if stop.is_some_and(|stop| transmittance < stop) {
            break;
        }
    }
    radiance
}

fn opacity(extinction: f64, length: f64, faults: &[Fault]) -> f64 {
    let mut depth = extinction * length;
    for fault in faults {
        match fault {
            Fault::LinearOpacity => return depth,
            Fault::Uncorrected(reference) => depth = extinction * reference,
            Fault::WrongReference(factor) => depth *= factor,
            Fault::SkipUnder(threshold) => {
                let per_unit = 1.0 - (-extinction).exp();
                if per_unit <= *threshold {
                    return per_unit;
                }
            }
            _ => {}
        }
    }
    1.0 - (-depth).exp()
}

/// (τ, C, length) of every sample.
fn of_segments(segments: &Segments, channel: usize, faults: &[Fault]) -> Vec<(f64, f64, f64)> {
    let n = segments.count();
    let (samples, first) = if faults.contains(&Fault::SampleMiddle) {
        (&segments.middles, 0)
    } else {
        (
            &segments.edges,
            usize::from(faults.contains(&Fault::SampleBack)),
        )
    };
    let lambda = &segments.edges.lambda;
    (0..n)
        .map(|j| {
            let at = first + j;
            let length = lambda[j + 1] - lambda[j];
            (
                samples.extinction[at],
                samples.emission[channel][at],
                length,
            )
        })
        .collect()
}

/// The same through a volume, always in the middles.
fn of_volume(
    task: &Task<'_>,
    volume: &Volume,
    channel: usize,
    faults: &[Fault],
) -> Vec<(f64, f64, f64)> {
    let length = task.subject.length().to_f64();
    let cells = volume.field.len() - 1;
    let table = &volume.table;
    let mut extinction = table.extinction.clone();
    let mut emission = table.emission[channel].clone();
    for fault in faults {
        if let Fault::Table(entries) = fault {
            let coarse = |fine: &[f64]| -> Vec<f64> {
                (0..*entries)
                    .map(|k| {
                        linear(
                            fine,
                            k as f64 * (fine.len() - 1) as f64 / (entries - 1) as f64,
                        )
                    })
                    .collect()
            };
            extinction = coarse(&extinction);
            emission = coarse(&emission);
        }
    }
    (0..task.segments)
        .map(|j| {
            let near = j as f64 * task.step;
            let far = (near + task.step).min(length);
            let middle = 0.5 * (near + far);
            let s = linear(&volume.field, middle / length * cells as f64);
            let width = table.last - table.first;
            let part = if width > 0.0 {
                (s - table.first) / width
            } else {
                0.0
            };
            let mut place = part.clamp(0.0, 1.0) * (extinction.len() - 1) as f64;
            if faults.contains(&Fault::NearestEntry) {
                place = place.round();
            }
            (
                linear(&extinction, place),
                linear(&emission, place),
                far - near,
            )
        })
        .collect()
}

fn linear(values: &[f64], place: f64) -> f64 {
    let index = (place as usize).min(values.len() - 1);
    let next = (index + 1).min(values.len() - 1);
    let part = place - index as f64;
    values[index] + (values[next] - values[index]) * part
}

/// One sample a segment, wherever a linear congruential generator says.
fn jittered(task: &Task<'_>, channel: usize) -> Vec<(f64, f64, f64)> {
    let mut state = task
        .seed
        .wrapping_add(task.segments << 20)
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407)
        ^ task
            .subject
            .name()
            .bytes()
            .fold(7, |h: u64, b| h.wrapping_mul(31) + u64::from(b));
    let mut emission = vec![0.0; task.subject.channels().len()];
    let length = task.subject.length().to_f64();
    (0..task.segments)
        .map(|j| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let part = (state >> 11) as f64 / (1_u64 << 53) as f64;
            let near = j as f64 * task.step;
            let far = (near + task.step).min(length);
            let extinction = task.subject.at(near + part * (far - near), &mut emission);
            (extinction, emission[channel], far - near)
        })
        .collect()
}

fn narrow(samples: &[(f64, f64, f64)]) -> f64 {
    let (mut radiance, mut transmittance) = (0_f32, 1_f32);
    for (extinction, emission, length) in samples {
        let depth = *extinction as f32 * *length as f32;
        let opacity = 1.0 - (-depth).exp();
        radiance += transmittance * opacity * *emission as f32;
        transmittance *= 1.0 - opacity;
    }
    f64::from(radiance)
}

/// What the marcher says of itself, whatever it does.
pub(crate) fn declared(method: &str, faults: &[Fault]) -> Declaration {
    let volume = faults
        .iter()
        .any(|fault| matches!(fault, Fault::Table(_) | Fault::NearestEntry));
    Declaration {
        form: if volume {
            FormKind::Volume
        } else if faults.contains(&Fault::Jittered) {
            FormKind::Function
        } else {
            FormKind::Segments
        },
        method: Some(method.parse().expect("a method")),
        ..Declaration::new("marcher")
    }
}

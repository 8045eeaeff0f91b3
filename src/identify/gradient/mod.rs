//! Whether a gradient is that of the kernel's own values, and if not, which term is wrong.
//!
//! A composite is linear in every C and in every opacity α: ∂I/∂Cᵢ is the answer to Cᵢ = 1 and nothing else, and
//! ∂I/∂τᵢ = α′ (I|αᵢ=1 − I|αᵢ=0). So values alone tell the gradient to rounding, without small steps; where a kernel is no
//! such composite, central differences do, to as many digits as two of them agree.

mod faults;
mod others;
mod own;
mod rays;

use super::deviation::Deviation;
use super::precision::Precision;
use super::session::{Budget, Session, Spent};
use super::state::is_same;
use super::{NotIdentified, Silence};
use crate::kernel::{Gradient, Kernel};
use faults::named;
pub use others::GradientsTogether;
use own::{Entry, Side, measured};
use rays::{Probe, rays};
use std::fmt;

/// What was found out about a kernel's gradient.
#[derive(Clone, Debug, Default)]
pub struct GradientFound {
    /// Derivatives that were compared with the kernel's own values.
    pub compared: usize,
    /// Those that agree to rounding.
    pub agree: usize,
    /// Those at a kink, where every value between two slopes is right.
    pub left_out: usize,
    /// What is wrong, by names that stay; empty too where nothing could be named.
    pub deviations: Vec<Deviation>,
    /// The derivative that is farthest off.
    pub worst: Option<Off>,
    /// What came of several rays in one request; `None` where the kernel takes fewer.
    pub shared: Option<GradientsTogether>,
    /// What it cost.
    pub spent: Spent,
}

/// A derivative that is not the kernel's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Off {
    /// Of which ray, in words.
    pub ray: &'static str,
    /// By the emission of that channel, or by the extinction.
    pub channel: Option<usize>,
    /// Of the value at that place.
    pub at: usize,
    /// What the kernel says.
    pub got: f64,
    /// What its values say.
    pub want: f64,
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let by = match self.channel {
            None => "τ".into(),
            Some(channel) => format!("C of channel {channel}"),
        };
        let [got, want] = super::witness::told_apart(self.got, self.want);
        write!(
            f,
            "on {}, by {by} at {}: {got} where the values say {want}",
            self.ray, self.at
        )
    }
}

impl GradientFound {
    /// Whether all derivatives are those of the values.
    #[must_use]
    pub fn is_right(&self) -> bool {
        self.compared > 0 && self.agree == self.compared && self.deviations.is_empty()
    }
}

/// A ray with its derivatives, as answered and as the values have them.
struct Ray {
    probe: Probe,
    entries: Vec<Entry>,
    /// By τ, then by C of every channel.
    answered: Vec<Vec<f64>>,
}

impl Ray {
    fn sides(&self) -> impl Iterator<Item = Side> + use<> {
        sides(self.answered.len() - 1)
    }

    /// Derivatives by values of that side, place by place.
    fn of(&self, side: Side) -> impl Iterator<Item = (&Entry, f64)> {
        let row = match side {
            Side::Extinction => 0,
            Side::Emission(channel) => channel + 1,
        };
        self.entries.iter().zip(self.answered[row].iter().copied())
    }
}

/// By τ, then by C of every channel.
fn sides(channels: usize) -> impl Iterator<Item = Side> {
    std::iter::once(Side::Extinction).chain((0..channels).map(Side::Emission))
}

/// Compares a kernel's gradient with its values, and names what is wrong; `heard` hears of every ray.
///
/// # Errors
/// [`NotIdentified`] where the kernel declares no gradient, does not answer, or is not linear in its emission.
pub fn gradients(
    kernel: &mut dyn Kernel,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Result<GradientFound, NotIdentified> {
    let Some(at) = kernel.declaration().gradient else {
        return Err(NotIdentified::new("no gradient is declared"));
    };
    if kernel.declaration().stochastic {
        let reason = "a kernel that draws random numbers has its values in the mean alone";
        return Err(NotIdentified::new(reason));
    }
    let mut session = Session::new(kernel, budget, heard);
    let (alike, of_calls) = others::one_after_another(&mut session, at)?;
    if let Some(deviation) = of_calls {
        // Nothing that is asked singly is its own ray's.
        let mut found = judged(&alike.rays, alike.unit);
        found.deviations.push(deviation);
        found.spent = session.spent;
        return Ok(found);
    }
    let probes = rays(&mut session);
    let mut all = Vec::new();
    for probe in probes {
        let (entries, unit) = measured(&mut session, &probe, at)?;
        let mut ask = || {
            let gradient = session.derivatives(&probe.ray, &probe.cotangents, at)?;
            Ok::<_, Silence>(rows(&gradient))
        };
        let (answered, again) = (ask()?, ask()?);
        let mut both = answered.iter().zip(&again);
        if !both.all(|(one, other)| is_same(one, other)) {
            let reason = "the same question has gradients that differ";
            return Err(NotIdentified::new(reason).with_answers(&answered));
        }
        all.push((
            Ray {
                probe,
                entries,
                answered,
            },
            unit,
        ));
    }
    let unit = all.iter().map(|(_, unit)| *unit).fold(0.0, f64::max);
    let all: Vec<Ray> = all.into_iter().map(|(ray, _)| ray).collect();
    let numbers: Vec<f64> = all.iter().flat_map(|ray| ray.answered.concat()).collect();
    let precision = Precision::of(&numbers);
    let mut found = judged(&all, unit.max(precision.unit()));
    found.deviations = named(&all, unit, precision);
    if let Some((shared, deviation)) = others::together(&mut session, &alike, at)? {
        found.shared = Some(shared);
        found.deviations.extend(deviation);
    }
    found.spent = session.spent;
    Ok(found)
}

/// Counts, and the derivative that is farthest off.
fn judged(all: &[Ray], unit: f64) -> GradientFound {
    let mut found = GradientFound::default();
    let mut farthest = 0.0;
    for ray in all {
        for side in ray.sides() {
            for (at, (entry, got)) in ray.of(side).enumerate() {
                let truth = entry.truth(side);
                let Some(truth) = truth.filter(|_| !entry.is_at_rest(side, got)) else {
                    found.left_out += 1;
                    continue;
                };
                found.compared += 1;
                if entry.agrees(side, got, unit) {
                    found.agree += 1;
                    continue;
                }
                let off = (got - truth.value).abs() / entry.size(side);
                let off = if off.is_finite() { off } else { f64::INFINITY };
                if off > farthest {
                    farthest = off;
                    found.worst = Some(Off {
                        ray: ray.probe.name,
                        channel: match side {
                            Side::Extinction => None,
                            Side::Emission(channel) => Some(channel),
                        },
                        at,
                        got,
                        want: truth.value,
                    });
                }
            }
        }
    }
    found
}

/// By τ, then by C of every channel.
fn rows(gradient: &Gradient) -> Vec<Vec<f64>> {
    let rows = std::iter::once(&gradient.extinction).chain(&gradient.emission);
    let numbers = |row: &Vec<rug::Float>| row.iter().map(rug::Float::to_f64).collect();
    rows.map(numbers).collect()
}

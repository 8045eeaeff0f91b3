//! Derivatives by a kernel's own values.

use super::rays::Probe;
use crate::identify::NotIdentified;
use crate::identify::precision::Precision;
use crate::identify::ray::Layers;
use crate::identify::rule::Node;
use crate::identify::session::Session;
use crate::identify::weights::{Measured, impulse};
use crate::kernel::GradientAt;

/// By what is differentiated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// τ.
    Extinction,
    /// C of that channel.
    Emission(usize),
}

/// One value of a ray, and what the radiance does when it changes.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    /// d.
    pub(super) length: f64,
    pub(super) extinction: f64,
    /// w: the answer to C = 1 there and 0 elsewhere.
    pub(super) weight: f64,
    /// α and T in front of it, of a composite.
    pub(super) opacity: f64,
    pub(super) front: f64,
    /// dα/dτ.
    pub(super) slope: f64,
    /// Σ aₖ T Cₖ.
    pub(super) direct: f64,
    /// Σ aₖ Sₖ, S what shines from behind.
    pub(super) behind: f64,
    /// Σ aₖ w Cₖ.
    pub(super) own: f64,
    /// ∂/∂τ; `None` at a kink.
    by_extinction: Option<Measured>,
    /// ∂/∂C of every channel.
    by_emission: Vec<Measured>,
    cotangents: Vec<f64>,
    /// Of the terms that make the derivatives.
    sizes: [f64; 2],
}

/// Roundings of a derivative: some tens of operations.
pub(super) const ROUNDINGS: f64 = 256.0;
/// The half-width of central differences, as a part of the extinction, or of what has that depth.
const PART: f64 = 0.02;
const LEAST: f64 = 0.05;
/// A segment lets this part of a unit through, and counts as opaque: deeper ones would lose the digits of depths that are
/// summed with it.
const SHUT: f64 = 1.0 / 64.0;
/// A depth so near to 0 is at the kink of a rectifier.
const REST: f64 = 1e-6;
/// Slopes on both sides that differ by more than this part belong to a kink.
const KINK: f64 = 0.3;

impl Entry {
    /// What the derivative is; `None` at a kink.
    pub(super) fn truth(&self, side: Side) -> Option<Measured> {
        match side {
            Side::Extinction => self.by_extinction,
            Side::Emission(channel) => self.by_emission.get(channel).copied(),
        }
    }

    /// Whether it is no slope where nothing absorbs: a rectifier has every slope from 0 to its own there.
    pub(super) fn is_at_rest(&self, side: Side, got: f64) -> bool {
        side == Side::Extinction && got == 0.0 && self.extinction * self.length <= REST
    }

    /// The cotangent of a channel; 1 for what is summed over all.
    pub(super) fn cotangent(&self, side: Side) -> f64 {
        match side {
            Side::Extinction => 1.0,
            Side::Emission(channel) => self.cotangents[channel],
        }
    }

    /// The size of what cancels in it.
    pub(super) fn size(&self, side: Side) -> f64 {
        self.sizes[usize::from(side != Side::Extinction)]
    }

    /// How far rounding may take it.
    pub(super) fn tolerance(&self, side: Side, unit: f64) -> f64 {
        let error = self.truth(side).map_or(0.0, |truth| truth.error);
        3.0 * error + ROUNDINGS * unit * self.size(side)
    }

    /// Whether a derivative is this one; at a kink every one is.
    pub(super) fn agrees(&self, side: Side, got: f64, unit: f64) -> bool {
        self.truth(side)
            .is_none_or(|truth| (got - truth.value).abs() <= self.tolerance(side, unit))
    }
}

/// All values of a ray, and the unit of the answers.
pub(super) fn measured(
    session: &mut Session<'_>,
    probe: &Probe,
    at: GradientAt,
) -> Result<(Vec<Entry>, f64), NotIdentified> {
    let n = probe.layers.count();
    let nodes: Vec<Node> = match at {
        GradientAt::Middles => (0..n).map(Node::Middle).collect(),
        GradientAt::Edges => (0..=n).map(Node::Edge).collect(),
    };
    let channels = probe.emission.len();
    let mut emission = probe.emission.clone();
    emission.extend(nodes.iter().map(|node| impulse(n, *node, 1.0)));
    let ray = session.ray(&probe.layers, &emission);
    let answers = session.ask(&ray)?;
    let unit = Precision::of(&answers).unit();
    let (base, weights) = answers.split_at(channels);
    for (channel, total) in base.iter().enumerate() {
        let terms = nodes.iter().zip(weights);
        let terms: Vec<f64> = terms
            .map(|(node, w)| w * probe.emission[channel].at(*node))
            .collect();
        let sum: f64 = terms.iter().sum();
        let size: f64 = terms.iter().map(|term| term.abs()).sum();
        if (sum - total).abs() > ROUNDINGS * unit * size.max(total.abs()) {
            return Err(NotIdentified::new(
                "the answer is not a linear function of the emission at the places declared",
            )
            .with_answers(&[terms, vec![*total]]));
        }
    }
    let mut entries = Vec::new();
    for (node, weight) in nodes.iter().zip(weights) {
        let mut asked = Asked {
            session: &mut *session,
            probe,
            node: *node,
        };
        entries.push(asked.entry(base, *weight, unit)?);
    }
    composite(probe, &nodes, &mut entries);
    Ok((entries, unit))
}

/// One value of a ray that is changed.
struct Asked<'a, 'k> {
    session: &'a mut Session<'k>,
    probe: &'a Probe,
    node: Node,
}

impl Asked<'_, '_> {
    /// The radiances with another extinction there.
    fn with(&mut self, extinction: f64) -> Result<Vec<f64>, NotIdentified> {
        let mut layers: Layers = self.probe.layers.clone();
        match self.node {
            Node::Edge(i) => layers.edges[i] = extinction,
            Node::Middle(i) => layers.middles[i] = extinction,
        }
        let ray = self.session.ray(&layers, &self.probe.emission);
        Ok(self.session.ask(&ray)?)
    }

    fn sum(&self, radiances: &[f64]) -> f64 {
        let both = radiances.iter().zip(&self.probe.cotangents);
        both.map(|(radiance, a)| radiance * a).sum()
    }

    fn entry(&mut self, base: &[f64], weight: f64, unit: f64) -> Result<Entry, NotIdentified> {
        let (layers, cotangents) = (&self.probe.layers, self.probe.cotangents.clone());
        let length = layers.step;
        let extinction = match self.node {
            Node::Edge(i) => layers.edges[i],
            Node::Middle(i) => layers.middles[i],
        };
        let clear = self.with(0.0)?;
        let opaque = self.with(-(SHUT * unit).ln() / length)?;
        let sizes = |all: &[f64]| -> f64 {
            let both = all.iter().zip(&cotangents);
            both.map(|(radiance, a)| (radiance * a).abs()).sum()
        };
        let size = length * (sizes(&clear) + sizes(&opaque)).max(1e-300);
        let difference = self.difference(base, extinction, unit)?;
        let exact = exact(base, &clear, &opaque, extinction * length, unit).map(|slope| {
            let slope = length * slope;
            Measured {
                value: slope * (self.sum(&opaque) - self.sum(&clear)),
                error: ROUNDINGS * unit * slope * (sizes(&opaque) + sizes(&clear)),
            }
        });
        // Both say the same, or the kernel is no such composite.
        let by_extinction = match (exact, difference) {
            (Some(exact), Some(other))
                if (exact.value - other.value).abs() <= 3.0 * (exact.error + other.error) =>
            {
                Some(exact)
            }
            (_, other) => other,
        };
        let by_emission = cotangents.iter().map(|a| Measured {
            value: a * weight,
            error: ROUNDINGS * unit * (a * weight).abs(),
        });
        Ok(Entry {
            length,
            extinction,
            weight,
            opacity: -(-extinction * length).exp_m1(),
            front: 1.0,
            slope: length * (-extinction * length).exp(),
            direct: 0.0,
            behind: 0.0,
            own: 0.0,
            by_extinction,
            by_emission: by_emission.collect(),
            cotangents,
            sizes: [size, weight.abs().max(1e-300)],
        })
    }

    /// Two central differences, and how far they agree; forward ones where nothing absorbs. `None` at a kink.
    fn difference(
        &mut self,
        base: &[f64],
        extinction: f64,
        unit: f64,
    ) -> Result<Option<Measured>, NotIdentified> {
        let length = self.probe.layers.step;
        let h = PART * extinction.max(LEAST / length);
        let is_inside = extinction > h;
        let here = self.sum(base);
        let mut at = |offset: f64| -> Result<f64, NotIdentified> {
            let radiances = self.with(extinction + offset)?;
            Ok(self.sum(&radiances))
        };
        let (far, near) = (at(h)?, at(h / 2.0)?);
        let rounding = 16.0 * unit * here.abs().max(far.abs()).max(1e-300) / h;
        let ahead = |y: f64, h: f64| (y - here) / h;
        if !is_inside {
            let value = 2.0 * ahead(near, h / 2.0) - ahead(far, h);
            let error = (value - ahead(near, h / 2.0)).abs() + rounding;
            return Ok(Some(Measured { value, error }));
        }
        let (back, close) = (at(-h)?, at(-h / 2.0)?);
        let (up, down) = (ahead(far, h), -ahead(back, h));
        if (up - down).abs() > KINK * up.abs().max(down.abs()) + 4.0 * rounding {
            return Ok(None);
        }
        let (wide, narrow) = ((far - back) / (2.0 * h), (near - close) / h);
        let value = (4.0 * narrow - wide) / 3.0;
        let error = (value - narrow).abs() + rounding;
        Ok(Some(Measured { value, error }))
    }
}

/// dα/d(τ d) where α = 1 − e^(−τ d), seen from the values; `None` where it is another law.
fn exact(base: &[f64], clear: &[f64], opaque: &[f64], depth: f64, unit: f64) -> Option<f64> {
    let spans = opaque.iter().zip(clear).map(|(o, c)| o - c);
    let (channel, span) = spans
        .enumerate()
        .max_by(|u, v| u.1.abs().total_cmp(&v.1.abs()))?;
    let opacity = (base[channel] - clear[channel]) / span;
    let size = base[channel].abs() + clear[channel].abs();
    let error = ROUNDINGS * unit * (size / span.abs() + 1.0);
    let wanted = -(-depth).exp_m1();
    ((opacity - wanted).abs() <= error && error < 0.1).then(|| (-depth).exp())
}

/// What composites are made of, from front to back: T from the opacities, S from the weights.
fn composite(probe: &Probe, nodes: &[Node], entries: &mut [Entry]) {
    let mut front = 1.0;
    for entry in entries.iter_mut() {
        entry.front = front;
        front *= 1.0 - entry.opacity;
    }
    let mut behind = 0.0;
    for (node, entry) in nodes.iter().zip(entries.iter_mut()).rev() {
        let both = probe.emission.iter().zip(&probe.cotangents);
        let emission: f64 = both.map(|(c, a)| a * c.at(*node)).sum();
        entry.behind = behind;
        entry.own = entry.weight * emission;
        entry.direct = entry.front * emission;
        behind += entry.own;
    }
}

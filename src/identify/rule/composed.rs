//! A rule applied to the medium of a ray: what every node weighs.

use super::scheme::Three;
use super::{Extra, LastStep, Place, Rule, Scheme, Segment, Stop, StopBy, Wall, Whole};
use crate::kernel::Segments;
use crate::real::{Format, Real};
use rug::Rational;

/// Where a value stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// An end of segments.
    Edge(usize),
    /// The middle of one.
    Middle(usize),
}

/// What the nodes of a ray weigh.
#[derive(Clone, Debug)]
pub struct Composed<R> {
    /// Weights in the order in which they are added.
    pub terms: Vec<(Node, R)>,
    /// What the whole ray lets through.
    pub passes: R,
    /// What the sum is multiplied by.
    pub factor: R,
}

impl Composed<f64> {
    /// Σ |Tₖ wₖ Cₖ|: what a radiance is made of, where terms cancel.
    #[must_use]
    pub(crate) fn sizes(&self, ray: &Segments, channel: usize) -> f64 {
        let size = |(node, weight): &(Node, f64)| {
            let emission = emission(ray, *node, channel).unwrap_or(f64::NAN);
            (weight * emission).abs()
        };
        self.terms.iter().map(size).sum()
    }
}

/// What one step of the march does.
#[derive(Clone)]
struct Layer<R> {
    adds: Vec<(Node, R)>,
    passes: R,
}

impl<R: Real> Layer<R> {
    /// Of its first sample, behind what lets so much through.
    fn first_weight(&self, passes: &R) -> Option<R> {
        let (_, weight) = self.adds.first()?;
        Some(weight.clone() * passes)
    }
}

impl Rule {
    /// What it makes of a ray cut by a step.
    pub fn composed<F: Format>(&self, ray: &Segments, step: f64, format: F) -> Composed<F::Real> {
        let layers = self.layers(ray, step, format);
        let one = || format.int(1);
        let under = self.stop.map(|stop| format.binary64(stop.under));
        let mut terms = Vec::with_capacity(layers.len());
        let (mut passes, mut before) = (one(), one());
        let mut factor = one();
        let mut ended = false;
        let scale = format.binary64(self.scheme.scale());
        let mut sum = format.int(0);
        for layer in layers {
            let next = passes.clone() * &layer.passes;
            let own = layer.first_weight(&one()).map(|weight| weight / &scale);
            let with_own = own.clone().map(|own| own + &sum);
            ended = match (self.stop, &under) {
                (Some(stop), Some(under)) => match stop.by {
                    StopBy::Transmittance => next < *under,
                    StopBy::Weight => layer.first_weight(&passes).is_some_and(|w| w < *under),
                    StopBy::Sum => with_own.as_ref().is_some_and(|sum| sum >= under),
                },
                _ => false,
            };
            if ended && self.stop.is_some_and(|stop| stop.before) {
                break;
            }
            let seen = if self.sequence.late { &before } else { &passes };
            // Cut off, it adds in proportion to what is left to the threshold.
            let cut = match (self.stop, &under) {
                (
                    Some(Stop {
                        cut: true,
                        by: StopBy::Sum,
                        ..
                    }),
                    Some(under),
                ) if ended => {
                    let part = own.map(|own| (under.clone() - &sum) / &own);
                    part.map(|part| (part * seen, passes.clone()))
                }
                (Some(Stop { cut: true, .. }), Some(under)) if ended => {
                    let opacity = one() - &layer.passes;
                    Some(((passes.clone() - under) / &opacity, under.clone()))
                }
                _ => None,
            };
            for (node, weight) in layer.adds {
                let seen = cut.as_ref().map_or(seen, |(seen, _)| seen);
                terms.push((node, weight * seen));
            }
            sum = with_own.unwrap_or(sum);
            before = passes;
            passes = cut.map_or(next, |(_, left)| left);
            if ended {
                break;
            }
        }
        let opacity = one() - &passes;
        if let Some(Stop {
            renormalised: true, ..
        }) = self.stop
            && ended
        {
            factor /= &opacity;
        }
        match self.whole {
            Whole::One => {}
            Whole::ByOpacity if opacity > format.int(0) => factor /= &opacity,
            Whole::ByOpacity => factor = format.int(0),
            Whole::TimesOpacity => factor *= &opacity,
        }
        Composed {
            terms,
            passes,
            factor,
        }
    }

    fn layers<F: Format>(&self, ray: &Segments, step: f64, format: F) -> Vec<Layer<F::Real>> {
        let n = ray.count();
        let lambda = &ray.edges.lambda;
        let whole = format.binary64(lambda.last().copied().unwrap_or(0.0));
        let ends = lambda.iter().zip(lambda.iter().skip(1));
        let mut lengths: Vec<F::Real> = ends
            .map(|(&near, &far)| difference(far, near, format))
            .collect();
        let step_of = || format.binary64(step);
        let last = lengths.last().cloned().unwrap_or_else(step_of);
        let shortest = step_of() * &(format.int(1) - &format.fraction(1, 1_000_000_000));
        let partial = last < shortest;
        match self.sequence.last_step {
            LastStep::Own | LastStep::Dropped => {}
            LastStep::Whole => lengths.fill(step_of()),
            LastStep::Even => {
                let count = i64::try_from(n.max(1)).unwrap_or(i64::MAX);
                lengths.fill(whole.clone() / &format.int(count));
            }
        }
        let too_many = match self.sequence.extra {
            Some(Extra::Last) => last,
            Some(Extra::Step) | None => step_of(),
        };
        let back = matches!(
            self.scheme,
            Scheme::Sample {
                place: Place::Back,
                ..
            }
        );
        let order = self.sequence.without_seams(n, partial, back);
        let length_of = |index: isize| {
            let own = usize::try_from(index).ok().and_then(|i| lengths.get(i));
            own.unwrap_or(&too_many).clone()
        };
        let linear = self.scheme.linear(format);
        let (indices, mut layers): (Vec<isize>, Vec<Layer<F::Real>>) = order
            .iter()
            .filter_map(|&index| match &self.scheme {
                Scheme::Sample { place, law } => {
                    let node = place.node(index)?;
                    let extinction = format.binary64(extinction(ray, node)?);
                    let (weight, passes) = law.of(&extinction, &length_of(index), &whole);
                    let layer = Layer {
                        adds: vec![(node, weight)],
                        passes,
                    };
                    Some((index, layer))
                }
                Scheme::Segments {
                    depth,
                    weights,
                    scale,
                } => {
                    let i = usize::try_from(index).ok().filter(|i| *i < n)?;
                    let nodes = [Node::Edge(i), Node::Middle(i), Node::Edge(i + 1)];
                    let three = Three {
                        extinction: nodes
                            .map(|node| format.binary64(extinction(ray, node).unwrap_or(f64::NAN))),
                        length: length_of(index),
                    };
                    let x = three.depth(depth);
                    let mut all = weights.of(&three, &x, linear.as_ref());
                    if (scale.0 - 1.0).abs() > 0.0 {
                        let scale = format.binary64(scale.0);
                        for w in &mut all {
                            *w *= &scale;
                        }
                    }
                    let adds = nodes.into_iter().zip(all).collect();
                    let layer = Layer {
                        adds,
                        passes: (-x).exp(),
                    };
                    Some((index, layer))
                }
            })
            .unzip();
        self.put_wall(&mut layers, ray, format);
        if self.sequence.seam.is_none() {
            return layers;
        }
        // What stands behind all samples is at no seam.
        let times = indices.iter().map(|i| self.sequence.times(*i, n));
        let times = times.chain(std::iter::repeat(1));
        let repeated = |(layer, times)| std::iter::repeat_n(layer, times);
        layers.into_iter().zip(times).flat_map(repeated).collect()
    }

    /// The last sample, opaque, or its emission behind the ray.
    fn put_wall<F: Format>(&self, layers: &mut Vec<Layer<F::Real>>, ray: &Segments, format: F) {
        let Some(last) = layers.last_mut() else {
            return;
        };
        let Some(node) = last.adds.last().map(|(node, _)| *node) else {
            return;
        };
        // What is skipped absorbs nothing.
        let least = match &self.scheme {
            Scheme::Sample { law, .. } => law.range.skip_extinction,
            Scheme::Segments { .. } => None,
        };
        let counts = |tau: f64| tau > 0.0 && least.is_none_or(|least| tau >= least);
        let absorbs = extinction(ray, node).is_some_and(counts);
        // A factor of all weights is one of the wall's, too.
        let weight = format.binary64(self.scheme.scale());
        match self.wall {
            Some(Wall::Opaque) if absorbs => {
                last.adds = vec![(node, weight)];
                last.passes = format.int(0);
            }
            Some(Wall::LastEmission) => layers.push(Layer {
                adds: vec![(node, weight)],
                passes: format.int(0),
            }),
            Some(Wall::Length(length)) => {
                if let Scheme::Sample { law, .. } = &self.scheme
                    && let Some(tau) = extinction(ray, node)
                {
                    let whole = format.binary64(ray.edges.lambda.last().copied().unwrap_or(0.0));
                    let long = format.binary64(length);
                    let (weight, passes) = law.of(&format.binary64(tau), &long, &whole);
                    last.adds = vec![(node, weight)];
                    last.passes = passes;
                }
            }
            Some(Wall::Opaque) | None => {}
        }
    }

    /// What a channel's answer is before the output's map.
    pub fn radiance<F: Format>(
        &self,
        composed: &Composed<F::Real>,
        ray: &Segments,
        channel: usize,
        format: F,
    ) -> F::Real {
        let mut sum = format.int(0);
        for (node, weight) in &composed.terms {
            let emission = self.emission(emission(ray, *node, channel).unwrap_or(f64::NAN));
            let emission = self.emission.of(format.binary64(emission));
            sum += &(weight.clone() * &emission);
        }
        let mut x = sum * &composed.factor;
        if self.background.abs() > 0.0 {
            x += &(composed.passes.clone() * &format.binary64(self.background));
        }
        if self.offset.abs() > 0.0 {
            x += &format.binary64(self.offset);
        }
        x
    }

    /// Answers of all channels, in the places where the kernel has them.
    pub fn answers<F: Format>(&self, ray: &Segments, step: f64, format: F) -> Vec<F::Real> {
        let composed = self.composed(ray, step, format);
        let count = ray.edges.emission.len();
        let mut answers = vec![format.int(0); count];
        for channel in 0..count {
            let x = self.radiance(&composed, ray, channel, format);
            answers[self.channels.place(channel, count)] = self.output.of(x);
        }
        answers
    }

    /// C as it counts.
    fn emission(&self, c: f64) -> f64 {
        let c = self.emission_max.map_or(c, |most| c.min(most));
        self.emission_min.map_or(c, |least| c.max(least))
    }

    /// By how many units of 1 subtraction may put the weights of all segments off, where that is more than one each.
    #[must_use]
    pub(in crate::identify) fn cancels(&self, ray: &Segments) -> f64 {
        let Scheme::Segments {
            depth,
            weights: Segment::LinearInDepth { .. },
            ..
        } = &self.scheme
        else {
            return 0.0;
        };
        // 1 − (1 − e^(−x))/x loses 1/x, unless a series takes over.
        let lengths: Vec<f64> = ray.lengths().collect();
        let of = |(i, length): (usize, &f64)| {
            let nodes = [Node::Edge(i), Node::Middle(i), Node::Edge(i + 1)];
            let three = Three {
                extinction: nodes.map(|node| extinction(ray, node).unwrap_or(f64::NAN)),
                length: *length,
            };
            1.0 / three.depth(depth).max(1e-4)
        };
        lengths.iter().enumerate().map(of).sum()
    }

    /// The scale of the weights, at least 1.
    #[must_use]
    pub(in crate::identify) fn largest_scale(&self) -> f64 {
        self.scheme.scale().abs().max(1.0)
    }
}

/// far − near, rounded once.
fn difference<F: Format>(far: f64, near: f64, format: F) -> F::Real {
    let rounded = far - near;
    // What rounding took (Knuth's two-sum): nothing of neighbours on a ray, but for the very first.
    let taken = far - rounded;
    let lost = (far - (rounded + taken)) - (near - taken);
    if lost == 0.0 {
        return format.binary64(rounded);
    }
    let exact = Rational::from_f64(far).zip(Rational::from_f64(near));
    exact.map_or_else(
        || format.binary64(f64::NAN),
        |(far, near)| format.ratio(&(far - near)),
    )
}

/// τ at a node.
#[must_use]
pub(crate) fn extinction(ray: &Segments, node: Node) -> Option<f64> {
    match node {
        Node::Edge(i) => ray.edges.extinction.get(i).copied(),
        Node::Middle(i) => ray.middles.extinction.get(i).copied(),
    }
}

/// C at a node.
#[must_use]
pub(crate) fn emission(ray: &Segments, node: Node, channel: usize) -> Option<f64> {
    match node {
        Node::Edge(i) => ray.edges.emission.get(channel)?.get(i).copied(),
        Node::Middle(i) => ray.middles.emission.get(channel)?.get(i).copied(),
    }
}

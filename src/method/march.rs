//! Ray marching: nested rules that look at boundaries alone, in one pass and constant memory.

use super::error::{MethodError, require_multiple};
use super::outer::CompositeWeights;
use super::{Exponential, Inner, Outer, Scope};
use crate::case::{Nodes, Number, Transfer};
use crate::quadrature::Rule;
use crate::real::{Format, Real};
use rug::Rational;

/// The radiance by marching, with the same bits as from columns of nodes; `None` where one of the
/// rules looks inside segments or at more than one of them.
pub(super) fn radiance<N: Nodes>(
    inner: Inner,
    outer: Outer,
    exponential: Exponential,
    scope: Scope,
    nodes: &N,
    n: u64,
) -> Option<Result<Number<N>, MethodError>> {
    let Inner::PerSegment(rule) = inner else {
        return None;
    };
    let intervals = outer.0.intervals()?;
    let weights = require_multiple(&outer.0, n, outer.segments_multiple())
        .and_then(|()| CompositeWeights::new(outer.0, intervals, nodes.format()));
    let weights = match weights {
        Ok(weights) => weights,
        Err(error) => return Some(Err(error)),
    };
    let how = (exponential, scope);
    let half = nodes.format().fraction(1, 2);
    // One loop a rule: a choice inside the loop would cost as much as the rule itself.
    Some(Ok(match rule {
        Rule::RiemannLeft => march(how, nodes, n, &weights, |front, _| front),
        Rule::RiemannRight => march(how, nodes, n, &weights, |_, back| back.clone()),
        Rule::Trapezoid => march(how, nodes, n, &weights, |front, back| {
            front * &half + &(back.clone() * &half)
        }),
        _ => return None,
    }))
}

/// `mean` gives a segment's mean extinction from the values at its front and its back.
#[inline]
fn march<N: Nodes>(
    (exponential, scope): (Exponential, Scope),
    nodes: &N,
    n: u64,
    weights: &CompositeWeights<Number<N>>,
    mean: impl Fn(Number<N>, &Number<N>) -> Number<N>,
) -> Number<N> {
    let format = nodes.format();
    let step = format.ratio(&(Rational::from(nodes.length()) / n));
    let segment = |front, back: &Number<N>| mean(front, back) * &step;
    let radiance = match (nodes.everywhere(), scope) {
        (Some(transfer), _) => even((exponential, scope), n, weights, transfer, segment),
        (None, Scope::Whole) if N::Format::IN_LANES => {
            in_rows(exponential, nodes, n, weights, segment)
        }
        (None, Scope::Whole) => {
            let mut depth = format.int(0);
            let start = exponential.of_negative(&depth);
            accumulate(nodes, n, weights, start, |front, back, transmittance| {
                depth += &segment(front, back);
                exponential.set_of_negative(transmittance, &depth);
            })
        }
        (None, Scope::PerSegment) => {
            let start = format.int(1);
            accumulate(nodes, n, weights, start, |front, back, transmittance| {
                *transmittance *= &exponential.of_negative(&segment(front, back));
            })
        }
    };
    radiance * &step
}

/// ∑ W C τ T from front to back, in units of the step; `attenuate` takes T across a segment, given the
/// extinction at its front and its back.
#[inline]
fn accumulate<N: Nodes>(
    nodes: &N,
    n: u64,
    outer: &CompositeWeights<Number<N>>,
    mut transmittance: Number<N>,
    mut attenuate: impl FnMut(Number<N>, &Number<N>, &mut Number<N>),
) -> Number<N> {
    let mut sum = nodes.format().int(0);
    let inside = usize::try_from(n - 1).unwrap_or(usize::MAX);
    let mut places = nodes.march(n);
    let Some(first) = places.next() else {
        return sum;
    };
    let mut front = first.extinction.clone();
    sum += &(first.emission * &first.extinction * &transmittance * &outer.first);
    // Groups of segments repeat their weights; the last place has one of its own.
    let mut add = |front, place: Transfer<Number<N>>, weight| {
        attenuate(front, &place.extinction, &mut transmittance);
        sum += &(place.emission * &place.extinction * &transmittance * weight);
        place.extinction
    };
    if let [weight] = &outer.repeating[..] {
        for place in places.by_ref().take(inside) {
            front = add(front, place, weight);
        }
    } else {
        let weights = outer.repeating.iter().cycle().skip(1);
        for (place, weight) in places.by_ref().take(inside).zip(weights) {
            front = add(front, place, weight);
        }
    }
    if let Some(place) = places.next() {
        add(front, place, &outer.last);
    }
    sum
}

/// The same of a ray that is the same everywhere; `depth_of` gives the depth of its segments.
fn even<R: Real>(
    (exponential, scope): (Exponential, Scope),
    n: u64,
    outer: &CompositeWeights<R>,
    transfer: Transfer<R>,
    depth_of: impl Fn(R, &R) -> R,
) -> R {
    let Transfer {
        emission,
        extinction,
    } = transfer;
    let format = extinction.format();
    let source = emission * &extinction;
    let segment = depth_of(extinction.clone(), &extinction);
    let mut depth = format.int(0);
    let mut sum = depth.clone();
    let (mut transmittance, through) = match scope {
        Scope::Whole => (exponential.of_negative(&depth), None),
        Scope::PerSegment => (format.int(1), Some(exponential.of_negative(&segment))),
    };
    for j in 0..=n {
        match &through {
            _ if j == 0 => {}
            Some(through) => transmittance *= through,
            None => {
                depth += &segment;
                exponential.set_of_negative(&mut transmittance, &depth);
            }
        }
        sum += &(source.clone() * &transmittance * outer.at(j, n));
    }
    sum
}

/// The same of the whole depth, the transmittances of a row together; `depth_of` gives a segment's depth.
fn in_rows<N: Nodes>(
    exponential: Exponential,
    nodes: &N,
    n: u64,
    outer: &CompositeWeights<Number<N>>,
    depth_of: impl Fn(Number<N>, &Number<N>) -> Number<N>,
) -> Number<N> {
    let mut depth = nodes.format().int(0);
    let mut sum = depth.clone();
    let mut front: Option<Number<N>> = None;
    let mut j = 0;
    for places in nodes.rows(n) {
        let mut depths = Vec::with_capacity(places.extinction.len());
        for extinction in &places.extinction {
            if let Some(front) = front.replace(extinction.clone()) {
                depth += &depth_of(front, extinction);
            }
            depths.push(depth.clone());
        }
        let transmittances = exponential.of_negatives(&depths);
        let sources = places.emission.into_iter().zip(&places.extinction);
        for ((emission, extinction), transmittance) in sources.zip(&transmittances) {
            sum += &(emission * extinction * transmittance * outer.at(j, n));
            j += 1;
        }
    }
    sum
}

//! The optical depth from random samples.

use super::OpticalDepth;
use crate::case::{Nodes, Number};
use crate::quadrature::{Draws, Sampling};
use crate::real::{Format, row};
use rug::Rational;

pub(super) fn depth<N: Nodes>(
    sampling: Sampling,
    seed: u64,
    nodes: &N,
    n: u64,
) -> OpticalDepth<Number<N>> {
    let format = nodes.format();
    let mut draws = Draws::new(seed, n);
    let zero = format.int(0);
    match sampling {
        Sampling::Shared => {
            let whole = Rational::from(1);
            let segments = shared(&mut draws, nodes, n, &whole);
            OpticalDepth::from_segments(segments, zero)
        }
        Sampling::Stratified => {
            let whole = Rational::from(1);
            let segments = stratified(&mut draws, nodes, n, &whole);
            OpticalDepth::from_segments(segments, zero)
        }
        Sampling::Independent => {
            let mut boundaries = vec![zero];
            for i in 1..=n {
                let position = Rational::from((i, n));
                boundaries.push(independent(&mut draws, nodes, n, &position));
            }
            OpticalDepth::from_boundaries(boundaries)
        }
    }
}

/// See [`super::Inner::partial_depths`].
pub(super) fn partial_depths<N: Nodes>(
    sampling: Sampling,
    seed: u64,
    nodes: &N,
    n: u64,
    offset: &Rational,
    depth: &OpticalDepth<Number<N>>,
) -> Vec<Number<N>> {
    match sampling {
        // The same samples as for the boundaries, those before the offset.
        Sampling::Shared => shared(&mut Draws::new(seed, n), nodes, n, offset),
        // Others, from a stream that no level of this seed uses; the same for every offset.
        Sampling::Stratified => stratified(&mut inside_stream(seed, n), nodes, n, offset),
        Sampling::Independent => {
            let mut draws = inside_stream(seed, n);
            row((0..n).zip(&depth.boundaries).map(|(j, front)| {
                let position = Rational::from(offset + j) / n;
                independent(&mut draws, nodes, n, &position) - front
            }))
        }
    }
}

fn inside_stream(seed: u64, n: u64) -> Draws {
    Draws::new(!seed, n)
}

/// n samples on [0, D): those of each segment that lie before `offset`, times D/n.
fn shared<N: Nodes>(draws: &mut Draws, nodes: &N, n: u64, offset: &Rational) -> Vec<Number<N>> {
    let format = nodes.format();
    let length = format.ratio(nodes.length());
    let step = format.ratio(&(Rational::from(nodes.length()) / n));
    let mut segments: Vec<Number<N>> = row((0..n).map(|_| format.int(0)));
    let before = row((0..n).filter_map(|_| {
        let draw = draws.draw();
        let (segment, part) = draw.segment(n);
        (part < *offset).then_some((draw, segment))
    }));
    let places = row(before.iter().map(|(draw, _)| draw.at(format) * &length));
    for ((_, segment), tau) in before.iter().zip(nodes.extinctions_at(&places)) {
        if let Some(sum) = segments.get_mut(*segment) {
            *sum += &tau;
        }
    }
    for sum in &mut segments {
        *sum *= &step;
    }
    segments
}

/// One sample in the first `offset` of each segment.
fn stratified<N: Nodes>(draws: &mut Draws, nodes: &N, n: u64, offset: &Rational) -> Vec<Number<N>> {
    let format = nodes.format();
    let length = format.ratio(nodes.length());
    let width = format.ratio(&(Rational::from(offset * nodes.length()) / n));
    let places = row((0..n).map(|j| {
        let front = format.fraction(j, n) * &length;
        draws.draw().at(format) * &width + &front
    }));
    let extinctions = nodes.extinctions_at(&places).into_iter();
    row(extinctions.map(|tau| tau * &width))
}

/// The depth up to λ = D·position from n samples on [0, λ).
fn independent<N: Nodes>(draws: &mut Draws, nodes: &N, n: u64, position: &Rational) -> Number<N> {
    let format = nodes.format();
    let lambda = format.ratio(&Rational::from(position * nodes.length()));
    let places = row((0..n).map(|_| draws.draw().at(format) * &lambda));
    let mut sum = format.int(0);
    for tau in nodes.extinctions_at(&places) {
        sum += &tau;
    }
    sum * &lambda * &format.fraction(1, n)
}

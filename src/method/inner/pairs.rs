//! Simpson's rule over pairs of segments, with two ways to fill the odd boundaries.

use crate::case::{Nodes, Number};
use crate::real::{Format, Real};
use rug::Rational;
use std::fmt;

/// How the depth at the middle of a pair of segments is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filling {
    /// The integral of the parabola through the pair's three values: d (5τ₀ + 8τ₁ − τ₂)/12 at the
    /// middle. Leaves O(d⁴) at odd boundaries, so the method keeps order 4.
    Parabola,
    /// One trapezoid, d (τ₀ + τ₁)/2 at the middle. Leaves O(d³) at odd boundaries: order 3.
    Trapezoid,
}

impl Filling {
    /// The order of the depth over all boundaries, and the degree that is exact at all of them.
    pub(super) fn order_and_degree(self) -> (f64, usize) {
        match self {
            Filling::Parabola => (4.0, 2),
            Filling::Trapezoid => (3.0, 1),
        }
    }
}

impl fmt::Display for Filling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Filling::Parabola => "simpson-pairs-parabola",
            Filling::Trapezoid => "simpson-pairs-trapezoid",
        })
    }
}

/// The depth of every segment; the two of a pair add up to Simpson's rule.
pub(super) fn segment_depths<N: Nodes>(filling: Filling, nodes: &N, n: u64) -> Vec<Number<N>> {
    let format = nodes.format();
    let column = nodes.boundaries(n);
    let step = format.ratio(&(Rational::from(nodes.length()) / n));
    let simpson = coefficients(format, [(1, 3), (4, 3), (1, 3)]);
    let first = match filling {
        Filling::Parabola => coefficients(format, [(5, 12), (2, 3), (-1, 12)]),
        Filling::Trapezoid => coefficients(format, [(1, 2), (1, 2), (0, 1)]),
    };
    let mut depths = Vec::with_capacity(column.extinction.len());
    for pair in column.extinction.windows(3).step_by(2) {
        let front = combine(&first, pair) * &step;
        let back = combine(&simpson, pair) * &step - &front;
        depths.push(front);
        depths.push(back);
    }
    depths
}

/// For each segment the depth from its front to `offset` of its length, from the pair's interpolant:
/// the parabola, or the chord of the segment.
pub(super) fn partial_depths<N: Nodes>(
    filling: Filling,
    nodes: &N,
    n: u64,
    offset: &Rational,
) -> Vec<Number<N>> {
    let format = nodes.format();
    let column = nodes.boundaries(n);
    let step = format.ratio(&(Rational::from(nodes.length()) / n));
    // Antiderivatives at places u of the pair, measured in segments.
    let front = match filling {
        Filling::Parabola => parabola(offset),
        Filling::Trapezoid => chord(offset),
    };
    let back = match filling {
        Filling::Parabola => {
            let (one, end) = (Rational::from(1), Rational::from(offset + 1));
            let (from, to) = (parabola(&one), parabola(&end));
            [0, 1, 2].map(|k| Rational::from(&to[k] - &from[k]))
        }
        Filling::Trapezoid => {
            let [a, b, zero] = chord(offset);
            [zero, a, b]
        }
    };
    let round = |c: [Rational; 3]| c.map(|c| format.ratio(&c));
    let (front, back) = (round(front), round(back));
    let mut depths = Vec::with_capacity(column.extinction.len());
    for pair in column.extinction.windows(3).step_by(2) {
        depths.push(combine(&front, pair) * &step);
        depths.push(combine(&back, pair) * &step);
    }
    depths
}

/// ∫₀ᵘ of the three Lagrange polynomials on 0, 1, 2.
fn parabola(u: &Rational) -> [Rational; 3] {
    let square = Rational::from(u.square_ref());
    let cube = Rational::from(&square * u);
    let term = |a: (i32, i32), b: (i32, i32), c: i32| {
        Rational::from(a) * &cube + Rational::from(b) * &square + Rational::from(c) * u
    };
    [
        term((1, 6), (-3, 4), 1),
        term((-1, 3), (1, 1), 0),
        term((1, 6), (-1, 4), 0),
    ]
}

/// ∫₀ᵘ of the two linear interpolation polynomials on 0, 1.
fn chord(u: &Rational) -> [Rational; 3] {
    let half_square = Rational::from(u.square_ref()) / 2_u32;
    [
        Rational::from(u - &half_square),
        half_square,
        Rational::new(),
    ]
}

fn coefficients<F: Format>(format: F, ratios: [(i32, i32); 3]) -> [F::Real; 3] {
    ratios.map(|ratio| format.ratio(&Rational::from(ratio)))
}

/// Σ cₖ τₖ over a pair's three values.
fn combine<R: Real>(coefficients: &[R; 3], values: &[R]) -> R {
    let mut sum = coefficients[0].format().int(0);
    for (coefficient, value) in coefficients.iter().zip(values) {
        sum += &(coefficient.clone() * value);
    }
    sum
}

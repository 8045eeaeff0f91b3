//! The field along a segment, as a polynomial in x ∈ [0, 1].

use crate::case::{Nodes, Number, Structure};
use crate::method::error::MethodError;
use crate::real::{Format, Real, row, try_row};
use rug::Rational;
use std::fmt;

/// Where the one-sided parabola of the last segment takes its third sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LastSegment {
    /// One step beyond the far end: needs an analytic field.
    Beyond,
    /// One segment back. The order is the same.
    Backward,
}

/// A polynomial through samples of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolant {
    /// Through both ends of the segment: order 2 (Engel, Kraus and Ertl 2001).
    Linear,
    /// The parabola through samples i, i + 1, i + 2, used on [i, i + 1]: order 3 (El Hajjar et al. 2008).
    Quadratic(LastSegment),
    /// The parabola through both ends and the middle: order 4, by symmetry.
    QuadraticMidpoint,
}

impl Interpolant {
    /// The degree of the polynomial.
    #[must_use]
    pub fn degree(self) -> usize {
        match self {
            Interpolant::Linear => 1,
            Interpolant::Quadratic(_) | Interpolant::QuadraticMidpoint => 2,
        }
    }

    /// The order of ∫ f(s̄) over the ray for smooth f.
    #[must_use]
    pub fn order(self) -> f64 {
        match self {
            Interpolant::Linear => 2.0,
            Interpolant::Quadratic(_) => 3.0,
            Interpolant::QuadraticMidpoint => 4.0,
        }
    }

    pub(in crate::method) fn check_segments(self, n: u64) -> Result<(), MethodError> {
        let least = match self {
            Interpolant::Quadratic(LastSegment::Backward) => 2,
            _ => 1,
        };
        if n < least {
            return Err(MethodError::TooFewSegments {
                interpolant: self.to_string(),
                n,
                least,
            });
        }
        Ok(())
    }

    /// Whether it reproduces the field of such a case.
    pub(super) fn is_exact(self, structure: &Structure) -> bool {
        structure.field_degree.is_some_and(|d| d <= self.degree())
    }

    /// The coefficients of each segment's polynomial, lowest first.
    pub(super) fn segments<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
    ) -> Result<Vec<Vec<Number<N>>>, MethodError> {
        self.check_segments(n)?;
        let column = nodes.boundaries(n);
        let ends = column.field.windows(2);
        Ok(match self {
            Interpolant::Linear => row(ends.map(|s| vec![s[0].clone(), s[1].clone() - &s[0]])),
            Interpolant::QuadraticMidpoint => {
                let middle = nodes.interior(n, &Rational::from((1, 2)));
                let both = ends.zip(&middle.field);
                row(both.map(|(s, m)| through_middle(&s[0], m, &s[1])))
            }
            Interpolant::Quadratic(last) => {
                let triples = column.field.windows(3);
                let mut segments = row(triples.map(|s| forward(&s[0], &s[1], &s[2])));
                match (last, &column.field[..]) {
                    (LastSegment::Beyond, [.., a, b]) => {
                        segments.push(forward(a, b, &nodes.beyond(n)));
                    }
                    (LastSegment::Backward, [.., a, b, c]) => segments.push(backward(a, b, c)),
                    _ => {}
                }
                segments
            }
        })
    }

    /// What `integrate` makes of each segment's polynomial: once, where all are the same.
    pub(super) fn integrals<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        integrate: impl Fn(&[Number<N>]) -> Result<Number<N>, MethodError>,
    ) -> Result<Vec<Number<N>>, MethodError> {
        let of_all = |n| {
            let fields = self.segments(nodes, n)?;
            try_row(fields.iter().map(|field| integrate(field)))
        };
        // Parabolas have formulas of their own at the far end.
        if self == Interpolant::Linear && n > 0 && nodes.everywhere().is_some() {
            let count = usize::try_from(n).unwrap_or(usize::MAX);
            let first = of_all(1)?;
            return Ok(first.into_iter().cycle().take(count).collect());
        }
        of_all(n)
    }
}

impl fmt::Display for Interpolant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Interpolant::Linear => "linear",
            Interpolant::Quadratic(LastSegment::Beyond) => "quadratic",
            Interpolant::Quadratic(LastSegment::Backward) => "quadratic-backward",
            Interpolant::QuadraticMidpoint => "quadratic-midpoint",
        })
    }
}

/// a − 2b + c.
fn second_difference<R: Real>(a: &R, b: &R, c: &R) -> R {
    let mut difference = a.clone() - b;
    difference -= b;
    difference + c
}

/// Through (0, a), (1, b), (2, c).
fn forward<R: Real>(a: &R, b: &R, c: &R) -> Vec<R> {
    let square = second_difference(a, b, c) / &a.format().int(2);
    let slope = b.clone() - a - &square;
    vec![a.clone(), slope, square]
}

/// Through (−1, a), (0, b), (1, c).
fn backward<R: Real>(a: &R, b: &R, c: &R) -> Vec<R> {
    let two = a.format().int(2);
    let square = second_difference(a, b, c) / &two;
    let slope = (c.clone() - a) / &two;
    vec![b.clone(), slope, square]
}

/// Through (0, a), (½, m), (1, b).
fn through_middle<R: Real>(a: &R, m: &R, b: &R) -> Vec<R> {
    let square = second_difference(a, m, b) * &a.format().int(2);
    let slope = b.clone() - a - &square;
    vec![a.clone(), slope, square]
}

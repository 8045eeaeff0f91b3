//! Newton-Cotes rules over groups of segments, and how the boundaries inside a group are filled.

use crate::case::{Nodes, Number};
use crate::real::{Format, row};
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

impl fmt::Display for Filling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Filling::Parabola => "simpson-pairs-parabola",
            Filling::Trapezoid => "simpson-pairs-trapezoid",
        })
    }
}

/// A rule over a group of segments.
#[derive(Clone, Copy, Debug)]
pub(super) enum Group {
    /// Simpson's over two.
    Pair(Filling),
    /// Boole's over four, boundaries inside by the polynomial through all five values: O(d⁶) there too.
    Four,
}

impl Group {
    /// How many segments.
    pub(super) fn size(self) -> u64 {
        match self {
            Group::Pair(_) => 2,
            Group::Four => 4,
        }
    }

    /// The order of the depth over all boundaries, and the degree that is exact at all of them.
    pub(super) fn order_and_degree(self) -> (f64, usize) {
        match self {
            Group::Pair(Filling::Parabola) => (4.0, 2),
            Group::Pair(Filling::Trapezoid) => (3.0, 1),
            Group::Four => (6.0, 4),
        }
    }

    /// The weights of the group's values, from the front to the end of its last segment.
    fn whole(self) -> Vec<Rational> {
        let last = self.size();
        antiderivatives(last, &Rational::from(last))
    }

    /// The same from the front of a segment to `offset` of its length.
    fn part(self, segment: u64, offset: &Rational) -> Vec<Rational> {
        let last = self.size();
        if let Group::Pair(Filling::Trapezoid) = self {
            let [front, back] = chord(offset);
            let weight = |k: u64| match k.checked_sub(segment) {
                Some(0) => front.clone(),
                Some(1) => back.clone(),
                _ => Rational::new(),
            };
            return row((0..=last).map(weight));
        }
        let from = antiderivatives(last, &Rational::from(segment));
        let to = antiderivatives(last, &Rational::from(offset + segment));
        row(to.into_iter().zip(from).map(|(to, from)| to - from))
    }
}

/// The depth of every segment; those of a group add up to its rule.
pub(super) fn segment_depths<N: Nodes>(group: Group, nodes: &N, n: u64) -> Vec<Number<N>> {
    let (format, one) = (nodes.format(), Rational::from(1));
    let whole = rounded(format, &group.whole());
    let but_last = 0..group.size() - 1;
    let parts = row(but_last.map(|segment| rounded(format, &group.part(segment, &one))));
    by_groups(group, nodes, n, |values, step, depths| {
        let mut left = combine(format, &whole, values) * step;
        for part in &parts {
            let depth = combine(format, part, values) * step;
            left -= &depth;
            depths.push(depth);
        }
        depths.push(left);
    })
}

/// For each segment the depth from its front to `offset` of its length, from the group's interpolant:
/// the polynomial, or the chord of the segment.
pub(super) fn partial_depths<N: Nodes>(
    group: Group,
    nodes: &N,
    n: u64,
    offset: &Rational,
) -> Vec<Number<N>> {
    let format = nodes.format();
    let all = 0..group.size();
    let parts = row(all.map(|segment| rounded(format, &group.part(segment, offset))));
    by_groups(group, nodes, n, |values, step, depths| {
        depths.extend(
            parts
                .iter()
                .map(|part| combine(format, part, values) * step),
        );
    })
}

/// Depths, added group by group from τ at its boundaries and the length of a segment.
fn by_groups<N: Nodes>(
    group: Group,
    nodes: &N,
    n: u64,
    mut add: impl FnMut(&[Number<N>], &Number<N>, &mut Vec<Number<N>>),
) -> Vec<Number<N>> {
    let column = nodes.boundaries(n);
    let step = nodes.format().ratio(&(Rational::from(nodes.length()) / n));
    let mut depths = Vec::with_capacity(column.extinction.len());
    #[expect(clippy::cast_possible_truncation, reason = "2 or 4")]
    let size = group.size() as usize;
    for values in column.extinction.windows(size + 1).step_by(size) {
        add(values, &step, &mut depths);
    }
    depths
}

/// ∫₀ᵘ of each Lagrange polynomial on 0, 1, … last.
fn antiderivatives(last: u64, u: &Rational) -> Vec<Rational> {
    row((0..=last).map(|k| {
        // Coefficients from the constant one up.
        let mut polynomial = vec![Rational::from(1)];
        for other in (0..=last).filter(|other| *other != k) {
            let apart = Rational::from(k) - other;
            let mut times = vec![Rational::new(); polynomial.len() + 1];
            for (i, coefficient) in polynomial.into_iter().enumerate() {
                let scaled = coefficient / &apart;
                times[i] -= Rational::from(&scaled * other);
                times[i + 1] += scaled;
            }
            polynomial = times;
        }
        let mut power = u.clone();
        let mut sum = Rational::new();
        for (degree, coefficient) in (1_u32..).zip(polynomial) {
            sum += Rational::from(&coefficient * &power) / degree;
            power *= u;
        }
        sum
    }))
}

/// ∫₀ᵘ of the two linear interpolation polynomials on 0, 1.
fn chord(u: &Rational) -> [Rational; 2] {
    let half_square = Rational::from(u.square_ref()) / 2_u32;
    [Rational::from(u - &half_square), half_square]
}

fn rounded<F: Format>(format: F, weights: &[Rational]) -> Vec<F::Real> {
    row(weights.iter().map(|weight| format.ratio(weight)))
}

/// Σ cₖ τₖ over a group's values.
fn combine<F: Format>(format: F, coefficients: &[F::Real], values: &[F::Real]) -> F::Real {
    let mut sum = format.int(0);
    for (coefficient, value) in coefficients.iter().zip(values) {
        sum += &(coefficient.clone() * value);
    }
    sum
}

//! Where in its segment a sample lies.

use super::length;
use crate::case::{Nodes, Number, Transfer};
use crate::quadrature::Rule;
use rug::Rational;
use std::fmt;

/// Where in its segment C and τ are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Position {
    /// λ = j d, the end nearer to the eye.
    Front,
    /// λ = (j + ½) d.
    Middle,
    /// λ = (j + 1) d.
    Back,
}

impl Position {
    /// The rule for ∫ τ that such samples make.
    pub(super) fn rule(self) -> Rule {
        match self {
            Position::Front => Rule::RiemannLeft,
            Position::Middle => Rule::Midpoint,
            Position::Back => Rule::RiemannRight,
        }
    }

    /// C and τ at the n samples, from front to back.
    pub(super) fn march<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
    ) -> impl Iterator<Item = Transfer<Number<N>>> + use<'_, N> {
        match self {
            Position::Middle => {
                let half = Rational::from((1, 2));
                March::Inside(nodes.march_inside(n, half))
            }
            // Ends of segments are boundaries, which neighbours and other methods share.
            Position::Front | Position::Back => {
                let first = usize::from(self == Position::Back);
                March::Boundaries(nodes.march(n).skip(first).take(length(n)))
            }
        }
    }
}

/// One of two ways along the ray.
enum March<I, B> {
    Inside(I),
    Boundaries(B),
}

impl<T, I: Iterator<Item = T>, B: Iterator<Item = T>> Iterator for March<I, B> {
    type Item = T;

    #[inline]
    fn next(&mut self) -> Option<T> {
        match self {
            March::Inside(inside) => inside.next(),
            March::Boundaries(boundaries) => boundaries.next(),
        }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Position::Front => "front",
            Position::Middle => "middle",
            Position::Back => "back",
        })
    }
}

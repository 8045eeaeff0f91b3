//! Monte Carlo: which random samples estimate an integral, and where the random numbers come from.
//!
//! What is random decides the order (measured as root mean square error over replicas with an outer
//! trapezoid or better): one set shared by all nodes ½, fresh samples at every node 1, one stratified
//! sample a segment 3⁄2.

use crate::real::Format;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::Rational;
use std::fmt;

/// Which random samples the inner integral uses when the ray has n segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sampling {
    /// n samples on [0, D]; the optical depth at λ uses those before λ.
    Shared,
    /// n fresh samples on [0, λ] for every λ.
    Independent,
    /// One sample in every segment.
    Stratified,
}

impl Sampling {
    /// The order of the radiance's standard deviation under an outer rule of higher order.
    #[must_use]
    pub fn order(self) -> f64 {
        match self {
            Sampling::Shared => 0.5,
            Sampling::Independent => 1.0,
            Sampling::Stratified => 1.5,
        }
    }
}

impl fmt::Display for Sampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Sampling::Shared => f.pad("monte-carlo"),
            Sampling::Independent => f.pad("monte-carlo-independent"),
            Sampling::Stratified => f.pad("monte-carlo-stratified"),
        }
    }
}

/// A reproducible stream of random numbers: multiples of 2⁻⁵³ in [0, 1), the same on every platform
/// and, up to one rounding, in every format (PCG XSL RR 128/64, O'Neill 2014).
pub struct Draws {
    generator: Pcg64,
}

impl Draws {
    /// The stream of `seed` for a run of `n` segments: levels draw independently of each other.
    #[must_use]
    pub fn new(seed: u64, n: u64) -> Self {
        // Spread the seeds far apart, so that neighbouring seeds never meet at neighbouring levels.
        let key = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(n);
        Draws {
            generator: Pcg64::seed_from_u64(key),
        }
    }

    /// The next number.
    pub fn draw(&mut self) -> Draw {
        Draw {
            numerator: self.generator.next_u64() >> 11,
        }
    }
}

/// One random number, numerator · 2⁻⁵³.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draw {
    /// Below 2⁵³.
    pub numerator: u64,
}

impl Draw {
    const DENOMINATOR: u64 = 1 << 53;

    /// The number in `format`, rounded once.
    pub fn at<F: Format>(self, format: F) -> F::Real {
        format.fraction(self.numerator, Self::DENOMINATOR)
    }

    /// The number, which binary64 has.
    #[must_use]
    pub fn value(self) -> f64 {
        self.numerator as f64 / Self::DENOMINATOR as f64
    }

    /// Which of n equal parts of [0, 1) it lies in: the same in every format.
    #[must_use]
    pub fn part(self, n: u64) -> usize {
        let scaled = u128::from(self.numerator) * u128::from(n);
        usize::try_from(scaled / u128::from(Self::DENOMINATOR)).unwrap_or(usize::MAX)
    }

    /// That part, and where in it the number lies.
    #[must_use]
    pub fn segment(self, n: u64) -> (usize, Rational) {
        let scaled = u128::from(self.numerator) * u128::from(n);
        let one = u128::from(Self::DENOMINATOR);
        (self.part(n), Rational::from((scaled % one, one)))
    }
}

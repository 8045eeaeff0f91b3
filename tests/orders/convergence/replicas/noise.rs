//! Distributions of mean 0 and variance 1.

use crate::convergence::random::Random;

#[derive(Clone, Copy, Debug)]
pub(super) enum Noise {
    Normal,
    Uniform,
    /// Student's t of five degrees of freedom.
    HeavyTailed,
    /// χ² of one degree of freedom: skewed, with heavy tails.
    ChiSquared,
}

impl Noise {
    pub(super) fn draw(self, random: &mut Random) -> f64 {
        match self {
            Noise::Normal => random.normal(),
            Noise::Uniform => random.uniform(-1.0, 1.0) * 3_f64.sqrt(),
            Noise::HeavyTailed => {
                let squares: f64 = (0..5).map(|_| random.normal().powi(2)).sum();
                random.normal() * (3.0 / squares).sqrt()
            }
            Noise::ChiSquared => (random.normal().powi(2) - 1.0) / 2_f64.sqrt(),
        }
    }
}

//! Random cases: smooth media with an emission that is a polynomial of the depth, so that each has an exact
//! radiance.
//!
//! Every part of the depth never falls and every part of the emission is never negative, whatever its
//! numbers are. So any choice of parts is a case, and leaving parts out gives a simpler one: that is what
//! property tests need in order to shrink what fails.

mod emit;
mod grow;
mod shrink;

pub use emit::Emit;
pub use grow::Grow;

use super::file::{Description, FileError};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::Rational;
use std::fmt;

/// Depths of the whole ray lie between these numbers, up to the binary64 they are scaled in.
const DEPTHS: (f64, f64) = (0.2, 6.0);

/// A random case. [`Display`](fmt::Display) prints its case file.
///
/// ```
/// use volver::case::manufacture::manufacture;
/// use volver::case::random::RandomCase;
///
/// let case = RandomCase::from_seed(7);
/// assert_eq!(case, RandomCase::from_seed(7));
/// assert_eq!(manufacture(&case.description()?)?.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomCase {
    /// D > 0.
    pub length: Rational,
    /// s(λ).
    pub field: Field,
    /// t(λ) is their sum; at least one.
    pub depth: Vec<Grow>,
    /// C as a function of the depth is their sum; at least one.
    pub emission: Vec<Emit>,
}

/// The fields of random cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Field {
    /// s = λ.
    Position,
    /// s = (1 + λ)².
    Square,
    /// s = e^(−λ).
    Decay,
    /// s = 1/(1 + λ).
    Reciprocal,
}

impl Field {
    /// s(λ) and λ(s), where it is not λ itself.
    fn texts(self) -> Option<(&'static str, &'static str)> {
        match self {
            Field::Position => None,
            Field::Square => Some(("(1 + lambda)^2", "sqrt(s) - 1")),
            Field::Decay => Some(("exp(-lambda)", "-ln(s)")),
            Field::Reciprocal => Some(("1/(1 + lambda)", "1/s - 1")),
        }
    }
}

impl RandomCase {
    /// The case of that seed, the same on every platform.
    #[must_use]
    pub fn from_seed(seed: u64) -> RandomCase {
        let mut draw = Draw(Pcg64::seed_from_u64(seed));
        let length = draw.number(1, 6) / 2;
        let field = match draw.below(8) {
            0..4 => Field::Position,
            4 => Field::Square,
            5 | 6 => Field::Decay,
            _ => Field::Reciprocal,
        };
        // A decaying field makes transfer functions polynomials of decays alone.
        let decays_only = field == Field::Decay && draw.below(2) == 0;
        let parts = 1 + draw.below(3);
        let depth: Vec<Grow> = (0..parts)
            .map(|_| Grow::draw(&mut draw, decays_only))
            .collect();
        let parts = 1 + draw.below(2);
        let emission = (0..parts).map(|_| Emit::draw(&mut draw)).collect();
        let mut case = RandomCase {
            length,
            field,
            depth,
            emission,
        };
        case.scale_depth();
        case
    }

    /// Doubles or halves all of the depth until it is of use: neither nothing to see nor too thick.
    fn scale_depth(&mut self) {
        let length = self.length.to_f64();
        let (least, greatest) = DEPTHS;
        // Depths are linear in their factors; 16 doublings reach from the least drawn.
        for _ in 0..16 {
            let depth: f64 = self.depth.iter().map(|part| part.at_far_end(length)).sum();
            let factor = if depth > greatest {
                Rational::from((1, 2))
            } else if depth < least {
                Rational::from(2)
            } else {
                return;
            };
            for part in &mut self.depth {
                *part.factor_mut() *= &factor;
            }
        }
    }

    /// The case as its file describes it.
    ///
    /// # Errors
    /// [`FileError`] where the public fields were set to what no case has, as a length of 0.
    pub fn description(&self) -> Result<Description, FileError> {
        Description::read(&self.to_string())
    }

    /// Cases that are simpler, the simplest first: fewer parts, plainer parts, factors of 1, the field λ.
    ///
    /// Simpler cases of simpler cases end.
    pub fn simpler(&self) -> impl Iterator<Item = RandomCase> + 'static {
        shrink::simpler(self).into_iter()
    }
}

impl fmt::Display for RandomCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "name = \"random\"")?;
        writeln!(f, "length = \"{}\"", self.length)?;
        if let Some((field, inverse)) = self.field.texts() {
            writeln!(f, "field = \"{field}\"")?;
            writeln!(f, "inverse = \"{inverse}\"")?;
        }
        let sum = |parts: Vec<String>| parts.join(" + ");
        let depth = self.depth.iter().map(|part| part.text(&self.length));
        writeln!(f, "depth = \"{}\"", sum(depth.collect()))?;
        let emission = self.emission.iter().map(Emit::to_string);
        writeln!(f, "emission_of_depth = \"{}\"", sum(emission.collect()))
    }
}

/// Small random numbers.
struct Draw(Pcg64);

impl Draw {
    /// 0 … n − 1.
    fn below(&mut self, n: u32) -> u32 {
        // The bias of 2⁻³² towards small numbers is of no account here.
        let high = (self.0.next_u64() >> 32) * u64::from(n);
        u32::try_from(high >> 32).unwrap_or_default()
    }

    /// An integer from `least` to `greatest`.
    fn number(&mut self, least: u32, greatest: u32) -> Rational {
        Rational::from(least + self.below(greatest + 1 - least))
    }

    /// A rational number from 1/4 to 6.
    fn factor(&mut self) -> Rational {
        let denominator = self.number(1, 4);
        self.number(1, 6) / denominator
    }
}

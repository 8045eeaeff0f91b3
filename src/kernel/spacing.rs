//! Where the ends of uneven segments lie.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use std::fmt;
use std::str::FromStr;

/// The longest segment over the shortest one, of many, where lengths grow along the ray.
const RATIO: f64 = 100.0;
/// The shortest random length, where their mean is 1; the longest is 2 less that.
const SHORTEST: f64 = 0.2;
/// Random lengths before they come again: the levels of the standard ladder are multiples of it.
const PERIOD: usize = 3;

/// How the ends of n segments lie on a ray of length D, the end i at u = i/n.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Spacing {
    /// Three lengths by chance, by that seed, from 1/9 to 9 times one another, again and again: neighbours differ, and
    /// errors keep an expansion in 1/n, which new lengths at every n would not leave them.
    Random(u64),
    /// λ = D u²: short segments at the eye.
    Square,
    /// λ = D (100^u − 1)/99: every segment longer than the one before by the same factor.
    Log,
    /// λ = D u/(10 − 9u): even in 1/(λ + D/9), as disparities are; the last segment is 100 times as long as the first.
    Disparity,
}

/// A text that names no spacing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no spacing (allowed: even, square, log, disparity, random:SEED with a whole number)")]
pub struct SpacingError;

impl Spacing {
    /// The n + 1 ends, from 0 to that length; each above the one before, as long as binary64 tells them apart.
    pub(super) fn edges(self, n: u64, length: f64) -> Vec<f64> {
        let count = n as f64;
        let mut parts: Vec<f64> = match self {
            Spacing::Random(seed) => random(seed, n),
            Spacing::Square => (0..=n).map(|i| (i as f64 / count).powi(2)).collect(),
            Spacing::Log => (0..=n)
                .map(|i| (RATIO.ln() * (i as f64 / count)).exp_m1() / (RATIO - 1.0))
                .collect(),
            Spacing::Disparity => (0..=n)
                .map(|i| {
                    let u = i as f64 / count;
                    u / (10.0 - 9.0 * u)
                })
                .collect(),
        };
        // Whatever was rounded on the way.
        if let Some(last) = parts.last_mut() {
            *last = 1.0;
        }
        parts.into_iter().map(|part| part * length).collect()
    }
}

/// Sums of lengths, as parts of the whole.
fn random(seed: u64, n: u64) -> Vec<f64> {
    let mut stream = Pcg64::seed_from_u64(seed);
    let mut length = || {
        let part = (stream.next_u64() >> 11) as f64 / 53_f64.exp2();
        SHORTEST + 2.0 * (1.0 - SHORTEST) * part
    };
    let lengths: [f64; PERIOD] = std::array::from_fn(|_| length());
    let mut sum = 0.0;
    let mut sums = vec![sum];
    for (length, _) in lengths.iter().cycle().zip(0..n) {
        sum += length;
        sums.push(sum);
    }
    sums.into_iter().map(|before| before / sum).collect()
}

impl FromStr for Spacing {
    type Err = SpacingError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "square" => Ok(Spacing::Square),
            "log" => Ok(Spacing::Log),
            "disparity" => Ok(Spacing::Disparity),
            _ => {
                let seed = text.strip_prefix("random:");
                let seed = seed.and_then(|seed| seed.parse().ok());
                seed.map(Spacing::Random).ok_or(SpacingError)
            }
        }
    }
}

impl fmt::Display for Spacing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Spacing::Random(seed) => write!(f, "random:{seed}"),
            Spacing::Square => f.pad("square"),
            Spacing::Log => f.pad("log"),
            Spacing::Disparity => f.pad("disparity"),
        }
    }
}

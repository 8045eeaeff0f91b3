//! Refinement ladders: which levels a method is run at.

mod text;

/// Most levels a ladder may have.
pub const MAX_LEVELS: usize = 64;
/// Most segments a level may have: 2⁴⁸, which binary64 counts exactly. What fits into memory is for the
/// command to say.
pub const MAX_SEGMENTS: u64 = 1 << 48;

/// The refinement levels of a study, coarse to fine.
///
/// As text ([`FromStr`](std::str::FromStr), and back by [`Display`](std::fmt::Display)):
///
/// | text | levels |
/// |---|---|
/// | `16` | n = 16 alone |
/// | `8..4096` | n = 8, doubled while n ≤ 4096 |
/// | `8..5000x3` | n = 8, tripled while n ≤ 5000 |
/// | `9,18,37` | these n |
/// | `d=0.3,0.11,0.05` | these steps, whether or not they divide the ray |
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    levels: Levels,
}

#[derive(Clone, Debug, PartialEq)]
enum Levels {
    /// Strictly increasing, 1 ≤ n ≤ 2⁴⁸.
    Segments(Vec<u64>),
    /// Strictly decreasing, finite, above 0.
    Steps(Vec<f64>),
}

/// A ladder that cannot be built, or text that names none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LadderError {
    /// The text has none of the forms.
    #[error(
        "ladder '{text}' has no known form (allowed: 16, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)"
    )]
    Form {
        /// The text given.
        text: String,
    },
    /// Something in the text is no number of segments.
    #[error("'{value}' in ladder '{text}' is not allowed (allowed: 1 to {MAX_SEGMENTS} segments)")]
    NotANumber {
        /// The text given.
        text: String,
        /// The part of it that is wrong.
        value: String,
    },
    /// A number of segments is out of range.
    #[error("{n} segments are not allowed (allowed: 1 to {MAX_SEGMENTS})")]
    Segments {
        /// The number.
        n: u64,
    },
    /// A ratio is too small.
    #[error("ratio {ratio} is not allowed (allowed: 2 to {MAX_SEGMENTS})")]
    Ratio {
        /// The ratio.
        ratio: u64,
    },
    /// Too few or too many levels.
    #[error("{levels} levels are not allowed (allowed: 1 to {MAX_LEVELS})")]
    Count {
        /// The number of levels.
        levels: usize,
    },
    /// Levels that grow from 8 by doubling leave the range of n.
    #[error("{levels} doublings are too many (allowed: up to {MAX_SEGMENTS} segments)")]
    TooFine {
        /// The number of levels.
        levels: usize,
    },
    /// A level does not lie above the one before it.
    #[error("{n} segments after {previous} are not allowed (allowed: strictly increasing)")]
    NotIncreasing {
        /// The level.
        n: u64,
        /// The level before.
        previous: u64,
    },
    /// A step is not positive, or does not lie below the one before it.
    #[error("step {step} is not allowed (allowed: finite, above 0, strictly decreasing)")]
    Step {
        /// The step.
        step: f64,
    },
}

impl Ladder {
    /// n = first·ratioᵏ for k = 0 … `levels` − 1.
    ///
    /// # Errors
    ///
    /// [`LadderError`] where `ratio` < 2, or levels or segments leave their ranges.
    pub fn geometric(first: u64, ratio: u64, levels: usize) -> Result<Self, LadderError> {
        if !(2..=MAX_SEGMENTS).contains(&ratio) {
            return Err(LadderError::Ratio { ratio });
        }
        if levels > MAX_LEVELS {
            return Err(LadderError::Count { levels });
        }
        let powers = std::iter::successors(Some(first), |n| n.checked_mul(ratio));
        let list: Vec<u64> = powers.take(levels).collect();
        if list.len() < levels {
            return Err(LadderError::TooFine { levels });
        }
        match list.last() {
            Some(n) if *n > MAX_SEGMENTS && first <= MAX_SEGMENTS => {
                Err(LadderError::TooFine { levels })
            }
            _ => Self::segments(list),
        }
    }

    /// n = first·ratioᵏ while n ≤ `last`.
    ///
    /// # Errors
    ///
    /// [`LadderError`] where `ratio` < 2, `first` > `last`, or segments leave their range.
    pub fn range(first: u64, last: u64, ratio: u64) -> Result<Self, LadderError> {
        for n in [first, last] {
            if !(1..=MAX_SEGMENTS).contains(&n) {
                return Err(LadderError::Segments { n });
            }
        }
        if first > last {
            return Err(LadderError::NotIncreasing {
                n: last,
                previous: first,
            });
        }
        if !(2..=MAX_SEGMENTS).contains(&ratio) {
            return Err(LadderError::Ratio { ratio });
        }
        let powers = std::iter::successors(Some(first), |n| n.checked_mul(ratio));
        Self::segments(powers.take_while(|n| *n <= last).collect())
    }

    /// These numbers of segments.
    ///
    /// # Errors
    ///
    /// [`LadderError`] where they do not strictly increase, or levels or segments leave their ranges.
    pub fn segments(list: Vec<u64>) -> Result<Self, LadderError> {
        count(list.len())?;
        for n in &list {
            if !(1..=MAX_SEGMENTS).contains(n) {
                return Err(LadderError::Segments { n: *n });
            }
        }
        match list.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => Err(LadderError::NotIncreasing {
                n: pair[1],
                previous: pair[0],
            }),
            None => Ok(Ladder {
                levels: Levels::Segments(list),
            }),
        }
    }

    /// These steps, in the units of the ray; none has to divide it.
    ///
    /// # Errors
    ///
    /// [`LadderError`] where they are not positive and strictly decreasing, or too many.
    pub fn steps(list: Vec<f64>) -> Result<Self, LadderError> {
        count(list.len())?;
        let mut previous = f64::INFINITY;
        for step in &list {
            if !step.is_normal() || *step <= 0.0 || *step >= previous {
                return Err(LadderError::Step { step: *step });
            }
            previous = *step;
        }
        Ok(Ladder {
            levels: Levels::Steps(list),
        })
    }

    /// The numbers of segments; `None` for a ladder of steps.
    #[must_use]
    pub fn as_segments(&self) -> Option<&[u64]> {
        match &self.levels {
            Levels::Segments(list) => Some(list),
            Levels::Steps(_) => None,
        }
    }

    /// (number of segments where given, step) of every level on a ray of length `depth`: d = D/n.
    #[must_use]
    pub fn steps_on(&self, depth: f64) -> Vec<(Option<u64>, f64)> {
        match &self.levels {
            Levels::Segments(list) => list.iter().map(|n| (Some(*n), depth / *n as f64)).collect(),
            Levels::Steps(list) => list.iter().map(|d| (None, *d)).collect(),
        }
    }

    /// Number of levels, at least 1.
    #[must_use]
    #[allow(clippy::len_without_is_empty)] // A ladder is never empty.
    pub fn len(&self) -> usize {
        match &self.levels {
            Levels::Segments(list) => list.len(),
            Levels::Steps(list) => list.len(),
        }
    }
}

/// 1 … 64 levels.
fn count(levels: usize) -> Result<(), LadderError> {
    if (1..=MAX_LEVELS).contains(&levels) {
        Ok(())
    } else {
        Err(LadderError::Count { levels })
    }
}

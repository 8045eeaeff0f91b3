//! Refinement ladders: which levels a method is run at.

use std::fmt;
use std::str::FromStr;

/// Most levels a ladder may have.
pub const MAX_LEVELS: usize = 64;
/// Most segments a level may have: 2²⁴.
pub const MAX_SEGMENTS: u64 = 1 << 24;
/// First level of a ladder given by its number of levels alone.
const FIRST: u64 = 8;

/// The refinement levels of a study, coarse to fine.
///
/// As text ([`FromStr`], and back by [`Display`](fmt::Display)):
///
/// | text | levels |
/// |---|---|
/// | `10` | ten levels, n = 8, 16, …, 4096 |
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
    /// Strictly increasing, 1 ≤ n ≤ 2²⁴.
    Segments(Vec<u64>),
    /// Strictly decreasing, finite, above 0.
    Steps(Vec<f64>),
}

/// A ladder that cannot be built, or text that names none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LadderError {
    /// The text has none of the forms.
    #[error(
        "ladder '{text}' has no known form (allowed: 10, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)"
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

impl FromStr for Ladder {
    type Err = LadderError;

    fn from_str(text: &str) -> Result<Self, LadderError> {
        let number = |part: &str| -> Result<u64, LadderError> {
            let part = part.trim();
            let digits = !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
            part.parse()
                .ok()
                .filter(|_| digits)
                .ok_or_else(|| LadderError::NotANumber {
                    text: text.into(),
                    value: part.into(),
                })
        };
        let form = || LadderError::Form { text: text.into() };
        if text.trim().is_empty() {
            return Err(form());
        }
        if let Some(list) = text.trim().strip_prefix("d=") {
            let steps: Result<Vec<f64>, _> = list.split(',').map(|s| s.trim().parse()).collect();
            return Self::steps(steps.map_err(|_| form())?);
        }
        if let Some((first, rest)) = text.split_once("..") {
            let (last, ratio) = match rest.split_once('x') {
                Some((last, ratio)) => (last, number(ratio)?),
                None => (rest, 2),
            };
            return Self::range(number(first)?, number(last)?, ratio);
        }
        if text.contains(',') {
            let list: Result<Vec<u64>, _> = text.split(',').map(number).collect();
            return Self::segments(list?);
        }
        let levels = number(text).map_err(|_| form())?;
        Self::geometric(FIRST, 2, usize::try_from(levels).unwrap_or(usize::MAX))
    }
}

impl fmt::Display for Ladder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match &self.levels {
            Levels::Segments(list) => match (geometric_ratio(list), &list[..]) {
                (Some(2), [first, .., last]) => format!("{first}..{last}"),
                (Some(ratio), [first, .., last]) => format!("{first}..{last}x{ratio}"),
                (_, [only]) => format!("{only}..{only}"),
                _ => join(list),
            },
            Levels::Steps(list) => format!("d={}", join(list)),
        };
        f.pad(&text)
    }
}

/// The whole ratio that every level has to the one before; `None` where there is none.
fn geometric_ratio(list: &[u64]) -> Option<u64> {
    let [first, second, ..] = list else {
        return None;
    };
    let ratio = second / first;
    let constant = list
        .windows(2)
        .all(|pair| pair[0].checked_mul(ratio) == Some(pair[1]));
    constant.then_some(ratio)
}

/// Numbers with commas between them.
fn join<T: fmt::Display>(list: &[T]) -> String {
    let texts: Vec<String> = list.iter().map(T::to_string).collect();
    texts.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Ladder, LadderError> {
        text.parse()
    }

    #[test]
    fn every_form_of_text_gives_its_levels_and_prints_back() {
        for (text, levels, printed) in [
            ("4", &[8, 16, 32, 64][..], "8..64"),
            ("1", &[8], "8..8"),
            ("8..70", &[8, 16, 32, 64], "8..64"),
            ("8..5000x3", &[8, 24, 72, 216, 648, 1944], "8..1944x3"),
            ("9,18,37", &[9, 18, 37], "9,18,37"),
            ("9, 27, 81", &[9, 27, 81], "9..81x3"),
            ("5..5", &[5], "5..5"),
            ("1,16777216", &[1, 1 << 24], "1..16777216x16777216"),
        ] {
            let ladder = parse(text).unwrap();
            assert_eq!(ladder.as_segments(), Some(levels), "{text}");
            assert_eq!(ladder.len(), levels.len());
            assert_eq!(ladder.to_string(), printed);
            assert_eq!(parse(printed), Ok(ladder));
        }
        let default = parse("10").unwrap();
        assert_eq!(default.as_segments().unwrap().last(), Some(&4096));
    }

    #[test]
    fn steps_need_not_divide_the_ray() {
        let ladder = parse("d=0.3,0.11,1e-3").unwrap();
        assert_eq!(ladder.as_segments(), None);
        assert_eq!(
            ladder.steps_on(7.0),
            [(None, 0.3), (None, 0.11), (None, 1e-3)]
        );
        assert_eq!(ladder.to_string(), "d=0.3,0.11,0.001");
        assert_eq!(ladder.len(), 3);
        let segments = parse("2,5").unwrap();
        assert_eq!(segments.steps_on(2.0), [(Some(2), 1.0), (Some(5), 0.4)]);
    }

    #[test]
    fn errors_name_the_value_and_what_is_allowed() {
        for (text, message) in [
            (
                "",
                "ladder '' has no known form (allowed: 10, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
            ),
            (
                "ten",
                "ladder 'ten' has no known form (allowed: 10, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
            ),
            (
                "-3",
                "ladder '-3' has no known form (allowed: 10, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
            ),
            (
                "d=0.3,x",
                "ladder 'd=0.3,x' has no known form (allowed: 10, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
            ),
            ("0", "0 levels are not allowed (allowed: 1 to 64)"),
            ("65", "65 levels are not allowed (allowed: 1 to 64)"),
            (
                "23",
                "23 doublings are too many (allowed: up to 16777216 segments)",
            ),
            (
                "64",
                "64 doublings are too many (allowed: up to 16777216 segments)",
            ),
            (
                "0..8",
                "0 segments are not allowed (allowed: 1 to 16777216)",
            ),
            (
                "8..16777217",
                "16777217 segments are not allowed (allowed: 1 to 16777216)",
            ),
            (
                "8..4",
                "4 segments after 8 are not allowed (allowed: strictly increasing)",
            ),
            ("8..64x1", "ratio 1 is not allowed (allowed: 2 to 16777216)"),
            (
                "8..6 4",
                "'6 4' in ladder '8..6 4' is not allowed (allowed: 1 to 16777216 segments)",
            ),
            (
                "8..+64",
                "'+64' in ladder '8..+64' is not allowed (allowed: 1 to 16777216 segments)",
            ),
            (
                "8,16,16",
                "16 segments after 16 are not allowed (allowed: strictly increasing)",
            ),
            (
                "8,,16",
                "'' in ladder '8,,16' is not allowed (allowed: 1 to 16777216 segments)",
            ),
            ("0,1", "0 segments are not allowed (allowed: 1 to 16777216)"),
            (
                "d=0.1,0.1",
                "step 0.1 is not allowed (allowed: finite, above 0, strictly decreasing)",
            ),
            (
                "d=0",
                "step 0 is not allowed (allowed: finite, above 0, strictly decreasing)",
            ),
            (
                "d=nan",
                "step NaN is not allowed (allowed: finite, above 0, strictly decreasing)",
            ),
            (
                "d=inf",
                "step inf is not allowed (allowed: finite, above 0, strictly decreasing)",
            ),
        ] {
            assert_eq!(parse(text).unwrap_err().to_string(), message, "{text}");
        }
    }

    #[test]
    fn ladders_stop_at_their_bounds() {
        assert_eq!(
            parse("22").unwrap().as_segments().unwrap().last(),
            Some(&(1 << 24))
        );
        assert_eq!(
            Ladder::geometric(0, 2, 3),
            Err(LadderError::Segments { n: 0 })
        );
        assert_eq!(
            Ladder::geometric(3, 1, 3),
            Err(LadderError::Ratio { ratio: 1 })
        );
        assert_eq!(
            Ladder::geometric(u64::MAX, 2, 1),
            Err(LadderError::Segments { n: u64::MAX })
        );
        assert_eq!(
            Ladder::geometric(3, MAX_SEGMENTS, 64),
            Err(LadderError::TooFine { levels: 64 })
        );
        assert!(Ladder::segments((1..=64).collect()).is_ok());
        assert_eq!(
            Ladder::segments((1..=65).collect()),
            Err(LadderError::Count { levels: 65 })
        );
        assert_eq!(Ladder::steps(vec![]), Err(LadderError::Count { levels: 0 }));
    }
}

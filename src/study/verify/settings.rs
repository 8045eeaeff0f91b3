//! How a kernel is tested.

use super::{Accepted, Identify};
use crate::case::nodes::gcd;
use crate::convergence::{Ladder, LadderError, MIN_REPLICAS};
use crate::identify::{TOGETHER, stated};
use crate::kernel::{Cut, Declaration, MAX_TASK_SEGMENTS, Spacing, Subject};
use crate::symbolic::parse_number;
use rug::Rational;
use std::fmt;

/// Entries of the tables of transfer functions: so many that the kinks between them do not show.
pub const TABLE_ENTRIES: usize = 1024;
/// Segments of a ray while the grid is refined.
pub const GRID_SEGMENTS: u64 = 4096;
/// Seeds a level of a kernel that draws random numbers.
pub const REPLICAS: usize = 30;
/// Most seeds a level.
pub const MAX_REPLICAS: usize = 10_000;
/// Finer ladders have no room for uneven steps.
const MAX_LEVEL: u64 = MAX_TASK_SEGMENTS / 2;
/// The lowest order that can be expected, as 1/100, and the highest.
const ORDERS: ((u32, u32), u32) = ((1, 100), 100);
/// Levels that say most of most cases. None is a multiple of 8, so that a loop without its tail shows, and all are 9
/// more than a multiple of 12, so that breaks at halves, thirds and quarters of the ray stand at the same part of a
/// segment at every level: errors keep one expansion.
const LADDER: [u64; 8] = [9, 21, 33, 69, 129, 261, 513, 1029];
/// Beside the ladder, numbers of segments that orders are not fitted to, in multiples of no number that all levels are
/// multiples of: by steps like those of the ladder, and at one that divides the ray.
const SPOTS: [(u64, Steps); 3] = [
    (47, Steps::PartLast),
    (64, Steps::Divide),
    (100, Steps::PartLast),
];
/// The last segment, as a part of the others, where steps need not divide the ray.
const LAST: (u32, u32) = (3, 10);
/// With uneven steps, d is that part of D/n.
const UNEVEN: (u32, u32) = (7, 8);
/// Segments that are rendered to read off what most kernels compute, about.
const IDENTIFYING: u64 = 8_000;
/// The same of a ray that is asked alone and among others, about.
const OF_A_BATCH: u64 = 64;
/// Fewest levels that an order shows on.
const MIN_LEVELS: usize = 4;

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The step along the ray.
    Step,
    /// The grid of the volume, at [`GRID_SEGMENTS`] segments.
    Grid,
}

/// How rays are cut at a level of n segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Steps {
    /// d = D/(n − 7/10): the last segment is 3/10 of the others at every level.
    PartLast,
    /// d = D/n.
    Divide,
    /// d = 7/8 D/n: the last segment is another part at every level.
    Uneven,
    /// Segments of many lengths.
    Spaced(Spacing),
}

impl Steps {
    /// A ray of that length in n segments, or the step that belongs to n.
    fn cut(self, n: u64, length: &Rational) -> Cut {
        match self {
            // A ray of one segment has no others.
            Steps::PartLast if n > 1 => {
                let others = Rational::from(LAST) + (n - 1);
                Cut::Step((length / others).to_f64())
            }
            Steps::Uneven => {
                let step = length * Rational::from(UNEVEN) / n;
                Cut::Step(step.to_f64())
            }
            Steps::Spaced(spacing) => Cut::Spaced(n, spacing),
            Steps::PartLast | Steps::Divide => Cut::Segments(n),
        }
    }
}

impl fmt::Display for Steps {
    /// Its name, as in JSON.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Steps::PartLast => f.pad("part-last"),
            Steps::Divide => f.pad("divide"),
            Steps::Uneven => f.pad("uneven"),
            Steps::Spaced(spacing) => spacing.fmt(f),
        }
    }
}

/// How a kernel is tested.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Numbers of segments n, or of cells of the grid, from coarse to fine.
    pub ladder: Vec<u64>,
    /// What is refined.
    pub axis: Axis,
    /// How rays are cut.
    pub steps: Steps,
    /// The order to expect in place of what the kernel declares, as a rational.
    pub expect: Option<Rational>,
    /// Entries of tables.
    pub entries: usize,
    /// Seeds a level, for kernels that draw random numbers.
    pub replicas: usize,
    /// Whether it is read off what the kernel computes.
    pub identify: Identify,
    /// Deviations that are known.
    pub accept: Vec<Accepted>,
    /// How many rays are asked in one request, to see whether each has the answer that it has alone.
    pub batch: Option<usize>,
}

/// Settings that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// A ladder of steps, or none.
    #[error("a ladder of steps (allowed: numbers of segments)")]
    Steps,
    /// A level that no task can have.
    #[error("{n} segments (allowed: 1 to {MAX_LEVEL})")]
    TooFine {
        /// How many.
        n: u64,
    },
    /// Too few or too many replicas.
    #[error("no number of seeds (allowed: {MIN_REPLICAS} to {MAX_REPLICAS})")]
    Replicas,
    /// Too few or too many rays in one request.
    #[error("no number of rays (allowed: {} to {})", TOGETHER.start(), TOGETHER.end())]
    Batch,
    /// Too few levels.
    #[error("{levels} levels show no order (allowed: {MIN_LEVELS} or more)")]
    Levels {
        /// How many.
        levels: usize,
    },
    /// A kernel that takes multiples of so many segments, and a ladder with too few of them.
    #[error(
        "a kernel that takes multiples of {multiple} segments, on which the ladder leaves {levels} (allowed: {MIN_LEVELS} or more levels)"
    )]
    Multiple {
        /// Of how many.
        multiple: u64,
        /// Levels that are left.
        levels: usize,
    },
    /// No order.
    #[error("no order (allowed: 0.01 to 100, as 2, 1.5 or 3/2)")]
    Order,
    /// A ladder that is none.
    #[error(transparent)]
    Ladder(#[from] LadderError),
}

impl Settings {
    /// The ladder that says most of most cases: n = 9, 21, …, 1029 along the ray, and grids of 8, 16, …, 1024 cells.
    ///
    /// # Errors
    /// None: the ladders are good ones.
    pub fn standard(axis: Axis) -> Result<Self, SettingsError> {
        let ladder = match axis {
            Axis::Step => Ladder::segments(LADDER.to_vec())?,
            Axis::Grid => Ladder::geometric(8, 2, 8)?,
        };
        Ok(Settings {
            axis,
            ..Settings::new(&ladder)?
        })
    }

    /// With that ladder, along the ray, the last segment a part of the others.
    ///
    /// # Errors
    /// [`SettingsError`] where the ladder is one of steps, or too fine.
    pub fn new(ladder: &Ladder) -> Result<Self, SettingsError> {
        let ladder = ladder.as_segments().ok_or(SettingsError::Steps)?.to_vec();
        if let Some(&n) = ladder.iter().find(|n| **n > MAX_LEVEL) {
            return Err(SettingsError::TooFine { n });
        }
        Ok(Settings {
            ladder,
            axis: Axis::Step,
            steps: Steps::PartLast,
            expect: None,
            entries: TABLE_ENTRIES,
            replicas: REPLICAS,
            identify: Identify::default(),
            accept: Vec::new(),
            batch: None,
        })
    }

    /// The same, where there are levels enough for an order.
    ///
    /// # Errors
    /// [`SettingsError::Levels`].
    pub fn with_enough_levels(self) -> Result<Self, SettingsError> {
        match self.ladder.len() {
            levels if levels < MIN_LEVELS => Err(SettingsError::Levels { levels }),
            _ => Ok(self),
        }
    }

    /// An order to expect, as text has it: a decimal or a quotient.
    ///
    /// # Errors
    /// [`SettingsError::Order`].
    pub fn order(text: &str) -> Result<Rational, SettingsError> {
        let (least, most) = ORDERS;
        let order = parse_number(text).ok();
        order
            .filter(|order| *order >= Rational::from(least) && *order <= most)
            .ok_or(SettingsError::Order)
    }

    /// How many rays are asked in one request.
    ///
    /// # Errors
    /// [`SettingsError::Batch`].
    pub fn batch(count: u64) -> Result<usize, SettingsError> {
        let count = Some(count).filter(|count| TOGETHER.contains(count));
        let count = count.and_then(|count| usize::try_from(count).ok());
        count.ok_or(SettingsError::Batch)
    }

    /// A number of seeds a level.
    ///
    /// # Errors
    /// [`SettingsError::Replicas`].
    pub fn replicas(count: usize) -> Result<usize, SettingsError> {
        let allowed = MIN_REPLICAS..=MAX_REPLICAS;
        let count = Some(count).filter(|count| allowed.contains(count));
        count.ok_or(SettingsError::Replicas)
    }

    /// With what that kernel can be asked: the numbers of segments that it takes, each the next to the one that was
    /// wanted, and steps that divide the ray where it takes no others.
    ///
    /// # Errors
    /// [`SettingsError::Multiple`].
    pub fn suited(&self, declaration: &Declaration) -> Result<Settings, SettingsError> {
        let mut suited = self.clone();
        if self.axis == Axis::Grid {
            return Ok(suited);
        }
        let takes_only_whole = declaration.step_divides
            || declaration
                .method
                .is_some_and(|method| stated(&method).is_none());
        if self.steps == Steps::PartLast && takes_only_whole {
            suited.steps = Steps::Divide;
        }
        let multiple = declaration.multiple_of.get();
        let next = |n: &u64| n.checked_next_multiple_of(multiple);
        let ladder = self.ladder.iter().filter_map(next);
        suited.ladder = ladder.filter(|n| *n <= MAX_LEVEL).collect();
        suited.ladder.dedup();
        let levels = suited.ladder.len();
        if levels < MIN_LEVELS.min(self.ladder.len()) {
            return Err(SettingsError::Multiple { multiple, levels });
        }
        Ok(suited)
    }

    /// Segments that a kernel renders in all: the units that progress is counted in.
    #[must_use]
    pub fn work(&self, subjects: &[Subject], declaration: &Declaration) -> u64 {
        let seeds = if declaration.stochastic {
            self.replicas as u64
        } else {
            1
        };
        // What cannot be suited is refused before anything is asked.
        let suited = self.suited(declaration);
        let settings = suited.as_ref().unwrap_or(self);
        let cuts = subjects.iter().flat_map(|subject| {
            settings
                .cuts(subject.length())
                .into_iter()
                .map(move |cut| (cut, subject))
        });
        let segments = cuts.filter_map(|(cut, subject)| cut.on(subject.length()).ok());
        let identifies = self.axis == Axis::Step && self.identify != Identify::Off;
        let identifying = if identifies { IDENTIFYING } else { 0 };
        let at_once = settings.batch.unwrap_or(0) as u64 * OF_A_BATCH;
        segments
            .map(|(_, count)| count.saturating_mul(seeds))
            .fold(identifying + at_once, u64::saturating_add)
    }

    /// Cells of the grid while the step along the ray is refined. Between them the medium has kinks, which stand at
    /// the same part of a segment at every level: at its end where steps divide the ray.
    #[must_use]
    pub fn cells(&self) -> u64 {
        let coarsest = self.ladder.first().copied().unwrap_or(1);
        let shared = match self.steps {
            Steps::Divide => self.ladder.iter().copied().fold(0, gcd),
            Steps::PartLast => {
                let differences = self.ladder.windows(2).map(|pair| pair[1] - pair[0]);
                differences.fold(0, gcd)
            }
            Steps::Uneven | Steps::Spaced(_) => coarsest,
        };
        // One cell has no kink at all.
        if shared > 1 { shared } else { coarsest }
    }

    /// How a ray of that length is cut at every level.
    pub(in crate::study) fn cuts(&self, length: &Rational) -> Vec<Cut> {
        let cut = |n: &u64| match self.axis {
            Axis::Grid => Cut::Segments(GRID_SEGMENTS),
            Axis::Step => self.steps.cut(*n, length),
        };
        self.ladder.iter().map(cut).collect()
    }

    /// How it is cut beside the levels, where a kernel takes any number of segments.
    pub(super) fn spots(&self, length: &Rational, declaration: &Declaration) -> Vec<Cut> {
        let takes_any = declaration.multiple_of.get() == 1 && !declaration.stochastic;
        let is_asked =
            self.axis == Axis::Step && matches!(self.steps, Steps::PartLast | Steps::Divide);
        let within = match self.ladder[..] {
            [_, second, .., last] => second + 1..last,
            _ => 0..0,
        };
        let spots = SPOTS.into_iter().filter(|(n, _)| {
            takes_any && is_asked && within.contains(n) && !self.ladder.contains(n)
        });
        let cut = |(n, steps): (u64, Steps)| match self.steps {
            Steps::PartLast => steps.cut(n, length),
            Steps::Divide | Steps::Uneven | Steps::Spaced(_) => Cut::Segments(n),
        };
        spots.map(cut).collect()
    }
}

//! How a kernel is tested.

use crate::convergence::{Ladder, LadderError, MIN_REPLICAS};
use crate::kernel::{Cut, Declaration, MAX_TASK_SEGMENTS, Subject};
use crate::symbolic::parse_number;
use rug::Rational;

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
/// With uneven steps, d is that part of D/n: it divides no ray.
const UNEVEN: (u32, u32) = (7, 8);

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The step along the ray.
    Step,
    /// The grid of the volume, at [`GRID_SEGMENTS`] segments.
    Grid,
}

/// How a kernel is tested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Numbers of segments n, or of cells of the grid, from coarse to fine.
    pub ladder: Vec<u64>,
    /// What is refined.
    pub axis: Axis,
    /// Steps of 7/8 D/n, which do not divide the ray.
    pub uneven: bool,
    /// The order to expect in place of what the kernel declares, as a rational.
    pub expect: Option<Rational>,
    /// Entries of tables.
    pub entries: usize,
    /// Seeds a level, for kernels that draw random numbers.
    pub replicas: usize,
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
    /// No order.
    #[error("no order (allowed: 0.01 to 100, as 2, 1.5 or 3/2)")]
    Order,
    /// A ladder that is none.
    #[error(transparent)]
    Ladder(#[from] LadderError),
}

impl Settings {
    /// The ladder that says most of most cases: n = 8, 16, …, 1024 by steps that divide the ray.
    ///
    /// # Errors
    /// None: the ladder is a good one.
    pub fn standard() -> Result<Self, SettingsError> {
        Settings::new(&Ladder::geometric(8, 2, 8)?)
    }

    /// With that ladder, along the ray.
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
            uneven: false,
            expect: None,
            entries: TABLE_ENTRIES,
            replicas: REPLICAS,
        })
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

    /// A number of seeds a level.
    ///
    /// # Errors
    /// [`SettingsError::Replicas`].
    pub fn replicas(count: usize) -> Result<usize, SettingsError> {
        let allowed = MIN_REPLICAS..=MAX_REPLICAS;
        let count = Some(count).filter(|count| allowed.contains(count));
        count.ok_or(SettingsError::Replicas)
    }

    /// Segments that a kernel renders in all: the units that progress is counted in.
    #[must_use]
    pub fn work(&self, subjects: &[Subject], declaration: &Declaration) -> u64 {
        let seeds = if declaration.stochastic {
            self.replicas as u64
        } else {
            1
        };
        let cuts = subjects.iter().flat_map(|subject| {
            self.cuts(subject.length())
                .into_iter()
                .map(move |cut| (cut, subject))
        });
        let segments = cuts.filter_map(|(cut, subject)| cut.on(subject.length()).ok());
        segments
            .map(|(_, count)| count.saturating_mul(seeds))
            .fold(0, u64::saturating_add)
    }

    /// How a ray of that length is cut at every level.
    pub(super) fn cuts(&self, length: &Rational) -> Vec<Cut> {
        let cut = |n: &u64| match self.axis {
            Axis::Grid => Cut::Segments(GRID_SEGMENTS),
            Axis::Step if self.uneven => {
                let step = length * Rational::from(UNEVEN) / *n;
                Cut::Step(step.to_f64())
            }
            Axis::Step => Cut::Segments(*n),
        };
        self.ladder.iter().map(cut).collect()
    }
}

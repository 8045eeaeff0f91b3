//! Orders of accuracy from errors at refinement levels: a window, an order with an interval, a verdict.
//!
//! [`fit`](fit()) takes signed errors at decreasing steps. Errors of any magnitude and any step ratio will do;
//! neither has to come from this crate. It works where an asymptotic stretch of at least four
//! levels stands above the roundoff floor. Where there is none it says so: a [`Verdict`] other than
//! [`Confirmed`](Verdict::Confirmed) (or [`Exact`](Verdict::Exact), where that is expected) passes
//! nothing.
//!
//! Why not a regression over all levels: it mixes the pre-asymptotic levels with the roundoff floor
//! and gives decimals that are no order. What is left of an error inside the window is bias, not
//! noise, so that the half-width comes from the pairwise orders and not from the regression alone.
//!
//! ```
//! use rug::Float;
//! use volver::convergence::{Sample, Verdict, fit};
//! use volver::method::Expected;
//!
//! let samples: Vec<Sample> = [8_u64, 16, 32, 64, 128, 256]
//!     .into_iter()
//!     .map(|n| {
//!         let d = 1.0 / n as f64;
//!         let error = Float::with_val(53, 0.3 * d * d * (1.0 + 0.1 * d));
//!         Sample { n: Some(n), step: d, error, floor: Float::with_val(53, 1e-16) }
//!     })
//!     .collect();
//! let second = fit(&samples, Some(Expected::Order(2.0)))?;
//! assert_eq!(second.verdict, Verdict::Confirmed);
//! assert_eq!(fit(&samples, Some(Expected::Order(3.0)))?.verdict, Verdict::TooLow);
//! # Ok::<(), volver::convergence::FitError>(())
//! ```

pub(crate) mod bootstrap;
mod decimal;
mod fit;
mod ladder;
pub(crate) mod line;
#[cfg(feature = "studies")]
mod model;
mod note;
pub(crate) mod replicas;
pub(crate) mod richardson;
mod sample;
#[cfg(feature = "studies")]
mod split;
pub mod table;
#[cfg(feature = "studies")]
mod taylor;
#[cfg(feature = "studies")]
mod transition;
pub(crate) mod verdict;
mod window;

pub use decimal::Decimal;
pub use fit::{FLOOR_MARGIN, Fit, FitError, FloorCut, Pair, fit, fit_uncertain};
pub use ladder::{Ladder, LadderError, MAX_LEVELS, MAX_SEGMENTS};
#[cfg(feature = "studies")]
pub use model::{Best, ErrorModel, Laws, RoundoffLaw};
pub use note::Note;
pub use replicas::{
    ErrorPart, LevelMoments, MIN_REPLICAS, OrderInterval, Replicas, ReplicasError, ReportedError,
    StochasticFit, fit_replicas, reported_error,
};
pub use richardson::{DifferenceFit, RichardsonError, ValueSample, fit_differences};
#[cfg(feature = "studies")]
pub(crate) use sample::float_schema;
pub use sample::{JSON_NUMBER_MIN, Sample, serialize_float};
#[cfg(feature = "studies")]
pub use split::{Cell, Oracle, Split};
#[cfg(feature = "studies")]
pub use taylor::{Smoothness, Taylor, taylor};
#[cfg(feature = "studies")]
pub use transition::{Transition, TransitionError, transition};
pub use verdict::{MAX_HALF_WIDTH, Verdict};
pub use window::Window;

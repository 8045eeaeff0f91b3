//! Error against cost: every method in every format at every n, and the cheapest way to an error.
//!
//! Cost is counted work, which is the same on every machine; time measured on this one; and time modelled from
//! the counts and a [`Calibration`] of this machine, which other parts can ask what any work will take.

pub(crate) mod calibration;
mod catalogue;
mod cheapest;
mod clock;
mod cost;
pub(crate) mod counting;
mod journal;
mod measure;
mod pareto;
mod record;
mod results;
mod run;
mod summary;

pub use calibration::Calibration;
pub use catalogue::{METHODS, USUAL_FORMAT, USUAL_METHOD, default_formats, default_methods};
pub use cheapest::{Goal, cheapest};
pub use clock::{Pin, clock_name};
pub use cost::Cost;
pub use journal::{Journal, JournalError};
pub use measure::Timing;
pub use pareto::front;
pub use record::{Outcome, Point, Unit};
pub use results::{CaseResults, Results};
pub use run::{Settings, TradeoffError, bytes, estimate, run, seconds};
pub use summary::{Agreement, Standing, agreement, standings};

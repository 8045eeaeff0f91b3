//! The extremes: what is left of a method's digits where its numbers end, and who says so.
//!
//! Every [`Scenario`] is a medium whose Q_∞ is known for each method: errors here are roundoff alone, since
//! discretization is not the format's fault. Of every run there are the digits that it has, the digits that a
//! bound known beforehand promises (`promise`), and a [`Verdict`] where something befell it on the way
//! that the bound leaves out. Verdicts come from watching the run's own numbers, never from the scenario.
//! A cell without a verdict and with fewer digits than promised is a silent wrong number; there must be none.

mod cell;
mod exact;
mod facts;
mod judge;
mod medium;
mod method;
mod places;
mod promise;
mod range;
mod run;
mod scenario;
mod verdict;
mod watched;

pub use cell::{Cell, Digits};
pub use exact::{Exact, ORACLE_BITS, exact};
pub(in crate::study) use judge::{digits, relative_error};
pub use medium::{Fault, Knot, Layer, Medium};
pub use method::{Kind, METHODS};
pub use range::Rounding;
pub use run::{Settings, run, work};
pub use scenario::{GROUPS, LEVELS, SEGMENTS, Scenario, scenarios};
pub(in crate::study) use scenario::{new as scenario, power, slab};
pub use verdict::Verdict;

/// The formats of the default grid.
pub const FORMATS: [&str; 8] = [
    "f16", "bf16", "f32", "f64", "tf32", "fp8-e4m3", "fixed:8", "fixed:15",
];

/// Why the extremes cannot be run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StressError {
    /// A method whose roundoff nobody has bounded.
    #[error(
        "method '{name}': no bound of its roundoff is known (allowed: trapezoid/trapezoid, simpson/simpson, compositing without stop, preintegrated/linear/linear, by 1 to 256 trapezoids in both places)"
    )]
    Method {
        /// The method.
        name: String,
    },
    /// A format that has no ends within reach.
    #[error(
        "format '{name}': there is nothing to stress (allowed: f16, bf16, f32, f64, f32-lanes, f64-lanes, tf32, fp8-e4m3, fp8-e5m2, ieee:BITS,EMIN,EMAX, fixed:FRACTION, fixed:INTEGER.FRACTION)"
    )]
    Format {
        /// The format.
        name: String,
    },
}

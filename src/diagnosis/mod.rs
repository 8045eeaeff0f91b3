//! What a kernel really computes: its values compared, as numbers, with every method of this crate and with
//! compositing in which something is wrong.
//!
//! A [`Recipe`] is compositing with a position of the samples, an opacity formula and defects, which reproduces a
//! kernel's values from the very numbers that it was given. [`fingerprint`](fingerprint()) looks for the
//! simplest one that does so in the most cases.

mod candidates;
mod fingerprint;
mod fixed;
mod jitter;
mod likeness;
mod linear;
mod march;
mod model;
mod parameter;
mod places;
mod ray;
mod recipe;
mod search;
mod stops;
mod values;
mod watched;

pub use fingerprint::{Fingerprint, fingerprint};
pub use jitter::{Jittered, jittered};
pub use likeness::{Likeness, likeness};
pub use linear::LinearSegments;
pub use march::{WALL_LENGTH, radiance, radiance_by};
pub use model::{Match, Model};
pub use places::Places;
pub use ray::Ray;
pub use recipe::{
    Accumulator, EmissionModel, End, Ends, FixedRounding, FixedScale, Lookup, OpacityModel, Recipe,
};
pub use watched::{Accuracy, Watched, WatchedLevel};

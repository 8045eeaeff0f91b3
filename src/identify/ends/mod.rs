//! Where rays begin and end: vacuum, early ends, counts, the last segment, walls, what lies behind.

mod behind;
mod count;
mod last;
mod lone;
mod stop;
mod sum;
mod trial;
mod vacuum;
mod wall;

pub(super) use behind::behind;
pub(super) use count::counts;
pub(super) use last::last_step;
pub(super) use lone::Lone;
pub(super) use stop::early_end;
pub(super) use vacuum::{Vacuum, failures, vacuum};
pub(super) use wall::wall;

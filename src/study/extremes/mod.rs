//! A kernel at the extremes: what is left of its digits in thin and thick rays, in vacuum, with τ below 0 and with one segment.
//!
//! Rays are those of [`stress`](super::stress), made so that every usual rule has the exact answer whatever the number of
//! segments: C and τ the same everywhere, or C = 1 and τ linear between the ends of segments. So an error is roundoff, or a
//! fault, and needs no ladder to be seen. What may be lost is what a method loses there in the declared format, by the bound of
//! [`stress`](super::stress): the declared method, or compositing whose opacities are good to the last digits.

mod cell;
mod judge;
mod promised;
mod run;
mod scenario;
mod truth;

pub use cell::{Answer, Cell};
pub use run::{Extremes, ExtremesError, extremes, work};

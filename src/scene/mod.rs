//! Rays as users have them: media one behind the other, of formulas or of sampled data, in several channels.
//!
//! I = ∑ₖ T(aₖ) ∫ C τ e^(−∫τ) dλ over medium k from aₖ on, and T(D) times the background behind the ray. A
//! [`Scene`] has every medium cut into [`Piece`]s in which C and τ are analytic: what is read of a file is
//! either kept exactly or refused.

mod bound;
mod classify;
mod expression;
mod file;
mod fingerprint;
mod keys;
mod medium;
mod problem;
mod read;
mod sampled;
mod samples;
mod table;
mod top;

pub use bound::{BoundPiece, Columns};
pub use file::SceneFile;
pub use medium::{Form, Kind, Medium, Piece, Scene, Values};
pub use problem::{SceneError, SceneProblem};
pub use read::read;
pub use samples::Interpolation;

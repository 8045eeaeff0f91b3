//! Cases as theorems, checked by the proof assistant Coq.
//!
//! What the zero test of [`symbolic`](crate::symbolic) decides about a case, a program says; a theorem about
//! the case is checked by another program, from the definition of the integral on. [`script`] writes the
//! case as a theorem on the definitions of `proofs/theory/`, which come with this library, and [`Coq`] has it
//! checked where Coq is installed.

mod check;
mod script;

pub use check::{Coq, CoqMissing, Verdict};
pub use script::{MARK, NotStated, Script, script};

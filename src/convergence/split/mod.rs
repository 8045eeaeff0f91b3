//! Discretization error separated from roundoff, by recording and replaying.
//!
//! For one method on one case with n segments in a format f, whose radiance is `Q_f`:
//!
//! | part | is |
//! |---|---|
//! | discretization | Q_∞ − I, where Q_∞ is the same code in MPFR with enough bits |
//! | input rounding | Q_∞(the inputs f used) − Q_∞: the errors of C, τ and s, evaluated in f |
//! | arithmetic rounding | `Q_f` − Q_∞(the inputs f used): d, weights, exponentials, sums |
//! | truncation | Q_∞ stopped − Q_∞, where a method stops early; discretization is then that of the whole ray |
//!
//! The inputs are the values that the run in f really used at every node it touched; they are recorded and
//! replayed exactly. Arithmetic rounding is divided once more, into what comes of the transmittances and what
//! comes of summing the radiance under them: the sum is taken in MPFR under the transmittances of f.
//!
//! That the parts add up proves nothing: they do by construction. "Enough bits" is checked each time, by a bound of what the
//! oracle's own rounding leaves in a part, the [resolution](Split::resolution): a part is 2²⁰ times as large, or it is run
//! again with more bits until it is, or lies below the bound of twice as many. The bound is read off errors that were
//! measured: those of the run itself, which is the same code on the same nodes with fewer bits, and those of a short level
//! that the oracle runs with 64 bits more.
//!
//! Exponentials without rounding are taken once; those of a replay, whose depths differ by roundings, come of them by a short
//! series, and so do those of one inner rule of another's. Sums are taken once for all outer rules.
//!
//! ```
//! use volver::case::{Shared, SineSquared};
//! use volver::convergence::{Cell, Oracle};
//! use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
//! use volver::quadrature::Rule;
//! use volver::real::Native;
//!
//! let method = Method::Nested(Nested {
//!     inner: Inner::PerSegment(Rule::Trapezoid),
//!     outer: Outer(Rule::Trapezoid),
//!     exponential: Exponential::Exact,
//!     scope: Scope::Whole,
//! });
//! let oracle = Oracle::new(&SineSquared, &[method]);
//! let nodes = Shared::new(&SineSquared, Native::<f32>::new());
//! for cell in oracle.split(&nodes, 4096)? {
//!     let Cell::Split(split) = cell? else { unreachable!("no jump in this case") };
//!     // Of order 2 and 4096 segments: binary32 is exhausted long before.
//!     assert!(split.arithmetic.cmp_abs(&split.discretization).is_some_and(|order| order.is_gt()));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cell;
mod known;
mod oracle;
mod parts;
mod ran;
mod trace;
mod without_rounding;

pub use cell::{Cell, Split};
pub use oracle::Oracle;

//! Verification of approximations of the volume rendering integral
//!
//! I = ∫₀ᴰ C(s(λ)) τ(s(λ)) exp(−∫₀^λ τ(s(u)) du) dλ.
//!
//! In any [`real`] format, a [`case`] gives the field s, the transfer functions C and τ and, where it has a
//! closed form, the exact radiance, made by hand or from [`symbolic`] expressions; [`quadrature`] gives
//! rules, and a [`method`] approximates the integral on n segments; a [`reference`](mod@reference) is the
//! radiance to any number of digits; [`convergence`] fits the order of accuracy to its errors on a ladder
//! of n, with an interval and a verdict. A [`kernel`] is somebody else's implementation, put to the same test, and
//! [`identify`] reads off what it computes; [`assert_order!`] is that test in three lines.
//! A [`study`] runs many; [`report`] makes a [`document`] of what came out, which [`render`] shows in any format. A `scene` is a
//! ray as users have it, and a plan the least that it needs. A [`proof`] says a case to the proof assistant Coq.
//! A module uses only those that stand before it: `real`, `symbolic`, `volume`, `image`, `case`, `proof`, `scene`, `quadrature`, `method`,
//! `raycast`, `kernel`, `reference`, `confirm`, `convergence`, `identify`, `study`, `document`, `render`, `report`, `assert`.
//!
//! The feature `studies` has the modules `scene`, `proof`, `volume`, `image` and `raycast`, all of `study` and `report` but the verification of kernels, and
//! what only these need; the feature `half` has `f16` and `bf16` as the crate of that name computes them, and not emulated; the
//! feature `cli`, on by default, has both and the program.
//!
//! ```
//! use volver::case::SineSquared;
//! use volver::convergence::{Verdict, fit};
//! use volver::method::{Exponential, Expected, Inner, Method, Nested, Outer, Scope, expected};
//! use volver::quadrature::Rule;
//! use volver::real::Mpfr;
//! use volver::study::{Run, Silent, samples};
//!
//! // Simpson's rule for the optical depth under the trapezoid rule for the radiance.
//! let method = Method::Nested(Nested {
//!     inner: Inner::PerSegment(Rule::Simpson),
//!     outer: Outer(Rule::Trapezoid),
//!     exponential: Exponential::Exact,
//!     scope: Scope::Whole,
//! });
//! let ladder = [8, 16, 32, 64, 128, 256];
//! let run = Run::new(&SineSquared, Mpfr { bits: 200 }, &[method], &ladder, &Silent)?;
//!
//! let theory = expected(&method, &SineSquared);
//! assert_eq!(theory, Expected::Order(2.0));
//! let fit = fit(&samples(&SineSquared, &run, 0, None)?, Some(theory))?;
//! assert_eq!(fit.verdict, Verdict::Confirmed);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod assert;
#[cfg(feature = "studies")]
mod binary;
pub mod case;
pub mod confirm;
pub mod convergence;
pub mod document;
pub mod identify;
#[cfg(feature = "studies")]
pub mod image;
pub mod input;
#[doc(hidden)]
pub mod inside;
pub mod kernel;
pub mod method;
#[cfg(feature = "studies")]
mod output;
mod parallel;
#[cfg(feature = "studies")]
pub mod proof;
pub mod quadrature;
#[cfg(feature = "studies")]
pub mod raycast;
pub mod real;
pub mod reference;
pub mod render;
pub mod report;
#[cfg(feature = "studies")]
pub mod scene;
pub mod study;
pub mod symbolic;
#[cfg(feature = "studies")]
pub mod volume;

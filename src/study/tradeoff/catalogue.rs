//! What is compared where nobody says what.

use crate::method::Method;
use crate::real::FormatName;

/// All kinds of methods by name: equal rules, mixed ones, polynomial exponentials, random depths, compositing
/// as renderers have it, and pre-integration with and without closed forms.
pub const METHODS: &[&str] = &[
    "riemann-left/riemann-left",
    "riemann-right/riemann-right",
    "midpoint/midpoint",
    "trapezoid/trapezoid",
    "simpson/simpson",
    "boole/boole",
    "gauss-2/gauss-2",
    "gauss-3/gauss-3",
    "gauss-4/gauss-4",
    "gauss-6/gauss-6",
    "gauss-8/gauss-8",
    "riemann-left/trapezoid",
    "trapezoid/simpson",
    "simpson/trapezoid",
    "simpson/boole",
    "gauss-2/simpson",
    "gauss-3/boole",
    "simpson-pairs-parabola/simpson",
    "trapezoid/trapezoid/linear",
    "trapezoid/trapezoid/quadratic",
    "trapezoid/trapezoid/cubic",
    "monte-carlo-stratified@1/trapezoid",
    "front-to-back/front/subtraction",
    "front-to-back/middle/subtraction",
    "front-to-back/back/subtraction",
    "front-to-back/front/expm1",
    "front-to-back/middle/expm1",
    "front-to-back/middle/relative",
    "front-to-back/middle/linear",
    "front-to-back/middle/expm1/neumaier",
    "front-to-back/middle/expm1/depths/neumaier",
    "front-to-back/middle/expm1/remainder",
    "front-to-back/middle/expm1/remainder/neumaier",
    "front-to-back/middle/expm1/pairwise",
    "front-to-back/middle/expm1/stop=1:255",
    "back-to-front/middle/expm1",
    "tree/middle/expm1",
    "preintegrated/linear/linear",
    "preintegrated/quadratic-midpoint/quadratic-midpoint",
    "preintegrated/linear-by-4-trapezoid/linear-by-4-trapezoid",
    "preintegrated/quadratic-by-2-simpson/quadratic-by-2-simpson",
    "preintegrated/quadratic-midpoint-by-2-gauss-2/quadratic-midpoint-by-2-gauss-2",
];

/// What most renderers do: one sample in front of each segment, α = 1 − e^(−τd).
pub const USUAL_METHOD: &str = "front-to-back/front/subtraction";
/// What most renderers compute in.
pub const USUAL_FORMAT: FormatName = FormatName::F32;

/// [`METHODS`], read.
#[must_use]
pub fn default_methods() -> Vec<Method> {
    let methods = METHODS.iter().filter_map(|name| name.parse().ok());
    methods.collect()
}

/// Binary32 and binary64 as processors have them; MPFR with the bits of binary128; and MPFR with 160 bits, where
/// rounding leaves 1e-30 alone even after thousands of segments.
#[must_use]
pub fn default_formats() -> Vec<FormatName> {
    vec![
        FormatName::F32,
        FormatName::F64,
        FormatName::Mpfr(113),
        FormatName::Mpfr(160),
    ]
}

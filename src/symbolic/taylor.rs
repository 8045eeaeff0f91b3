//! Taylor coefficients of programs, enclosed over a panel in binary64 rounded outwards.
//!
//! With λ = m + r u, |u| ≤ 1, coefficient k of f encloses f⁽ᵏ⁾(λ) rᵏ/k! at every λ of the panel: what the
//! remainders of interpolation and of quadrature are bounded by. It is automatic differentiation over
//! intervals: Moore, Kearfott and Cloud, *Introduction to Interval Analysis* (2009), chapter 9.

mod functions;
mod program;
mod range;
mod series;

pub use program::taylor;
pub use range::Range;
pub use series::Taylor;

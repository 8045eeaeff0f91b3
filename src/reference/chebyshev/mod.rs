//! Chebyshev series on nested Clenshaw–Curtis points, in MPFR.
//!
//! The points of degree n = 2ᵐ are ξₖ = cos(πk/n), k = 0 … n: those of n are every other one of 2n. The series
//! f = Σ aⱼ Tⱼ through values at them and back is one fast cosine transform, O(n log n).
//!
//! Source: Clenshaw and Curtis (1960), "A method for numerical integration on an automatic computer".

mod circle;
mod series;
pub(crate) mod transform;

pub use circle::Circle;
pub use series::Series;
pub(super) use series::log2_abs;

//! Quadrature rules: each yields nodes and weights on the unit interval for a number of bits, and knows its order.

mod collocation;
mod gauss_legendre;
mod monte_carlo;
mod newton_cotes;
mod rule;

pub use collocation::{Collocation, collocation};
pub use monte_carlo::{Draw, Draws, Sampling};
pub use rule::{MAX_GAUSS_POINTS, Rule, RuleError, UnitRule};

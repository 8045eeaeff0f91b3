//! x
pub mod case;
pub mod convergence;
pub mod method;
pub mod quadrature;
pub mod real;
pub mod study;

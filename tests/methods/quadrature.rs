//! Tables of rules and random numbers, against closed forms, the literature and other programs.

mod collocation;
mod gauss_legendre;
mod monte_carlo;
mod rule;

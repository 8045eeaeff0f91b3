//! Fits, windows, intervals and verdicts: worked by hand, and measured on synthetic errors.

mod bootstrap;
mod decimal;
mod fit;
mod ladder;
mod line;
mod model;
mod random;
mod replicas;
mod richardson;
mod sample;
mod table;
mod transition;
mod verdict;
mod window;

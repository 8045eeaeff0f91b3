//! Cases: their files, their derivation, and what holds of every one.

mod closed_forms;
mod file;
mod manufacture;
mod nodes;
mod random;

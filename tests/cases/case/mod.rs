//! Cases: their files, their derivation, and what holds of every one.

mod closed_forms;
mod confirm;
mod file;
mod manufacture;
mod nodes;
mod random;

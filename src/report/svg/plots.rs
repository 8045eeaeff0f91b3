//! Where plots were built.

pub(in crate::report) use crate::report::plots::{of_split, of_table};

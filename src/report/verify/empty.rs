//! Cells without a figure.

/// What stands where there is no figure.
pub(super) const NONE: &str = "-";

//! A row of pixels to be filled.

use super::span::Span;

/// A row of pixels to be filled.
pub(super) struct Row<'r> {
    pub(super) spans: &'r [Option<Span>],
    /// All channels of a pixel side by side.
    pub(super) values: &'r mut [f64],
    pub(super) channels: usize,
}

//! `--spacing`: where the segments of a ray end.

use volver::kernel::{Spacing, SpacingError};

/// A spacing; none of an even one.
#[derive(Clone, Copy)]
pub(super) struct Spaced(pub(super) Option<Spacing>);

pub(super) fn spacing(text: &str) -> Result<Spaced, SpacingError> {
    match text {
        "even" => Ok(Spaced(None)),
        _ => text.parse().map(|spacing| Spaced(Some(spacing))),
    }
}

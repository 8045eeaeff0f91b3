//! Texts of JSON, and what is wrong with them.

use crate::binary::{Trouble, refused};
use crate::input;

pub(super) fn unreadable(error: input::InputError) -> Trouble {
    match error {
        input::InputError::Unreadable { error, .. } => Trouble::System(error),
        other => refused(other.to_string(), "a text of JSON"),
    }
}

#[allow(clippy::needless_pass_by_value)] // As map_err hands it out.
pub(super) fn json(error: serde_json::Error) -> Trouble {
    refused(
        format!("{error}"),
        "JSON of the form that docs/images.md has",
    )
}

//! What a page says of its making.

use volver::document::About;

/// The command as it was given, on this machine.
pub(crate) fn about() -> About {
    About::new(std::env::args_os())
}

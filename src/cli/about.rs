//! What a page says of its making.

use volver::document::About;

/// The command as it was given, on this machine.
///
/// Without `--resume`: a run that was interrupted and gone on with made what one made that was not.
pub(crate) fn about() -> About {
    About::new(std::env::args_os().filter(|argument| argument != "--resume"))
}

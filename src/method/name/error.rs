//! Why a text is no method's name.

/// Text that names no method.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MethodNameError {
    /// A part is none of those that may stand there.
    #[error("method '{name}': unknown {what} '{part}' (allowed: {allowed})")]
    Unknown {
        /// The whole text.
        name: String,
        /// What stands there in a name.
        what: &'static str,
        /// The part.
        part: String,
        /// What may stand there.
        allowed: String,
    },
    /// The text ends too early.
    #[error("method '{name}': {what} missing at the end (allowed: {allowed})")]
    Missing {
        /// The whole text.
        name: String,
        /// What would stand there in a name.
        what: &'static str,
        /// What may stand there.
        allowed: String,
    },
    /// A part where the name should have ended.
    #[error(
        "method '{name}': one part too many, '{part}' (allowed: nothing after what stands before it)"
    )]
    Extra {
        /// The whole text.
        name: String,
        /// The part.
        part: String,
    },
    /// An option that says again, or otherwise, what one before it said.
    #[error("method '{name}': '{part}' after an option of the same kind (allowed: one of a kind)")]
    Repeated {
        /// The whole text.
        name: String,
        /// The part.
        part: String,
    },
}

//! Why a baseline cannot be used.

use super::{FIRST, VERSION};
use crate::kernel::SpacingError;
use crate::study::verify::SettingsError;

/// A baseline that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BaselineError {
    /// No JSON of a baseline.
    #[error("no baseline: {reason} (allowed: what 'volver verify --save' writes)")]
    Format {
        /// Why.
        reason: String,
    },
    /// Another version.
    #[error("a baseline of version {found} (allowed: {FIRST}, {VERSION})")]
    Version {
        /// Its version.
        found: u64,
    },
    /// Another word than those for how a rule is read off.
    #[error("'identify': '{}' (allowed: auto, full, off)", found.escape_debug())]
    Identify {
        /// The word.
        found: String,
    },
    /// Another word than those for where segments end.
    #[error("'spacing': {error}")]
    Spacing {
        /// Why.
        error: SpacingError,
    },
    /// Levels, an order or a number of seeds that no kernel can be tested with.
    #[error("'{key}': {error}")]
    Settings {
        /// Where.
        key: &'static str,
        /// Why.
        error: SettingsError,
    },
    /// A channel that no kernel shows.
    #[error("'lines', '{}': {problem}", name.escape_debug())]
    Line {
        /// The channel's name.
        name: String,
        /// What is wrong, and what is allowed.
        problem: &'static str,
    },
}

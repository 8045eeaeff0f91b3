//! What no verification can be made of.

use super::SettingsError;
use crate::identify::Silence;
use crate::kernel::{DeclarationError, KernelError, SubjectError};
use crate::reference::ReferenceError;
use std::num::NonZeroUsize;

/// What no verification can be made of.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VerifyError {
    /// The kernel is gone for good.
    #[error(transparent)]
    Gone(#[from] KernelError),
    /// The kernel declares what cannot all be.
    #[error(transparent)]
    Declaration(#[from] DeclarationError),
    /// The kernel takes what the ladder has not enough of.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The ray of a case cannot be cut so.
    #[error("{case}: {error}")]
    Cut {
        /// The case.
        case: String,
        /// Why.
        error: crate::kernel::CutError,
    },
    /// A case has no reference.
    #[error("{case}: {error}")]
    Reference {
        /// The case.
        case: String,
        /// Why.
        error: ReferenceError,
    },
    /// More rays in one request than the kernel takes.
    #[error("--batch {count} (allowed: 2 to {most}, as the kernel declares)")]
    Batch {
        /// How many were wanted.
        count: usize,
        /// How many it takes.
        most: NonZeroUsize,
    },
    /// Many rays in one request have no answers, and alone neither.
    #[error("--batch: {0}")]
    Together(#[from] Silence),
    /// A background that is none of the case.
    #[error(transparent)]
    Background(#[from] SubjectError),
    /// The kernel wants what there is none of on this axis.
    #[error("the kernel takes {form} (allowed with --axis grid: volume)")]
    Axis {
        /// The form it takes.
        form: crate::kernel::FormKind,
    },
    /// The kernel is not given segments, or takes even ones alone.
    #[error(
        "the kernel takes {form} cut by itself or evenly (allowed with --spacing: segments, whatever their lengths)"
    )]
    Spacing {
        /// The form it takes.
        form: crate::kernel::FormKind,
    },
    /// The kernel answers nothing that is looked at on this axis.
    #[error(
        "the kernel answers no radiance (allowed with --axis grid: a radiance among its answers)"
    )]
    NoRadiance,
    /// A formula without code.
    #[error("{case}: {error}")]
    Formula {
        /// The case.
        case: String,
        /// Why.
        error: crate::symbolic::CompileError,
    },
    /// Errors that no fit can take.
    #[error("{case}: {error}")]
    Fit {
        /// The channel.
        case: String,
        /// Why.
        error: crate::convergence::FitError,
    },
    /// Replicas that no fit can take.
    #[error("{case}: {error}")]
    Replicas {
        /// The channel.
        case: String,
        /// Why.
        error: crate::convergence::ReplicasError,
    },
}

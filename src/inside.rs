//! What this crate's own tests look at; no part of the interface.

/// Inside [`method`](crate::method).
pub mod method {
    pub use crate::method::preintegrated::attenuated_integral;
}

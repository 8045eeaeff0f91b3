//! What this crate's own tests look at; no part of the interface.

/// Of [`case`](mod@crate::case).
pub mod case {
    pub use crate::case::nodes::grid::Grid;
}

/// Of [`symbolic`](crate::symbolic).
pub mod symbolic {
    pub use crate::symbolic::normal_form::arena::{Arena, Atom, PolynomialId};
    pub use crate::symbolic::normal_form::coefficient::Coefficient;
    pub use crate::symbolic::normal_form::polynomial::{MonomialId, Polynomial};
    pub use crate::symbolic::normal_form::ratio::Ratio;
    pub use crate::symbolic::normal_form::translate::translate;
}

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

/// Inside [`convergence`](crate::convergence).
pub mod convergence {
    pub use crate::convergence::bootstrap::{Resampler, quantile};
    pub use crate::convergence::line::{Line, least_squares};
    pub use crate::convergence::replicas::moments::of as moments;
    pub use crate::convergence::richardson::start;
    pub use crate::convergence::verdict::{Beyond, Estimate, Evidence, Trend, alternate, judge};
}

/// Inside [`kernel`](crate::kernel).
pub mod kernel {
    pub use crate::kernel::process::answer::read as read_answer;
    pub use crate::kernel::process::bare::quoted;
    pub use crate::kernel::process::greeting::{Greeting, read as read_greeting};
    pub use crate::kernel::process::trouble::Trouble;
    pub use crate::kernel::process::written::{Array, Numbers, Written};
}

/// Inside [`method`](crate::method).
pub mod method {
    pub use crate::method::preintegrated::attenuated_integral;
}

/// Inside [`reference`](mod@crate::reference).
pub mod reference {
    pub use crate::reference::chebyshev::transform::cosine_transform;
    pub use crate::reference::chebyshev::{Circle, Series};
    pub use crate::reference::enclosure::{Points, Rectangle, range, substituted};
}

/// Inside [`study`](crate::study).
pub mod study {
    pub use crate::study::run::{exact, exact_radiance};
    #[cfg(feature = "studies")]
    pub use crate::study::tradeoff::calibration::solve::costs;
    #[cfg(feature = "studies")]
    pub use crate::study::tradeoff::counting::counts;

    /// Inside [`plan`](crate::study::plan).
    #[cfg(feature = "studies")]
    pub mod plan {
        pub use crate::study::plan::candidates::{Candidate, Forest, Node};
        pub use crate::study::plan::certify::{Bounds, bounds, nearest_polynomial};
        pub use crate::study::plan::choose::{Chosen, choose};
    }

    /// Inside [`verify`](crate::study::verify).
    pub mod verify {
        pub use crate::study::verify::of_order::methods;
        pub use crate::study::verify::standing::{Judged, of};
    }
}

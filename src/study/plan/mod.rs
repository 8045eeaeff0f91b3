//! The least model of a scene that is enough for a tolerance.
//!
//! - [`survey`](self): the ray is cut into panels on which the interpolation of C and τ and the quadrature of
//!   C τ e^(−t) are bounded by Taylor coefficients enclosed in intervals; so the radiance, the transmittance and the
//!   light from behind are known everywhere, with a bound on their error.
//! - candidates: for stretches of one panel, of many or of a whole medium the models that may do, from nothing at
//!   all to many points, and what each does to the radiance: the largest error that it or one of more points makes.
//! - choice: the cheapest models whose errors add up to less than the tolerance, by a Lagrangian.
//! - format: the shortest allowed one in which the plan, rehearsed, rounds by less than what is left.
//!
//! With fₖ(x) = Eₖ + e^(−tₖ) x the light that leaves stretch k at its front where x comes in at its back,
//! I = f₁(f₂(…(background))), and models f̃ₖ instead err by at most ∑ T(aₖ) (|Ẽₖ − Eₖ| + |e^(−t̃ₖ) − e^(−tₖ)| R̃ₖ) with T the
//! true transmittance in front and R̃ what the models let in from behind.

mod brightest;
pub(crate) mod candidates;
pub(crate) mod certify;
pub(crate) mod choose;
mod cost;
mod draft;
mod error;
mod format;
mod layout;
mod light;
mod make;
mod model;
mod restore;
mod run;
mod series;
mod settings;
mod stored;
mod survey;
mod truth;
mod weights;

pub use cost::{Cost, TimeCost};
pub use error::PlanError;
pub use make::Plan;
pub use model::Model;
pub use run::Rendered;
pub use settings::Settings;
pub use stored::{Because, Checked, CheckedChannel, Step, StoredPlan, Uncertainty};
pub use truth::scene_radiance;

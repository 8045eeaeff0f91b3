//! What other light of a stretch does to the radiance.

use super::light::{Light, size};
use super::stored::Because;
use crate::real::Real;

/// What an error of a stretch does to the radiance.
pub(super) struct Weights<'a, R> {
    /// T in front of it.
    pub(super) front: &'a [R],
    /// The light from behind it.
    pub(super) behind: &'a [R],
    /// Its own light.
    pub(super) exact: &'a [Light<R>],
}

impl<R: Real> Weights<'_, R> {
    /// What other light makes of the radiance, in the channel where that is most.
    pub(super) fn because(&self, light: &[Light<R>]) -> Because {
        let pairs = light.iter().zip(self.exact);
        let channels = pairs.zip(self.front.iter().zip(self.behind));
        let errors = channels
            .enumerate()
            .map(|(i, ((found, exact), (front, behind)))| {
                let passes = |light: &Light<R>| (-light.depth.clone()).exp();
                Because {
                    channel: i + 1,
                    front: size(front),
                    radiance: size(&(found.radiance.clone() - &exact.radiance)),
                    transmittance: size(&(passes(found) - &passes(exact))),
                    behind: size(behind),
                }
            });
        let worst = errors.reduce(|a, b| if b.error() > a.error() { b } else { a });
        worst.unwrap_or_default()
    }
}

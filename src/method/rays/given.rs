//! Compositing of samples that somebody else has taken.

use super::{RayError, side_by_side};
use crate::real::lanes::{LaneFloat, Lanes, WithLanes};

/// Σ Cⱼ αⱼ Tⱼ from front to back of each of `rays` rays, as many side by side as
/// [`Width::current`](crate::real::lanes::Width::current) says; sample j of ray r stands at j · `rays` + r. T is made of the
/// opacities: T (1 − α), or T − T α where it is what [remains](crate::method::Accumulation::Remainder).
///
/// # Errors
/// [`RayError::Samples`] where there are not as many colours as opacities, or no multiple of `rays`.
pub fn composite_given<T: LaneFloat>(
    colors: &[T],
    opacities: &[T],
    rays: usize,
    remainder: bool,
) -> Result<Vec<T>, RayError> {
    if colors.len() != opacities.len() || rays == 0 || !colors.len().is_multiple_of(rays) {
        return Err(RayError::Samples {
            colors: colors.len(),
            opacities: opacities.len(),
            rays,
        });
    }
    let mut radiances = vec![T::ZERO; rays];
    side_by_side(rays, |width, from, to| {
        width.with(Given {
            colors,
            opacities,
            rays,
            first: from,
            radiances: &mut radiances[from..to],
            remainder,
        });
    });
    Ok(radiances)
}

/// Rays to composite, from the `first` on: a multiple of the width.
struct Given<'g, T> {
    colors: &'g [T],
    opacities: &'g [T],
    rays: usize,
    first: usize,
    radiances: &'g mut [T],
    remainder: bool,
}

impl<T: LaneFloat> WithLanes<T> for Given<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        let one = zero.all(T::ONE);
        for (lanes, radiances) in self.radiances.chunks_exact_mut(L::WIDTH).enumerate() {
            let first = self.first + lanes * L::WIDTH;
            let samples = self.colors.chunks_exact(self.rays);
            let (mut radiance, mut transmittance) = (zero, one);
            for (colors, opacities) in samples.zip(self.opacities.chunks_exact(self.rays)) {
                let color = zero.load(&colors[first..]);
                let opacity = zero.load(&opacities[first..]);
                radiance = radiance + color * opacity * transmittance;
                transmittance = if self.remainder {
                    transmittance - opacity * transmittance
                } else {
                    transmittance * (one - opacity)
                };
            }
            radiance.store(radiances);
        }
    }
}

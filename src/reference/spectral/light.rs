//! The light of a panel: ∫ C τ e^(−t).

use super::super::chebyshev::{Circle, Series, log2_abs};
use super::grid::interleaved;
use super::verdict::{Verdict, verdict};
use super::{Settings, Work};
use rug::Float;

/// A panel with its series.
pub(super) struct Resolved<'r> {
    /// t from the left end.
    pub(super) depth: Series,
    /// C·τ.
    pub(super) source: Series,
    /// C·τ on the points of its degree.
    pub(super) values: &'r [Float],
    pub(super) width: Float,
    /// log₂ of the transmittance up to the panel.
    pub(super) transmittance: f64,
    /// log₂ of what the coefficients of C τ e^(−t) may be off by.
    pub(super) allowance: f64,
}

/// The light of a panel, with T = 1 at its left end.
pub(super) struct Light {
    pub(super) total: Float,
    /// log₂ of the largest coefficient of C τ e^(−t).
    pub(super) largest: f64,
    /// log₂ of what is left out.
    pub(super) tail: f64,
}

impl Light {
    /// No light.
    pub(super) fn none() -> Light {
        Light {
            total: Float::new(64),
            largest: f64::NEG_INFINITY,
            tail: f64::NEG_INFINITY,
        }
    }
}

/// The light; `None` where C τ e^(−t) is not resolved by as many coefficients as is reasonable.
///
/// The series of t and C·τ are evaluated at as many points as the product needs: the medium is not asked
/// again, and no exponential taken twice.
pub(super) fn light(
    panel: &Resolved<'_>,
    circle: &mut Circle,
    settings: &Settings,
    work: &mut Work,
) -> Option<Light> {
    let brightest = panel.source.log2_largest(0..=panel.source.degree());
    if brightest == f64::NEG_INFINITY {
        return Some(Light::none());
    }
    if brightest <= panel.allowance - 8.0 {
        // Too dark to be seen from the near end.
        return Some(Light {
            tail: brightest,
            ..Light::none()
        });
    }
    let limit = 2 * settings.limit;
    let mut n = panel.source.degree();
    circle.grow(n);
    let mut dimmed = |source: Vec<Float>, depths: Vec<Float>| -> Vec<Float> {
        work.transcendental_calls += depths.len() as u64;
        let both = source.into_iter().zip(depths);
        both.map(|(source, depth)| source * (-depth).exp())
            .collect()
    };
    let mut seen = dimmed(panel.values.to_vec(), panel.depth.values(n, circle));
    loop {
        let series = Series::through(&seen, circle);
        let largest = series.log2_largest(0..=n);
        let floor = largest - f64::from(settings.precision) + 40.0;
        match verdict(&series, panel.allowance.max(floor), limit) {
            Verdict::Resolved { tail } => {
                let total = series.integral(&panel.width).at_right();
                // Where nothing is seen at all the sum is 0.
                let is_dark = log2_abs(&total) == f64::NEG_INFINITY;
                return Some(Light {
                    total,
                    largest: if is_dark { brightest } else { largest },
                    tail,
                });
            }
            Verdict::Open => {
                n *= 2;
                circle.grow(n);
                let [source, depths] =
                    [&panel.source, &panel.depth].map(|series| series.values_between(n, circle));
                seen = interleaved(seen, dimmed(source, depths));
            }
            Verdict::Hopeless => return None,
        }
    }
}

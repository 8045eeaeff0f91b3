//! Whether answers that differ from seed to seed scatter as samples at random places in each segment do.

use super::{OpacityModel, Watched};
use crate::case::Case;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use std::fmt;

/// Rays that mean and scatter are taken of.
const RAYS: usize = 400;
/// Standard deviations that no answer lies away from the mean.
const FARTHEST: f64 = 5.0;
/// The part of the channels that must agree.
const ENOUGH: f64 = 0.9;
/// The root mean square of (one answer − the other)/(√2 deviation) is 1; of some 20 channels it lies between these.
const NEAR_ONE: (f64, f64) = (0.6, 1.5);

/// Compositing with samples at random places that answers scatter like.
#[derive(Clone, Debug, PartialEq)]
pub struct Jittered {
    /// The opacity.
    pub opacity: OpacityModel,
    /// Channels, by index, whose answers lie where they should.
    pub agrees: Vec<usize>,
    /// Channels compared.
    pub of: usize,
}

impl fmt::Display for Jittered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "jittered samples, {}: mean and scatter agree in {} of {} channels",
            self.opacity,
            self.agrees.len(),
            self.of
        )
    }
}

/// The opacity formula with which compositing at random places in each segment scatters like two answers of every
/// channel at its coarsest level; `None` where none does.
#[must_use]
pub fn jittered(watched: &[Watched]) -> Option<Jittered> {
    let models = [
        OpacityModel::Exact,
        OpacityModel::Linear,
        OpacityModel::Unattenuated,
    ];
    let mut found: Vec<Jittered> = models
        .into_iter()
        .filter_map(|opacity| agrees(watched, opacity))
        .collect();
    found.sort_by_key(|one| std::cmp::Reverse(one.agrees.len()));
    found.into_iter().next()
}

fn agrees(watched: &[Watched], opacity: OpacityModel) -> Option<Jittered> {
    let mut random = Pcg64::seed_from_u64(0);
    let mut agrees = Vec::new();
    let mut squares = Vec::new();
    let mut of = 0;
    for (index, watched) in watched.iter().enumerate() {
        let Some(((mean, deviation), values)) =
            moments(watched, opacity, &mut random).zip(values(watched))
        else {
            continue;
        };
        of += 1;
        let rounding = 1e-6 * mean.abs();
        let far = |value: &f64| (value - mean).abs() > FARTHEST * deviation + rounding;
        if !values.iter().any(far) {
            agrees.push(index);
        }
        if deviation > rounding {
            let [first, second] = values;
            squares.push(((first - second) / deviation).powi(2) / 2.0);
        }
    }
    let spread = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    let (low, high) = NEAR_ONE;
    let enough = agrees.len() as f64 >= ENOUGH * of as f64;
    (enough && low < spread && spread < high).then_some(Jittered {
        opacity,
        agrees,
        of,
    })
}

/// Both answers, where they say something.
fn values(watched: &Watched) -> Option<[f64; 2]> {
    let first = watched.levels.first()?.value;
    let values = [first, watched.again?];
    let says = watched.scale > 0.0 && values.iter().all(|value| value.is_finite());
    says.then_some(values)
}

/// Mean and standard deviation of the radiance at the coarsest level.
fn moments(watched: &Watched, opacity: OpacityModel, random: &mut Pcg64) -> Option<(f64, f64)> {
    let lengths = &watched.levels.first()?.ray.lengths;
    let radiances: Vec<f64> = (0..RAYS)
        .map(|_| {
            let (mut radiance, mut transmittance, mut near) = (0.0, 1.0, 0.0);
            for length in lengths {
                let lambda = near + length * unit(random);
                let transfer = watched.case.transfer(&watched.case.field(&lambda));
                let depth = transfer.extinction * length;
                let (alpha, passes) = match opacity {
                    OpacityModel::Linear => (depth, 1.0 - depth),
                    OpacityModel::Unattenuated => (depth, (-depth).exp()),
                    _ => (-(-depth).exp_m1(), (-depth).exp()),
                };
                radiance += transmittance * transfer.emission * alpha;
                transmittance *= passes;
                near += length;
            }
            radiance
        })
        .collect();
    let count = RAYS as f64;
    let mean = radiances.iter().sum::<f64>() / count;
    let variance = radiances.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / (count - 1.0);
    Some((mean, variance.sqrt()))
}

/// Between 0 and 1.
fn unit(random: &mut Pcg64) -> f64 {
    (random.next_u64() >> 11) as f64 / 53_f64.exp2()
}

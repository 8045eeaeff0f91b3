//! Rays that may end early, asked one by one: the last sample that counts, and what an end is said with.

use super::Lone;
use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::rule::{Place, Sequence, Stop};
use crate::identify::session::Session;
use crate::identify::weights::Measured;

/// An early end, between these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::identify) struct Early {
    pub(in crate::identify) stop: Stop,
    pub(in crate::identify) bracket: (f64, f64),
}

/// A ray, and the last sample that counted on it.
pub(super) struct Trial {
    /// T behind every sample, in order.
    pub(super) after: Vec<f64>,
    /// The weight of every sample.
    pub(super) weights: Vec<f64>,
    /// What all samples up to each weigh by themselves.
    pub(super) sums: Vec<f64>,
    /// The position of the last one that counted.
    pub(super) last: usize,
    /// What it was seen to weigh.
    pub(super) seen: Measured,
    /// What all samples were seen to weigh, along the ray.
    pub(super) all: Vec<Measured>,
}

/// The simplest threshold of a bracket: 0.05 is said as 1 − 0.95 where that has fewer digits.
pub(super) fn simplest_threshold((low, high): (f64, f64)) -> f64 {
    let under = simplest(low, high);
    // 1/255 and its like.
    let part = 1.0 / (1.0 / under).round();
    if (low..=high).contains(&part) && part >= 1.0 / 65_536.0 && high / low - 1.0 < 1e-4 {
        return part;
    }
    let opaque = 1.0 - simplest(1.0 - high, 1.0 - low);
    let is_shorter = format!("{:e}", 1.0 - opaque).len() < format!("{under:e}").len();
    if (low..=high).contains(&opaque) && is_shorter {
        opaque
    } else {
        under
    }
}

/// Which sample of a ray is the last that counts.
pub(super) fn trial(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    taus: &[f64],
    length: f64,
) -> Result<Trial, NotIdentified> {
    let n = taus.len();
    let ray = n as f64 * length;
    let sequence = lone.measurer.samples.sequence;
    // Samples in the order in which they are taken, whatever end that is.
    let order = order(&sequence, n);
    let is_coarse = lone.measurer.answers.is_coarse();
    let w = if is_coarse {
        Vec::new()
    } else {
        lone.measurer.weights(session, taus, length)?
    };
    let (mut after, mut weights, mut sums) = (Vec::new(), Vec::new(), Vec::new());
    let mut sum = 0.0;
    // One sample too many stands in front of all at the back of segments.
    let is_behind = lone.measurer.samples.place == Place::Back && sequence.extra.is_some();
    let mut passes = if is_behind && !sequence.swapped {
        lone.of(taus[0], length, ray).1
    } else {
        1.0
    };
    for &k in &order {
        let (weight, through) = lone.of(taus[k], length, ray);
        weights.push(weight * passes);
        sum += weight / lone.law.scale.0;
        sums.push(sum);
        passes *= through;
        after.push(passes);
    }
    let (last, seen) = if is_coarse {
        let last = lone.measurer.last_lit(session, taus, length, &order)?;
        // How much it weighs is not asked.
        let seen = Measured {
            value: weights.get(last).copied().unwrap_or(f64::NAN),
            error: f64::INFINITY,
        };
        (last, seen)
    } else {
        let lit = |k: &usize| w[*k].value.abs() > 3.0 * w[*k].error;
        let last = order.iter().rposition(lit).unwrap_or(0);
        (last, w[order[last]])
    };
    Ok(Trial {
        after,
        weights,
        sums,
        last,
        seen,
        all: w,
    })
}

/// Positions of samples along the order, counted from where the march begins.
fn order(sequence: &Sequence, n: usize) -> Vec<usize> {
    let forward = Sequence {
        swapped: false,
        extra: None,
        ..*sequence
    };
    let all = forward.order(n, false, false);
    let all = all.into_iter().filter_map(|i| usize::try_from(i).ok());
    let all = all.filter(|i| *i < n);
    if sequence.swapped {
        // `weights` has turned the ray: the first is where the march begins.
        let all: Vec<usize> = all.collect();
        let turned = all.iter().rev().map(|i| n - 1 - i);
        return turned.collect();
    }
    all.collect()
}

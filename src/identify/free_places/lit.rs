//! Samples by the hats of emission that they light: two neighbours by (1 − f) w and f w.

use crate::identify::weights::{Answers, Measured};

/// One sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::identify) struct Lit {
    /// Its place among the hats, that of the first being 0.
    pub(in crate::identify) at: f64,
    /// What it weighs.
    pub(in crate::identify) weight: f64,
}

/// The samples behind the answers to a dark channel and then to each hat; and the most hats that one lights. `None` where
/// samples stand too close to be told apart.
pub(in crate::identify) fn lit(answers: &Answers, y: &[f64], bright: f64) -> Option<Vec<Lit>> {
    let (clusters, _) = clusters(answers, y, bright);
    clusters
        .into_iter()
        .map(|cluster| match cluster.as_slice() {
            [(at, w)] => Some(Lit {
                at: *at as f64,
                weight: *w,
            }),
            [(at, near), (_, far)] if near * far > 0.0 => {
                let weight = near + far;
                Some(Lit {
                    at: *at as f64 + far / weight,
                    weight,
                })
            }
            _ => None,
        })
        .collect()
}

/// Neighbouring hats that have weight, and the largest weight.
pub(in crate::identify) fn clusters(
    answers: &Answers,
    y: &[f64],
    bright: f64,
) -> (Vec<Vec<(usize, f64)>>, f64) {
    let read: Vec<Measured> = y.iter().map(|y| answers.radiance(*y)).collect();
    let Some((dark, hats)) = read.split_first() else {
        return (Vec::new(), 0.0);
    };
    let of = |lit: &Measured| (lit.value - dark.value) / bright;
    let top = hats.iter().map(|hat| of(hat).abs()).fold(0.0, f64::max);
    // Hats that no sample sees are dark to the bit, but for what is added to all.
    let least = 1e-14 * top * bright.abs() + 6.0 * dark.error;
    let mut found: Vec<Vec<(usize, f64)>> = Vec::new();
    let mut before = false;
    for (k, hat) in hats.iter().enumerate() {
        let is_lit = (of(hat) * bright).abs() > least;
        match found.last_mut() {
            Some(cluster) if is_lit && before => cluster.push((k, of(hat))),
            _ if is_lit => found.push(vec![(k, of(hat))]),
            _ => {}
        }
        before = is_lit;
    }
    (found, top)
}

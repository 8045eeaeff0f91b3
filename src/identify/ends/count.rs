//! How many samples are taken of n segments.

use super::Lone;
use crate::identify::NotIdentified;
use crate::identify::influence::layers_at;
use crate::identify::ray::Emission;
use crate::identify::rule::{Place, Rule, Sequence, StopBy};
use crate::identify::session::Session;
use crate::identify::weights::nodes_of;
use crate::identify::weights::weights;

/// Numbers of segments whose samples are counted.
const SMALL: [usize; 5] = [1, 3, 5, 13, 17];
/// Where there are fewer questions to spend: of 11 every group leaves a rest of its own that takes all of the 12 of the even
/// medium.
const LEAN: [usize; 1] = [11];
/// Of the even medium.
const EVEN: usize = 12;
/// Groups that loops are unrolled by.
const GROUPS: [u64; 7] = [2, 4, 8, 16, 3, 5, 7];
/// Segments of a long ray.
const LONG: usize = 4_300;
/// Borders looked at in one ray.
const AT_ONCE: usize = 13;
/// The same where there are few rays: as many as there are channels.
const AT_ONCE_SHORT: usize = 60;
/// The fewest samples beyond which none may be taken where they are looked for in one ray.
const FEWEST: usize = 16;

/// The sequence with its counts.
pub(in crate::identify) fn counts(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    rule: &Rule,
    lean: bool,
) -> Result<Sequence, NotIdentified> {
    let mut sequence = lone.measurer.samples.sequence;
    let place = lone.measurer.samples.place;
    let extra = sequence.extra.is_some();
    let mut tau = visible(lone, 0.27 * lone.reference(0.25));
    if let Some(stop) = rule.stop.filter(|stop| stop.by == StopBy::Weight) {
        // Thick enough that no sample ends the ray.
        let thick = lone.with_weight(8.0 * stop.under, 0.25, f64::NAN);
        tau = tau.max(thick.unwrap_or(tau));
    }
    if let Some(stop) = rule.stop.filter(|stop| stop.by == StopBy::Sum) {
        // Thin enough that none does.
        let thin = lone.with_weight(stop.under / 64.0, 0.25, f64::NAN);
        tau = tau.min(thin.unwrap_or(tau));
    }
    let back = place == Place::Back;
    let small: &[usize] = if lean { &LEAN } else { &SMALL };
    let mut seen: Vec<(usize, usize)> = Vec::new();
    let multiple = session.multiple;
    for &n in small.iter().filter(|n| n.is_multiple_of(multiple)) {
        let taus = vec![tau; n];
        let layers = layers_at(place, 0.25, &taus, &taus);
        let nodes = nodes_of(place, n, extra);
        let Ok(found) = weights(session, lone.measurer.answers, &layers, &nodes, &[]) else {
            // No answer to so few.
            continue;
        };
        let lit = found.of.iter().filter(|w| w.value.abs() > 3.0 * w.error);
        seen.push((n, lit.count()));
    }
    let expected = |sequence: &Sequence, n: usize| {
        let mut order = sequence.order(n, false, back);
        order.sort_unstable();
        order.dedup();
        order.iter().filter(|i| place.node(**i).is_some()).count()
    };
    if seen.iter().any(|(n, lit)| expected(&sequence, *n) != *lit) {
        let unrolled = GROUPS.iter().map(|group| Sequence {
            unrolled: *group,
            last: crate::identify::rule::End::Once,
            ..sequence
        });
        let of_even = expected(&sequence, EVEN);
        let found = unrolled.into_iter().find(|s| {
            let explains = seen.iter().all(|(n, lit)| expected(s, *n) == *lit);
            explains && (!lean || expected(s, EVEN) == of_even)
        });
        let Some(found) = found else {
            let rows = seen.iter().map(|(n, lit)| vec![*n as f64, *lit as f64]);
            return Err(NotIdentified::new(
                "the number of samples taken is no known function of the number of segments",
            )
            .with_rows(&["segments", "samples"], rows.collect()));
        };
        sequence = found;
    }
    let by_weight = rule.stop.is_some_and(|stop| stop.by == StopBy::Weight);
    let is_dear = lean && (session.is_narrow() || session.most_samples < LONG);
    if !is_dear && !by_weight {
        sequence.most = most(session, lone, rule, &sequence)?;
    }
    Ok(sequence)
}

/// An extinction from `tau` on at which a segment is seen at all.
fn visible(lone: &Lone<'_>, tau: f64) -> f64 {
    let mut tau = tau;
    let first = tau;
    while lone.of(tau, 0.25, f64::NAN).0 == 0.0 && tau < 1e6 {
        tau *= 1.5;
    }
    // Not at the very border, where rounding decides.
    if tau > first { 1.2 * tau } else { tau }
}

/// The number of samples beyond which none is taken; `None` where all of a long ray are.
fn most(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    rule: &Rule,
    sequence: &Sequence,
) -> Result<Option<u64>, NotIdentified> {
    let n = LONG.next_multiple_of(session.multiple);
    let ray_length = n as f64 * 0.25;
    let mut tau = lone.reference(0.25) / 64.0;
    if let Some(skip) = rule_skip(lone) {
        tau = tau.max(lone.invert(1.0 - 1.5 * skip, 0.25, ray_length));
    }
    if let Some(stop) = rule.stop.filter(|stop| stop.by == StopBy::Sum) {
        let thin = lone.with_weight(stop.under / (4 * n) as f64, 0.25, ray_length);
        tau = tau.min(thin.unwrap_or(tau));
    }
    let tau = visible(lone, tau);
    let coarse = lone.measurer.answers.is_coarse();
    let size = if coarse {
        1e6_f64.min(lone.measurer.answers.emission_max)
    } else {
        1.0_f64.min(lone.measurer.answers.emission_max)
    };
    let place = lone.measurer.samples.place;
    let taus = vec![tau; n];
    let layers = layers_at(place, 0.25, &taus, &taus);
    let lit = |session: &mut Session<'_>, from: &[usize]| {
        let mut emission = vec![Emission::even(n, 0.0)];
        for &m in from {
            let mut behind = Emission::even(n, 0.0);
            for i in m..n {
                behind.middles[i] = size;
                let edge = if place == Place::Back { i + 1 } else { i };
                behind.edges[edge] = size;
            }
            emission.push(behind);
        }
        let ray = session.ray(&layers, &emission);
        let y = session.ask(&ray)?;
        let answers = lone.measurer.answers;
        let zero = answers.radiance(y[0]);
        let is_lit = |y: &f64| {
            let lit = answers.radiance(*y);
            (lit.value - zero.value).abs() > 3.0 * (lit.error + zero.error)
        };
        Ok::<Vec<bool>, NotIdentified>(y[1..].iter().map(is_lit).collect())
    };
    let (mut low, mut high) = (0, n);
    // The last that is taken at all.
    let taken = sequence.order(n, false, place == Place::Back);
    let last = taken.iter().filter_map(|i| usize::try_from(*i).ok());
    let Some(last) = last.filter(|i| *i < n).max() else {
        return Ok(None);
    };
    let at_once = if session.is_short() {
        // One channel holds no emission, and one the last sample's.
        AT_ONCE_SHORT.min(session.width().saturating_sub(2)).max(2)
    } else {
        AT_ONCE
    };
    // With few rays the first one asks for the border, too: as finely for small counts as for large ones.
    let first = if session.is_short() {
        let ratio = n as f64 / FEWEST as f64;
        let part = |k: usize| FEWEST as f64 * ratio.powf(k as f64 / at_once as f64);
        // No more than n.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let borders = (0..at_once).map(|k| part(k) as usize);
        borders.filter(|m| *m < last).chain([last]).collect()
    } else {
        vec![last]
    };
    let seen = lit(session, &first)?;
    if seen.last() == Some(&true) {
        return Ok(None);
    }
    let narrow = |(low, high): (usize, usize), borders: &[usize], seen: &[bool]| {
        let far = borders.iter().zip(seen).filter(|(_, lit)| **lit);
        let low = far.map(|(m, _)| *m).max().unwrap_or(low);
        let dark = borders.iter().zip(seen);
        let dark = dark.filter(|(m, lit)| !**lit && **m > low);
        (low, dark.map(|(m, _)| *m).min().unwrap_or(high))
    };
    (low, high) = narrow((low, high), &first, &seen);
    while high - low > 1 {
        let parts = (high - low).min(at_once);
        let borders: Vec<usize> = (1..parts).map(|k| low + (high - low) * k / parts).collect();
        if borders.is_empty() {
            break;
        }
        let seen = lit(session, &borders)?;
        (low, high) = narrow((low, high), &borders, &seen);
    }
    // Dark because little is left there anyway.
    let (weight, passes) = lone.of(tau, 0.25, ray_length);
    let at = i32::try_from(low + 2).unwrap_or(i32::MAX);
    let left = passes.powi(at);
    let answers = lone.measurer.answers;
    // Narrow formats end where numbers do, and lose what is small beside what is large.
    let least = if answers.unit > 1e-6 { 1e-3 } else { 1e-10 };
    let shows = weight * left * size > f64::max(least, 8.0 * answers.output.quantum.unwrap_or(0.0));
    let ended = rule.stop.is_some_and(|stop| match stop.by {
        StopBy::Transmittance => left <= 2.0 * stop.under,
        StopBy::Weight => weight * left <= 2.0 * stop.under,
        StopBy::Sum => 2.0 * weight * f64::from(at) >= stop.under,
    });
    if ended || !shows {
        return Ok(None);
    }
    let missing = u64::from(sequence.last == crate::identify::rule::End::Missing);
    Ok(Some(low as u64 + 1 + missing))
}

fn rule_skip(lone: &Lone<'_>) -> Option<f64> {
    lone.law.range.skip
}

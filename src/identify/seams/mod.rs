//! Samples that are left out, or taken twice, between blocks of segments.
//!
//! How often each sample of a ray is taken is counted on rays of many lengths: one length cannot tell blocks of so many
//! segments from parts of the ray. Where several readings are left, a ray is asked on which they differ.

mod candidates;
mod count;

use super::NotIdentified;
use super::places::Even;
use super::pose::Spread;
use super::rule::{Place, Seam};
use super::session::Session;
use super::weights::Answers;
use candidates::{Fit, candidates};
use count::{Counted, Counter};

/// Segments of rays on which seams are looked for: with blocks of a few segments, and of many.
const LOOKED: [usize; 2] = [61, 263];
/// Segments of the rays on which they are counted.
const SHORT: [usize; 21] = [
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 19, 22, 31, 47,
];
/// And where blocks are long.
const LONG: [usize; 7] = [95, 127, 128, 129, 160, 200, 263];
/// The longest.
const LONGEST: usize = 263;
/// Rays that tell readings apart.
const ROUNDS: usize = 16;

/// Where samples are left out or taken twice; `None` where all are taken once, or in another way.
pub(super) fn seams(
    session: &mut Session<'_>,
    answers: &Answers,
    even: &Even,
) -> Result<Option<Spread>, NotIdentified> {
    let Some(mut counter) = Counter::new(even) else {
        return Ok(None);
    };
    let multiple = session.multiple;
    let suits = |n: &usize| n.is_multiple_of(multiple);
    for n in LOOKED {
        let n = n.next_multiple_of(multiple);
        if !counter.look(session, answers, n)? {
            return Ok(None);
        }
        if counter.is_seen(n) {
            break;
        }
    }
    if !counter.has_seams() {
        return Ok(None);
    }
    let mut all = Vec::new();
    for lengths in [&SHORT[..], &LONG] {
        for n in lengths.iter().copied().filter(suits) {
            if !counter.look(session, answers, n)? {
                return Ok(None);
            }
        }
        for place in counter.places() {
            let fitting = candidates(&counter.counted(place));
            all.extend(fitting.into_iter().map(|fit| (place, fit)));
        }
        // Where blocks are long, one seam on a ray does not say how long.
        if !all.is_empty() {
            break;
        }
    }
    told(session, answers, &mut counter, all)
}

/// Asks what tells readings apart until one is left.
fn told(
    session: &mut Session<'_>,
    answers: &Answers,
    counter: &mut Counter,
    mut all: Vec<(Place, Fit)>,
) -> Result<Option<Spread>, NotIdentified> {
    for _ in 0..ROUNDS {
        let Some(n) = telling(&all, session.multiple) else {
            break;
        };
        if !counter.look(session, answers, n)? {
            return Ok(None);
        }
        all.retain_mut(|(place, fit)| {
            let counted: Vec<Counted> = counter.counted(*place);
            match Fit::of(fit.seam, &counted) {
                Some(now) => {
                    *fit = now;
                    true
                }
                None => false,
            }
        });
    }
    if telling(&all, session.multiple).is_some() {
        return Ok(None);
    }
    // The same nodes of other segments, of which the last may be shorter.
    let of = |place: Place| all.iter().find(|(own, _)| *own == place);
    if let (Some((_, front)), Some((_, back))) = (of(Place::Front), of(Place::Back)) {
        let lengths = (LOOKED[0]..LONGEST).filter(|n| n.is_multiple_of(session.multiple));
        let is_taken = |n: &usize| {
            let (last, before) = (front.seam.times(n - 1, *n), back.seam.times(n - 2, *n));
            last == 1 && before == 1
        };
        let Some(n) = lengths
            .into_iter()
            .find(is_taken)
            .filter(|_| !session.divides)
        else {
            return Ok(None);
        };
        let place = if counter.is_short_in_front(session, answers, n)? {
            Place::Front
        } else {
            Place::Back
        };
        all.retain(|(own, _)| *own == place);
    }
    Ok(all.first().map(|(place, fit)| Spread {
        seam: fit.seam,
        place: *place,
        multiple: session.multiple,
    }))
}

/// A ray on which readings differ, or that tells from how many segments on there are seams.
fn telling(all: &[(Place, Fit)], multiple: usize) -> Option<usize> {
    let (place, first) = all.first()?;
    let lengths = (1..=LONGEST).filter(|n| n.is_multiple_of(multiple));
    let open: Vec<usize> = lengths.clone().filter(|n| first.is_open(*n)).collect();
    if !open.is_empty() {
        return open.get(open.len() / 2).copied();
    }
    let differ = |n: &usize| {
        let own = nodes(*place, &first.seam, *n);
        all.iter()
            .any(|(place, fit)| nodes(*place, &fit.seam, *n) != own)
    };
    let mut lengths = lengths;
    lengths.find(differ)
}

/// How often each node is taken.
fn nodes(place: Place, seam: &Seam, n: usize) -> Vec<usize> {
    let mut times: Vec<usize> = (0..n).map(|i| seam.times(i, n)).collect();
    match place {
        Place::Middle => {}
        Place::Front => times.push(0),
        Place::Back => times.insert(0, 0),
    }
    times
}

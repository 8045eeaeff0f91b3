//! Evenly spaced samples by the places that were seen.

use super::Seen;
use crate::identify::least_squares::solve;
use crate::identify::number::simplest;
use crate::identify::rule::{Along, Count, Lattice};

/// Coefficients are known no better than to this part of a segment or a ray.
const NEAREST: f64 = 1e-11;

/// Samples that are evenly spaced, but perhaps the last.
struct Row {
    n: usize,
    step: f64,
    length: f64,
    count: usize,
    first: f64,
    /// From one to the next; `None` of one sample.
    spacing: Option<f64>,
}

/// The lattice that explains all that was seen.
pub(super) fn lattice(all: &[Seen]) -> Option<Lattice> {
    let lit = all.iter().filter(|seen| !seen.samples.is_empty());
    let rows: Option<Vec<Row>> = lit.map(row).collect();
    let rows = rows?;
    let off = all.iter().map(|seen| seen.tolerance / seen.steps.step);
    let near = Near(off.fold(NEAREST, f64::max));
    let mut candidates = steps(&rows, near);
    let counts: Vec<(usize, usize)> = rows.iter().map(|row| (row.n, row.count)).collect();
    if let Some(count) = count(&counts) {
        candidates.extend(even(&rows, count, near));
    }
    candidates
        .into_iter()
        .find(|lattice| all.iter().all(|seen| explains(lattice, seen)))
}

/// How well coefficients are known.
#[derive(Clone, Copy)]
struct Near(f64);

impl Near {
    /// The simplest number that close.
    fn to(self, x: f64) -> f64 {
        simplest(x - self.0, x + self.0)
    }
}

fn row(seen: &Seen) -> Option<Row> {
    let at: Vec<f64> = seen.samples.iter().map(|(at, _)| *at).collect();
    let first = *at.first()?;
    // The last one may have another place.
    let inner = if at.len() > 2 { at.len() - 1 } else { at.len() };
    let spacing = (inner > 1).then(|| (at[inner - 1] - first) / (inner as f64 - 1.0));
    if let Some(h) = spacing {
        let is_even = |(k, at): (usize, &f64)| {
            let want = first + k as f64 * h;
            (at - want).abs() <= 4.0 * seen.tolerance
        };
        if !at[..inner].iter().enumerate().all(is_even) {
            return None;
        }
    }
    Some(Row {
        n: seen.steps.segments,
        step: seen.steps.step,
        length: seen.steps.length,
        count: at.len(),
        first,
        spacing,
    })
}

/// Whether all samples lie where the lattice has some; one without weight is missing, and later stages see which.
fn explains(lattice: &Lattice, seen: &Seen) -> bool {
    let (places, _) = lattice.places(&seen.steps);
    let slack = 4.0 * seen.tolerance + NEAREST * seen.steps.length;
    // Behind the ray the medium is that at its end.
    let seen_from = |place: f64| place.clamp(0.0, seen.steps.length);
    let mut left = places.iter();
    seen.samples
        .iter()
        .all(|(at, _)| left.any(|place| (seen_from(*place) - at).abs() <= slack))
}

/// Steps as they were asked for, and n parts of the ray; where the first sample is missing, the place is that of the
/// second.
fn steps(rows: &[Row], near: Near) -> Vec<Lattice> {
    let Some(first) = rows.iter().find(|r| r.spacing.is_some()) else {
        return Vec::new();
    };
    let place = first.first / first.step;
    let place = near.to(place);
    let places = [
        (place > 1.0 + near.0).then(|| near.to(place - 1.0)),
        Some(place),
    ];
    let of = |place: f64| {
        let whole = |own_last| Lattice::Steps { place, own_last };
        [whole(true), whole(false), Lattice::even(place)]
    };
    places.into_iter().flatten().flat_map(of).collect()
}

/// N = q n + c of (n, N).
pub(in crate::identify) fn count(rows: &[(usize, usize)]) -> Option<Count> {
    let (least, most) = (rows.iter().min()?, rows.iter().max()?);
    let signed = |x: usize| i64::try_from(x).ok();
    let across = signed(most.0)? - signed(least.0)?;
    let rise = signed(most.1)? - signed(least.1)?;
    if across == 0 || rise % across != 0 || rise < 0 {
        return None;
    }
    let each = rise / across;
    let count = Count {
        each: u64::try_from(each).ok()?,
        more: signed(most.1)? - each * signed(most.0)?,
    };
    rows.iter()
        .all(|(n, samples)| count.of(*n) == *samples)
        .then_some(count)
}

/// Even parts between two places, the simplest first.
fn even(rows: &[Row], count: Count, near: Near) -> Vec<Lattice> {
    let spaced: Vec<(&Row, f64)> = rows
        .iter()
        .filter_map(|row| row.spacing.map(|h| (row, h)))
        .collect();
    let of_row = |(row, h): &(&Row, f64)| [*h, row.length, 1.0];
    let mut starts = Vec::new();
    // The first sample at a h + p D + ℓ, with as few of these as it takes.
    for used in [
        [true, false, false],
        [true, true, false],
        [true, false, true],
        [true, true, true],
    ] {
        starts.extend(solve(&spaced, used, &of_row, &|(row, _)| row.first));
    }
    // Where h is a part of D, nothing tells a h from p D: a is then one of these.
    for place in [0.5, 0.0, 1.0] {
        for used in [[false, true, false], [false, true, true]] {
            let found = solve(&spaced, used, &of_row, &|(row, h)| row.first - place * h);
            starts.extend(found.map(|[_, p, l]| [place, p, l]));
        }
    }
    let along = |part: f64, length: f64| Along {
        part: near.to(part),
        length: near.to(length),
    };
    let mut found = Vec::new();
    for [place, p, l] in starts {
        let start = along(p, l);
        // Its end by the spacing: A + N h.
        let end = |(row, h): &(&Row, f64)| start.on(row.length) + row.count as f64 * h;
        for used in [[false, true, false], [false, true, true]] {
            if let Some([_, p, l]) = solve(&spaced, used, &of_row, &end) {
                found.push(Lattice::Even {
                    place: near.to(place),
                    start,
                    end: along(p, l),
                    count,
                });
            }
        }
    }
    found.sort_by_key(faults);
    found
}

/// How much is unusual about it.
fn faults(lattice: &Lattice) -> usize {
    let Lattice::Even {
        place, start, end, ..
    } = lattice
    else {
        return 0;
    };
    let whole = Along {
        part: 1.0,
        length: 0.0,
    };
    [
        *start != Along::default(),
        *end != whole,
        // Twice: it lies in another one's part.
        !(0.0..=1.0).contains(place),
        !(0.0..=1.0).contains(place),
    ]
    .into_iter()
    .filter(|is| *is)
    .count()
}

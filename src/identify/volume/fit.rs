//! Shifts of samples, grid and table by the entries that samples see.

use super::Seen;
use super::optics::{Lookup, Optics};
use crate::identify::least_squares::solve;
use crate::identify::number::simplest;
use crate::identify::rule::Lattice;

/// By how much places among entries are off in the format of the answers, and coefficients.
#[derive(Clone, Copy)]
struct Off {
    places: f64,
    coefficients: f64,
}

/// In units of the format.
const PLACES: f64 = 1e6;
const COEFFICIENTS: f64 = 1e7;

/// What explains all that was seen in answers of that precision.
pub(super) fn optics(all: &[Seen], unit: f64) -> Option<Optics> {
    let off = Off {
        places: PLACES * unit,
        coefficients: COEFFICIENTS * unit,
    };
    let explains = |optics: &Optics| all.iter().all(|seen| explains(optics, seen, off.places));
    let linear = between(all, off.coefficients)
        .into_iter()
        .find(|optics| explains(optics));
    linear.or_else(|| stepped().into_iter().find(|optics| explains(optics)))
}

fn explains(optics: &Optics, seen: &Seen, off: f64) -> bool {
    let mut want = optics.entries(&seen.volume, &seen.steps);
    // Samples at the same place are seen as one.
    want.dedup_by(|u, v| (*u - *v).abs() <= off);
    want.len() == seen.entries.len()
        && want
            .iter()
            .zip(&seen.entries)
            .all(|(want, got)| (want - got).abs() <= off)
}

/// The three ways to treat a last segment that is shorter: they are the same where none is.
fn lattices(place: f64) -> [Lattice; 3] {
    let whole = |own_last| Lattice::Steps { place, own_last };
    [whole(true), whole(false), Lattice::even(place)]
}

/// Lines between grid points and between entries: with x the place of sample k among E entries on m cells and n segments,
/// x = (E − 1 + e) (c/m + (k + a)(1 + g/m)/n) + b.
fn between(all: &[Seen], off: f64) -> Vec<Optics> {
    // (1/m, n, E − 1, first, spacing) by the samples that no end is near.
    let rows: Vec<[f64; 5]> = all.iter().filter_map(inside).collect();
    let Some((first, other)) = rows.first().and_then(|first| {
        let same = |row: &&[f64; 5]| row[2] == first[2] && row[0] != first[0];
        Some((first, rows.iter().find(same)?))
    }) else {
        return Vec::new();
    };
    let scaled = |row: &[f64; 5]| row[4] * row[1];
    let ratio = scaled(first) / scaled(other);
    let longer = (ratio - 1.0) / (first[0] - ratio * other[0]);
    let longer = simplest(longer - off, longer + off);
    let intervals = scaled(first) / (1.0 + longer * first[0]) - first[2];
    let intervals = simplest(intervals - off, intervals + off);
    let columns = |row: &[f64; 5]| {
        let all = row[2] + intervals;
        [all * (1.0 + longer * row[0]) / row[1], all * row[0], 1.0]
    };
    let mut found = Vec::new();
    for used in [
        [true, false, false],
        [true, false, true],
        [true, true, false],
        [true, true, true],
    ] {
        let Some([place, begin, shift]) = solve(&rows, used, &columns, &|row| row[3]) else {
            continue;
        };
        let near = |x: f64| simplest(x - off, x + off);
        let (place, begin, shift) = (near(place), near(begin), near(shift));
        let is_shifted = begin != 0.0 || longer != 0.0;
        for lattice in lattices(place) {
            if is_shifted && matches!(lattice, Lattice::Steps { .. }) {
                continue;
            }
            found.push(Optics {
                lattice,
                cells: [begin, begin + longer],
                field: Lookup::Linear,
                table: Lookup::Linear,
                intervals,
                shift,
            });
        }
    }
    found
}

fn inside(seen: &Seen) -> Option<[f64; 5]> {
    let n = seen.steps.segments;
    let is_whole = (seen.steps.length - n as f64 * seen.steps.step).abs() < 1e-12;
    // Two at each end may be cut off where the grid or the table ends.
    if !is_whole || seen.entries.len() != n || n < 6 {
        return None;
    }
    let (near, far) = (2, n - 3);
    let spacing = (seen.entries[far] - seen.entries[near]) / (far - near) as f64;
    Some([
        1.0 / seen.volume.cells() as f64,
        n as f64,
        seen.volume.table.entries() as f64 - 1.0,
        seen.entries[near] - near as f64 * spacing,
        spacing,
    ])
}

/// Places a segment that are tried where a lookup takes one value.
const PARTS: [f64; 7] = [0.5, 0.0, 1.0, 0.25, 0.75, 1.0 / 3.0, 2.0 / 3.0];

/// One value of the grid or of the table.
fn stepped() -> Vec<Optics> {
    let lookups = [Lookup::Linear, Lookup::Nearest, Lookup::Below];
    // By E − 1 intervals, by texel centres, by E intervals.
    let shifts = [(0.0, 0.0), (1.0, -0.5), (1.0, 0.0), (0.0, 0.5)];
    let mut found = Vec::new();
    for (intervals, shift) in shifts {
        for field in lookups {
            for table in lookups {
                for place in PARTS {
                    found.extend(lattices(place).map(|lattice| Optics {
                        lattice,
                        cells: [0.0; 2],
                        field,
                        table,
                        intervals,
                        shift,
                    }));
                }
            }
        }
    }
    found
}

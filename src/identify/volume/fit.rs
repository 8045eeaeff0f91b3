//! Shifts of samples, grid and table by the entries that samples see.

use super::Seen;
use super::optics::{Lookup, Optics};
use crate::identify::free_places::count;
use crate::identify::least_squares::solve;
use crate::identify::number::simplest;
use crate::identify::rule::{Along, Lattice};

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

/// A ray on which places are seen that no end is near.
struct Row {
    /// 1/m.
    cell: f64,
    /// N.
    samples: f64,
    /// E − 1.
    intervals: f64,
    /// Where the first would lie, by the others.
    first: f64,
    spacing: f64,
}

/// Entries more than E − 1 that a table may be taken to have.
const INTERVALS: [f64; 3] = [0.0, 1.0, -1.0];
/// Which of a, b, c and s are not 0, the fewest first.
const USED: [[bool; 4]; 6] = [
    [true, false, false, false],
    [true, true, false, false],
    [true, false, true, false],
    [true, true, true, false],
    [true, false, false, true],
    [true, true, false, true],
];

/// Lines between grid points and between entries: with x the place of sample k of N among E entries, on m cells,
/// x = (E − 1 + e) (s + c/m + (k + a)(f + g/m)/N) + b, f D long and g cells longer.
fn between(all: &[Seen], off: f64) -> Vec<Optics> {
    let rows: Vec<Row> = all.iter().filter_map(inside).collect();
    let counts = all.iter().map(|s| (s.steps.segments, s.entries.len()));
    let Some(count) = count(&counts.collect::<Vec<_>>()) else {
        return Vec::new();
    };
    let near = |x: f64| simplest(x - off, x + off);
    let mut found = Vec::new();
    for intervals in INTERVALS {
        let wide = |row: &Row| row.intervals + intervals;
        let span = solve(&rows, [true, true], &|row| [1.0, row.cell], &|row: &Row| {
            row.spacing * row.samples / wide(row)
        });
        let Some([long, longer]) = span.map(|of| of.map(near)) else {
            continue;
        };
        let columns = |row: &Row| {
            let spacing = (long + longer * row.cell) / row.samples;
            [spacing, 1.0 / wide(row), row.cell, 1.0]
        };
        for used in USED {
            let places = solve(&rows, used, &columns, &|row| row.first / wide(row));
            let Some([place, shift, begin, start]) = places.map(|of| of.map(near)) else {
                continue;
            };
            let optics = |lattice| Optics {
                lattice,
                cells: [begin, near(begin + longer)],
                field: Lookup::Linear,
                table: Lookup::Linear,
                intervals,
                shift,
            };
            let plain = Lattice::Even {
                place,
                start: Along {
                    part: start,
                    length: 0.0,
                },
                end: Along {
                    part: near(start + long),
                    length: 0.0,
                },
                count,
            };
            if plain == Lattice::even(place) && begin.abs() + longer.abs() <= 0.0 {
                found.extend(lattices(place).map(optics));
            } else {
                found.push(optics(plain));
            }
        }
    }
    found
}

fn inside(seen: &Seen) -> Option<Row> {
    let samples = seen.entries.len();
    let is_whole = (seen.steps.length - seen.steps.segments as f64 * seen.steps.step).abs() < 1e-12;
    // Two at each end may be cut off where the grid or the table ends.
    if !is_whole || samples < 6 {
        return None;
    }
    let (near, far) = (2, samples - 3);
    let spacing = (seen.entries[far] - seen.entries[near]) / (far - near) as f64;
    Some(Row {
        cell: 1.0 / seen.volume.cells() as f64,
        samples: samples as f64,
        intervals: seen.volume.table.entries() as f64 - 1.0,
        first: seen.entries[near] - near as f64 * spacing,
        spacing,
    })
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

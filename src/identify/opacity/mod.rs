//! The law of one segment: measured, fitted, and where it ends.

pub(super) mod fit;
pub(super) mod measure;
mod range;
mod table;

use super::NotIdentified;
use super::rule::Law;
use super::session::Session;
use super::weights::{Answers, Measured};
use fit::{Fitted, laws};
use measure::{Measurer, Point, Reference};

/// What segments do, at all the extinctions and lengths that were asked.
#[derive(Clone, Debug)]
pub(super) struct Measurements {
    pub(super) points: Vec<Point>,
    pub(super) references: Vec<Reference>,
    /// As [`Measurer::subtracts`].
    pub(super) subtracts: bool,
}

impl Measurements {
    /// The reference of that length.
    pub(super) fn reference(&self, length: f64) -> Option<&Reference> {
        let mut all = self.references.iter();
        all.find(|r| (r.length - length).abs() < 1e-12)
    }

    /// A table of some of them.
    pub(super) fn rows(&self, every: usize) -> Vec<Vec<f64>> {
        let mut points: Vec<&Point> = self.points.iter().collect();
        points.sort_by(|u, v| {
            let depth = |p: &Point| p.extinction * p.length;
            depth(u).total_cmp(&depth(v))
        });
        let row = |p: &&Point| {
            vec![
                p.extinction,
                p.length,
                p.ray,
                p.weight.value,
                p.passes.value,
            ]
        };
        points.iter().step_by(every).map(row).collect()
    }

    pub(super) fn none(&self, reason: &str) -> NotIdentified {
        NotIdentified::new(reason).with_rows(
            &["extinction", "length", "ray", "weight", "let through"],
            self.rows(8),
        )
    }
}

/// Lengths of segments: 0.7 is no multiple of a power of two, and its rays have another number of segments.
const LENGTHS: [f64; 4] = [0.25, 1.0, 0.0625, 0.7];
/// Extinctions of one ray, from this to that part of what has depth 1.
const REACH: [f64; 2] = [1e-6, 0.3];
/// Extinctions of the longest rays.
const MANY: usize = 18;
/// The parts of it that are asked where answers are coarse and every channel costs: mostly such as absorb enough to be told
/// from nothing; and the same at every other length.
const COARSE: [&[f64]; 2] = [&[1e-5, 1e-3, 0.2, 0.3, 0.4, 0.6], &[1e-3, 0.3, 0.7]];
/// Depths of thick segments, by length: those that share a ray let enough through together. The thickest one comes first: it
/// shows most of how transmittances are rounded.
const THICK: [(f64, &[&[f64]]); 2] = [
    (
        1.0,
        &[
            &[20.0],
            &[12.0],
            &[8.0],
            &[4.0],
            &[2.3],
            &[0.8, 1.7],
            &[0.5, 1.2],
        ],
    ),
    (0.25, &[&[0.6, 1.5], &[1.0, 2.5], &[4.7], &[9.0]]),
];

/// Significant bits of lengths: all, or those of a narrow format.
const NARROW: [Option<u32>; 4] = [None, Some(24), Some(11), Some(8)];

/// A point with its length rounded.
fn with_bits(point: &Point, bits: Option<u32>) -> Point {
    let rounded = |bits: u32| rug::Float::with_val(bits, point.length).to_f64();
    Point {
        length: bits.map_or(point.length, rounded),
        ..*point
    }
}

/// Roundings of which what a segment does is off, where it is computed in a narrow format.
pub(super) const ROUNDINGS: f64 = 4.0;
/// Units of formats that opacities may be computed in though answers have more digits.
const UNITS: [f64; 2] = [1.0 / 16_777_216.0, 1.0 / 2048.0];

/// A law that all points have but for rounding in a narrower format.
fn rounded(measurer: &Measurer<'_>, measured: &Measurements, eps: f64) -> Option<Fitted> {
    for unit in UNITS {
        if unit < 8.0 * measurer.answers.unit {
            continue;
        }
        // An opacity by subtraction is off by a unit of 1, and one by a product by a unit of itself.
        let loose = |m: Measured| Measured {
            error: m.error + 2.0 * unit,
            ..m
        };
        let points: Vec<Point> = measured
            .points
            .iter()
            .map(|p| Point {
                weight: loose(p.weight),
                passes: loose(p.passes),
                ..*p
            })
            .collect();
        let answers = Answers {
            grain: ROUNDINGS * unit,
            ..measurer.answers.clone()
        };
        let whole = laws(&points, eps, &answers)
            .into_iter()
            .find(|f| f.share > 0.999 && is_rounding(&f.law, measured, unit));
        if let Some(fitted) = whole {
            return Some(Fitted {
                grain: ROUNDINGS * unit,
                ..fitted
            });
        }
    }
    None
}

/// Whether measured weights lie about a law as rounding leaves them: off by parts of a unit, on either side by turns.
fn is_rounding(law: &Law, measured: &Measurements, unit: f64) -> bool {
    let mut off: Vec<(f64, f64)> = measured
        .points
        .iter()
        .filter(|p| p.weight.error < unit / 8.0 && p.weight.value.is_finite())
        .map(|p| {
            let (weight, _) = law.of(&p.extinction, &p.length, &p.ray);
            (p.extinction * p.length, p.weight.value - weight)
        })
        .collect();
    off.sort_by(|u, v| u.0.total_cmp(&v.0));
    let seen = off
        .iter()
        .filter(|(_, off)| off.abs() > unit / 16.0)
        .count();
    let turns = off.windows(2).filter(|w| w[0].1 * w[1].1 < 0.0).count();
    3 * seen > off.len() && 4 * turns > off.len()
}

/// Laws whose range is looked for.
const TRIED: usize = 8;

/// Measures some 100 points.
pub(super) fn measure(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    lean: bool,
) -> Result<Measurements, NotIdentified> {
    let mut measurer = measurer.clone();
    let mut points = Vec::new();
    let mut references = Vec::new();
    let lengths = if lean { &LENGTHS[..2] } else { &LENGTHS };
    let is_dear = session.is_narrow() && measurer.answers.is_coarse();
    for (k, &length) in lengths.iter().enumerate() {
        let reference = measurer.reference(session, length)?;
        // Rays of other numbers of segments tell what depends on the ray's length.
        let typical = reference.extinction * 32.0;
        let taus: Vec<f64> = if is_dear {
            COARSE[k % 2].iter().map(|part| part * typical).collect()
        } else {
            let count = if k % 2 == 0 { MANY } else { MANY - 7 };
            let [low, high] = REACH.map(|part| part * typical);
            let tau = |k: usize| low * (high / low).powf(k as f64 / (count - 1) as f64);
            (0..count).map(tau).collect()
        };
        points.extend(measurer.points(session, &reference, &taus)?);
        references.push(reference);
    }
    for (length, depths) in THICK {
        let Some(reference) = references
            .iter()
            .find(|r| (r.length - length).abs() < 1e-12)
            .copied()
        else {
            continue;
        };
        let every = if lean { 3 } else { 1 };
        for depths in depths.iter().step_by(every) {
            let typical = reference.extinction * 32.0;
            // References of kernels with another unit of length are far from depth 1/32.
            let tau = |depth: &f64| {
                if typical * length < 8.0 {
                    depth * typical
                } else {
                    depth / length
                }
            };
            // The thinner one stands in front of the thicker one.
            let taus: Vec<f64> = depths.iter().rev().map(tau).collect();
            let found = if let [tau] = taus[..] {
                let asked = measurer.asked(session, &reference, &[tau])?;
                measurer.subtracts |= measurer.shows_subtraction(&asked);
                measurer.read(&asked, &reference, &[tau])
            } else {
                measurer.points(session, &reference, &taus)?
            };
            points.extend(found.into_iter().take(taus.len()));
        }
    }
    Ok(Measurements {
        points,
        references,
        subtracts: measurer.subtracts,
    })
}

/// The law with its range, or the table that was measured.
pub(super) fn law(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    measured: &Measurements,
    eps: f64,
) -> Result<Fitted, NotIdentified> {
    let mut reasons = Vec::new();
    let is_fine = measurer.answers.unit < 1e-9 && measurer.answers.noise < 1e-9;
    for bits in NARROW {
        if bits.is_some() && !is_fine {
            break;
        }
        let points: Vec<Point> = measured.points.iter().map(|p| with_bits(p, bits)).collect();
        for mut fitted in laws(&points, eps, measurer.answers).into_iter().take(TRIED) {
            if bits.is_some() && fitted.share < 0.99 {
                // The narrow step has to explain nearly all.
                continue;
            }
            fitted.law.length_bits = bits;
            match range::with_range(session, measurer, measured, fitted) {
                Ok(whole) => return Ok(whole),
                Err(reason) => reasons.push(reason),
            }
        }
    }
    // In narrow formats everything looks looked up.
    let is_wide = measurer.answers.unit < 1e-6 && measurer.answers.noise < 1e-6;
    // Where answers are coarse and every channel costs, hundreds of rays would tell little of a table.
    let is_dear = session.is_narrow() && measurer.answers.is_coarse();
    if is_wide
        && !is_dear
        && let Some(looked_up) = table::table(session, measurer, measured)?
    {
        return Ok(looked_up);
    }
    if let Some(rounded) = rounded(measurer, measured, eps) {
        return Ok(rounded);
    }
    Err(reasons
        .into_iter()
        .next()
        .unwrap_or_else(|| measured.none("no law known for what a segment adds and lets through")))
}

//! The law of one segment: measured, fitted, and where it ends.

pub(super) mod fit;
pub(super) mod measure;
mod range;
mod table;

use super::NotIdentified;
use super::session::Session;
use fit::{Fitted, laws};
use measure::{Measurer, Point, Reference};

/// What segments do, at all the extinctions and lengths that were asked.
#[derive(Clone, Debug)]
pub(super) struct Measurements {
    pub(super) points: Vec<Point>,
    pub(super) references: Vec<Reference>,
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
/// Depths of single thick segments, by length.
const THICK: [(f64, &[f64]); 2] = [
    (
        1.0,
        &[0.5, 0.8, 1.2, 1.7, 2.3, 3.0, 4.0, 5.5, 8.0, 12.0, 20.0],
    ),
    (0.25, &[0.6, 1.0, 1.5, 2.5, 4.7, 9.0]),
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

/// Laws whose range is looked for.
const TRIED: usize = 8;

/// Measures some 100 points.
pub(super) fn measure(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    lean: bool,
) -> Result<Measurements, NotIdentified> {
    let mut points = Vec::new();
    let mut references = Vec::new();
    let lengths = if lean { &LENGTHS[..2] } else { &LENGTHS };
    for (k, &length) in lengths.iter().enumerate() {
        let reference = measurer.reference(session, length)?;
        // Rays of other numbers of segments tell what depends on the ray's length.
        let count = if k % 2 == 0 { MANY } else { MANY - 7 };
        let [low, high] = REACH.map(|part| part * reference.extinction * 32.0);
        let taus = (0..count).map(|k| low * (high / low).powf(k as f64 / (count - 1) as f64));
        let taus: Vec<f64> = taus.collect();
        points.extend(measurer.points(session, &reference, &taus)?);
        references.push(reference);
    }
    for (length, depths) in THICK {
        let Some(reference) = references.iter().find(|r| r.length == length).copied() else {
            continue;
        };
        let every = if lean { 3 } else { 1 };
        for depth in depths.iter().step_by(every) {
            let typical = reference.extinction * 32.0;
            // References of kernels with another unit of length are far from depth 1/32.
            let tau = if typical * length < 8.0 {
                depth * typical
            } else {
                depth / length
            };
            let found = measurer.points(session, &reference, &[tau])?;
            points.extend(found.into_iter().take(1));
        }
    }
    Ok(Measurements { points, references })
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
    if is_wide && let Some(looked_up) = table::table(session, measurer, measured)? {
        return Ok(looked_up);
    }
    Err(reasons
        .into_iter()
        .next()
        .unwrap_or_else(|| measured.none("no law known for what a segment adds and lets through")))
}

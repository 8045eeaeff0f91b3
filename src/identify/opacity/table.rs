//! Opacities that are looked up, or rounded: few values, or lines between entries, over a dense range of depths.

use super::Measurements;
use super::fit::{Fitted, has};
use super::measure::{Measurer, Point};
use crate::identify::number::simplest;
use crate::identify::random::Random;
use crate::identify::rule::{Law, Quantised, Range, Step, Table};
use crate::identify::session::Session;
use crate::identify::weights::Answers;
use crate::identify::{Bracket, NotIdentified, Parameter};

/// Ranges of depths that are looked at closely, and by how many rays.
const SCANS: [(f64, f64, usize); 3] = [(0.0, 2.6, 6), (0.2, 0.5, 3), (0.2, 0.23, 3)];
/// A multiple says something where it is known to so much of a step.
const DISTINCT: f64 = 0.05;
/// Depths of one ray.
const AT_ONCE: usize = 18;
/// Levels of opacities of few bits.
const LEVELS: [f64; 8] = [15.0, 31.0, 63.0, 255.0, 256.0, 1023.0, 4095.0, 65_535.0];

/// A law by table, where one explains all that was measured.
pub(super) fn table(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    measured: &Measurements,
) -> Result<Option<Fitted>, NotIdentified> {
    let Some(reference) = measured.reference(1.0).copied() else {
        return Ok(None);
    };
    let mut random = Random::new(41);
    for (low, high, rays) in SCANS {
        let mut scan = Vec::new();
        for _ in 0..rays {
            let mut depths = random.many(AT_ONCE, low, high);
            depths.sort_by(f64::total_cmp);
            let points = measurer.points(session, &reference, &depths)?;
            scan.extend(points.into_iter().take(AT_ONCE));
        }
        scan.retain(|p| p.weight.value.is_finite() && p.passes.value.is_finite());
        scan.sort_by(|u, v| u.extinction.total_cmp(&v.extinction));
        if scan.len() < AT_ONCE {
            continue;
        }
        if let Some(found) = by_bits(&scan, measured, measurer.answers) {
            return Ok(Some(found));
        }
        for law in laws(&scan, measured) {
            let explains = |p: &&Point| has(&law, p, measurer.answers);
            let all = || scan.iter().chain(&measured.points);
            let with = all().filter(explains).count();
            if with == all().count() {
                let one = (1.0, 1.0);
                let brackets = step_of(&law, &scan);
                return Ok(Some(Fitted {
                    law,
                    factor: one,
                    scale: one,
                    brackets,
                    share: 1.0,
                    grain: 0.0,
                }));
            }
        }
    }
    Ok(None)
}

/// Laws that a scan suggests.
fn laws(scan: &[Point], measured: &Measurements) -> Vec<Law> {
    let mut laws = Vec::new();
    let with = |range: Range| Law {
        range,
        ..Law::default()
    };
    for levels in LEVELS {
        let is_multiple = |p: &Point| {
            let count = p.weight.value * levels;
            let within = levels * 4.0 * p.weight.error + 1e-7;
            // Near everything else there is a multiple, too.
            within < DISTINCT && (count - count.round()).abs() <= within
        };
        if scan.iter().all(is_multiple) {
            // In segments of a unit of length both opacities are the same; others tell.
            laws.extend(Quantised::ALL.map(|quantised| {
                with(Range {
                    quantum: Some(1.0 / levels),
                    quantised,
                    ..Range::default()
                })
            }));
        }
    }
    let entries = entries(scan);
    if let Some((low, high)) = lattice(&entries) {
        let step = simplest(low, high);
        for between in [Step::Nearest, Step::Below, Step::NearestExtinction] {
            for (step, top) in sized(measured, step) {
                laws.push(with(Range {
                    table: Some(Table { step, top, between }),
                    ..Range::default()
                }));
            }
        }
    }
    for step in breaks(scan) {
        for (step, top) in sized(measured, step) {
            laws.push(with(Range {
                table: Some(Table {
                    step,
                    top,
                    between: Step::Linear,
                }),
                ..Range::default()
            }));
        }
    }
    laws
}

/// Between what a table's step lies, where the depths that occur tell.
fn step_of(law: &Law, scan: &[Point]) -> Vec<Bracket> {
    let step = law.range.table.map(|table| table.step);
    let both = step.zip(lattice(&entries(scan)));
    let both = both.filter(|(step, (low, high))| (low..=high).contains(&step));
    let bracket = both.map(|(_, bracket)| Bracket::of(Parameter::TableStep, bracket));
    bracket.into_iter().collect()
}

/// Tables of that step: with a last entry, and without.
fn sized(measured: &Measurements, step: f64) -> Vec<(f64, Option<f64>)> {
    let with_top = top(measured, step).map(|(top, step)| (step, Some(top)));
    with_top.into_iter().chain([(step, None)]).collect()
}

/// The depths whose opacities are those that occur.
fn entries(scan: &[Point]) -> Vec<f64> {
    let mut entries: Vec<f64> = Vec::new();
    for p in scan {
        let depth = -(-p.weight.value).ln_1p();
        let tolerance = 8.0 * p.weight.error + 1e-12;
        if entries
            .last()
            .is_none_or(|last| (depth - last).abs() > tolerance)
        {
            entries.push(depth);
        }
    }
    entries
}

/// Between what the step lies that all entries are multiples of.
fn lattice(entries: &[f64]) -> Option<(f64, f64)> {
    let mut sorted = entries.to_vec();
    sorted.sort_by(f64::total_cmp);
    let gaps = sorted.windows(2).map(|w| w[1] - w[0]);
    let least = gaps.filter(|gap| *gap > 1e-9).fold(f64::INFINITY, f64::min);
    if sorted.len() < 4 || !least.is_finite() {
        return None;
    }
    let mut step = least;
    for _ in 0..3 {
        let (mut up, mut down) = (0.0, 0.0);
        for entry in &sorted {
            let index = (entry / step).round();
            up += entry * index;
            down += index * index;
        }
        step = up / down;
    }
    let far = sorted.iter().map(|e| (e - (e / step).round() * step).abs());
    let far = far.fold(0.0, f64::max);
    let is_lattice = far <= 1e-6_f64.min(0.02 * step);
    let most = sorted.last().copied().unwrap_or(step) / step;
    let within = (far / most / step).max(1e-14);
    is_lattice.then_some((step * (1.0 - within), step * (1.0 + within)))
}

/// The depth of a last entry, the largest depth whose opacity occurs, and the step that divides it.
fn top(measured: &Measurements, step: f64) -> Option<(f64, f64)> {
    let deep = measured
        .points
        .iter()
        .filter(|p| p.extinction * p.length > 5.0);
    let tops = deep
        .map(|p| -(-p.weight.value).ln_1p())
        .filter(|x| x.is_finite());
    let top = tops.fold(0.0, f64::max);
    let index = (top / step).round();
    ((top / step - index).abs() < 1e-3 && index > 0.0).then(|| {
        let exact = index * step;
        let top = simplest(exact * (1.0 - 1e-7), exact * (1.0 + 1e-7));
        (top, top / index)
    })
}

/// Widths of cells between which what is let through is a line.
fn breaks(scan: &[Point]) -> Vec<f64> {
    // Lines through runs of three or more points; they cross where cells meet.
    let x = |k: usize| scan[k].extinction * scan[k].length;
    let p = |k: usize| scan[k].passes.value;
    let slope = |k: usize| (p(k + 1) - p(k)) / (x(k + 1) - x(k));
    let sure = |k: usize| (scan[k].passes.error + scan[k + 1].passes.error) / (x(k + 1) - x(k));
    let mut runs: Vec<(usize, usize)> = Vec::new();
    let mut start = 0;
    for k in 0..scan.len().saturating_sub(2) {
        let is_line = (slope(k) - slope(k + 1)).abs()
            <= 4.0 * (sure(k) + sure(k + 1)) + 1e-6 * slope(k).abs();
        if !is_line {
            if k + 1 > start + 1 {
                runs.push((start, k + 1));
            }
            start = k + 1;
        }
    }
    if scan.len() > start + 2 {
        runs.push((start, scan.len() - 1));
    }
    let line = |(i, j): (usize, usize)| {
        let slope = (p(j) - p(i)) / (x(j) - x(i));
        (slope, p(i) - slope * x(i))
    };
    let mut crossings = Vec::new();
    for pair in runs.windows(2) {
        let (near, far) = (line(pair[0]), line(pair[1]));
        let at = (far.1 - near.1) / (near.0 - far.0);
        if at > x(pair[0].1) - 1e-9 && at < x(pair[1].0) + 1e-9 {
            crossings.push(at);
        }
    }
    lattice_from(&crossings).into_iter().collect()
}

/// Precision of an exponential by the bits of a float: its mantissa has 20 bits or 23.
const BITS_GRAIN: f64 = 4e-6;

/// Lines between powers of two: the bits of a float taken for its logarithm.
fn by_bits(scan: &[Point], measured: &Measurements, answers: &Answers) -> Option<Fitted> {
    let ln_2 = std::f64::consts::LN_2;
    let loose = Answers {
        grain: BITS_GRAIN,
        ..answers.clone()
    };
    // p = (1 + z + 1)/2 for −1 ≤ z < 0 and (1 + z) for 0 ≤ z < 1, z = (step − x)/ln 2: from the first point.
    let first = scan.first()?;
    let (x, p) = (first.extinction * first.length, first.passes.value);
    let z = if p < 1.0 { 2.0 * p - 2.0 } else { p - 1.0 };
    let step = x + z * ln_2;
    let law = Law {
        range: Range {
            table: Some(Table {
                step,
                top: None,
                between: Step::PowersOfTwo,
            }),
            ..Range::default()
        },
        ..Law::default()
    };
    let all = || scan.iter().chain(&measured.points);
    // Deep ones may be clamped: they are held out later.
    let shallow = |p: &&Point| p.extinction * p.length < 15.0;
    let explains = |p: &Point| has(&law, p, &loose);
    all().filter(shallow).all(explains).then_some(Fitted {
        law,
        factor: (1.0, 1.0),
        scale: (1.0, 1.0),
        brackets: Vec::new(),
        share: 1.0,
        grain: BITS_GRAIN,
    })
}

/// The step that crossings are multiples of.
fn lattice_from(crossings: &[f64]) -> Option<f64> {
    if crossings.len() < 3 {
        return None;
    }
    let mut gaps: Vec<f64> = crossings.windows(2).map(|w| w[1] - w[0]).collect();
    gaps.sort_by(f64::total_cmp);
    let mut step = gaps[gaps.len() / 2];
    let mut kept = 0;
    for _ in 0..4 {
        // Lines of cells that are no neighbours cross elsewhere.
        let near = |at: &&f64| (*at / step - (*at / step).round()).abs() < 0.02;
        let (mut up, mut down) = (0.0, 0.0);
        kept = 0;
        for at in crossings.iter().filter(near) {
            let index = (at / step).round();
            up += at * index;
            down += index * index;
            kept += 1;
        }
        step = up / down;
    }
    let is_lattice = step.is_finite() && 2 * kept > crossings.len();
    is_lattice.then(|| simplest(step * (1.0 - 1e-9), step * (1.0 + 1e-9)))
}

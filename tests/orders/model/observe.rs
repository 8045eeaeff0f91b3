//! What really comes out, over blocks of neighbouring n: a single n is luck.

use rug::Rational;
use std::collections::VecDeque;
use volver::case::{Case, Fresh, SymbolicCase};
use volver::method::Method;
use volver::real::{Format, Mpfr, Native, Real};

/// Neighbours in a block [c/√2, c√2].
const NEIGHBOURS: u64 = 24;
/// Numbers of segments that are looked at.
const RANGE: std::ops::Range<f64> = 5.0..1.0e6;

pub(crate) struct Observed {
    /// The least root mean square of the total error.
    pub(crate) best: f64,
    /// Where the root mean square of roundoff overtakes that of discretization, if in reach.
    pub(crate) crossing: Option<f64>,
}

/// Root mean squares over a block.
struct Block {
    center: f64,
    total: f64,
    discretization: f64,
    rounding: f64,
}

/// Blocks around the prediction, an octave apart, and on to either side until the least error and the crossing
/// lie inside.
pub(crate) fn observe<F: Format>(
    case: &SymbolicCase,
    method: &Method,
    format: F,
    log2_best: f64,
) -> Option<Observed> {
    let at = |k: i32| {
        let center = (log2_best + f64::from(k)).exp2();
        RANGE
            .contains(&center)
            .then(|| block(case, method, format, center))
            .flatten()
    };
    let (mut from, mut to) = (-1, 1);
    let mut blocks: VecDeque<Block> = (from..=to).filter_map(at).collect();
    let (mut ends_below, mut ends_above) = (false, false);
    while !(ends_below && ends_above) {
        let best =
            (0..blocks.len()).min_by(|&a, &b| blocks[a].total.total_cmp(&blocks[b].total))?;
        let leads = |block: Option<&Block>| block.is_some_and(|b| b.discretization > b.rounding);
        if !ends_below && (best == 0 || !leads(blocks.front())) {
            from -= 1;
            match at(from) {
                Some(block) => blocks.push_front(block),
                None => ends_below = true,
            }
        } else if !ends_above && (best + 1 == blocks.len() || leads(blocks.back())) {
            to += 1;
            match at(to) {
                Some(block) => blocks.push_back(block),
                None => ends_above = true,
            }
        } else {
            break;
        }
    }
    let blocks = Vec::from(blocks);
    let best = blocks.iter().map(|b| b.total).fold(f64::INFINITY, f64::min);
    // The last block where discretization leads, and the next: a straight line between their logarithms.
    let last = blocks.iter().rposition(|b| b.discretization > b.rounding);
    let crossing = last.and_then(|i| {
        let (a, b) = (&blocks[i], blocks.get(i + 1)?);
        let gap = |block: &Block| (block.discretization / block.rounding).log2();
        let share = gap(a) / (gap(a) - gap(b));
        Some((a.center.log2() + share * (b.center / a.center).log2()).exp2())
    });
    Some(Observed { best, crossing })
}

/// Whether every half of a segment begins on the same side of every jump in both formats.
fn same_sides<F: Format>(case: &SymbolicCase, format: F, n: u64) -> bool {
    let wide = Mpfr { bits: 200 };
    (0..=2 * n).all(|i| {
        let lambda = Rational::from((i, 2 * n)) * case.length();
        case.branches(&format.ratio(&lambda)) == case.branches(&wide.ratio(&lambda))
    })
}

/// The block of neighbours around c that suit the method; `None` where there are none.
fn block<F: Format>(case: &SymbolicCase, method: &Method, format: F, center: f64) -> Option<Block> {
    let (low, high) = (center / 2_f64.sqrt(), center * 2_f64.sqrt());
    let multiple = (1..=4).find(|m| method.check_segments(*m).is_ok())?;
    let mut numbers: Vec<u64> = (0..NEIGHBOURS)
        .map(|k| low + (high - low) * k as f64 / (NEIGHBOURS - 1) as f64)
        .map(|n| ((n / multiple as f64).round() as u64).max(1) * multiple)
        .collect();
    numbers.dedup();
    let wide = Mpfr { bits: 200 };
    let radiance = case.radiance(&wide.ratio(&case.length()))?.to_float();
    let mut squares = [0.0; 3];
    let mut count = 0.0;
    let has_jumps = case.structure().breaks.iter().any(|b| {
        let jumps = |power: &Option<Rational>| power.as_ref().is_some_and(|power| *power == 0);
        jumps(&b.extinction) || jumps(&b.source)
    });
    for n in numbers {
        // What stands on another side of a jump solves another problem, and is not split either.
        if has_jumps && !same_sides(case, format, n) {
            continue;
        }
        let here = method
            .radiance(&Fresh::new(case, format), n)
            .ok()?
            .to_float();
        // Of so many more bits that its own roundoff is none.
        let limit = if format.bits() <= 24 {
            method
                .radiance(&Fresh::new(case, Native::<f64>::new()), n)
                .ok()?
                .to_float()
        } else {
            method
                .radiance(&Fresh::new(case, Mpfr { bits: 100 }), n)
                .ok()?
                .to_float()
        };
        let parts = [
            rug::Float::with_val(200, &here - &radiance),
            rug::Float::with_val(200, &limit - &radiance),
            rug::Float::with_val(200, &here - &limit),
        ];
        for (square, part) in squares.iter_mut().zip(parts) {
            *square += part.to_f64().powi(2);
        }
        count += 1.0;
    }
    let [total, discretization, rounding] = squares.map(|square: f64| (square / count).sqrt());
    total.is_finite().then_some(Block {
        center,
        total,
        discretization,
        rounding,
    })
}

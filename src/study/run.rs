//! Radiances of many methods over a ladder, and their errors.

use crate::case::{AnyNodes, Case, Shared};
use crate::convergence::Sample;
use crate::method::{Integration, Level, Method, MethodError};
use crate::parallel;
use crate::real::{Format, Real};
use crate::reference::{self, ReferenceError};
use rug::{Float, Rational};

/// Hears of work done, from any thread.
pub trait Progress: Sync {
    /// `units` more are done; a unit is about one evaluation of the medium in MPFR.
    fn advance(&self, units: u64);
}

/// Hears nothing.
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _: u64) {}
}

/// The radiances of some methods on the levels of a ladder, in one format.
#[derive(Clone, Debug)]
pub struct Run {
    /// Significant bits of the format.
    pub bits: u32,
    /// The levels.
    pub ladder: Vec<u64>,
    /// Exact values of the radiances computed, by method and level; NaN where not finite.
    pub radiances: Vec<Vec<Float>>,
    /// How often the medium was evaluated.
    pub evaluations: u64,
}

impl Run {
    /// Runs all methods on all levels; every node is evaluated once.
    ///
    /// # Errors
    /// [`MethodError`] where a level does not suit a method, or the case lacks what it needs.
    pub fn new<C: Case, F: Format>(
        case: &C,
        format: F,
        methods: &[Method],
        ladder: &[u64],
        progress: &dyn Progress,
    ) -> Result<Run, MethodError> {
        let nodes = Shared::new(case, format);
        let any = AnyNodes::new(&nodes);
        let at = |n| at_level(any, n, methods, progress);
        Ok(Run {
            bits: format.bits(),
            ladder: ladder.to_vec(),
            radiances: on_all_levels(ladder, methods.len(), &at)?,
            evaluations: nodes.evaluations(),
        })
    }
}

/// The radiances by method and level, of `at`, which gives those of a level by method.
fn on_all_levels(
    ladder: &[u64],
    methods: usize,
    at: &(dyn Fn(u64) -> Result<Vec<Float>, MethodError> + Sync),
) -> Result<Vec<Vec<Float>>, MethodError> {
    // Finest levels first: the largest piece of work is not left for last.
    let finest_first: Vec<u64> = ladder.iter().rev().copied().collect();
    let mut levels = parallel::try_map(&finest_first, |&n| at(n))?;
    levels.reverse();
    Ok((0..methods)
        .map(|m| levels.iter().map(|level| level[m].clone()).collect())
        .collect())
}

fn at_level<F: Format>(
    nodes: AnyNodes<'_, F>,
    n: u64,
    methods: &[Method],
    progress: &dyn Progress,
) -> Result<Vec<Float>, MethodError> {
    let mut level = Level::of_any(nodes, n);
    methods
        .iter()
        .map(|method| {
            let radiance = exact(&level.radiance(method)?);
            progress.advance(n * units_a_segment(method));
            Ok(radiance)
        })
        .collect()
}

/// Evaluations a segment, roughly.
pub(super) fn units_a_segment(method: &Method) -> u64 {
    match method {
        Method::Preintegrated(p) => match p.color.integration {
            Integration::SubIntervals { count, .. } => u64::from(count),
            Integration::Closed => 1,
        },
        Method::Nested(_) | Method::Composited(_) | Method::Layered(_) => 1,
    }
}

/// The very value of a number, NaN where it is not finite.
pub fn exact<R: Real>(x: &R) -> Float {
    exactly(x.to_rational(), x.format().bits())
}

fn exactly(x: Option<Rational>, bits: u32) -> Float {
    match x {
        Some(value) => {
            // A fixed-point number above 1 has more significant bits than its format has after the point.
            let numerator = value.numer();
            let zeros = numerator.find_one(0).unwrap_or(0);
            let own = numerator.significant_bits() - zeros;
            Float::with_val(bits.max(own), value)
        }
        None => Float::with_val(bits, rug::float::Special::Nan),
    }
}

/// The exact radiance of a case, held with [`reference::GUARD_BITS`] more than `bits`.
///
/// # Errors
/// [`ReferenceError`] where it is not to be had.
pub fn exact_radiance<C: Case>(case: &C, bits: u32) -> Result<Float, ReferenceError> {
    Ok(reference::radiance(case, bits.max(f64::MANTISSA_DIGITS))?.value)
}

/// Errors of one method, with the floor at every level: the most that its radiances differ from
/// `oracle`'s, the same method at more bits, and never less than u·|I|.
///
/// For an MPFR run without an oracle the floor is the a-priori bound 16·n·u·|I|: each of n terms and
/// factors is rounded a few times, with relative error u each.
///
/// # Errors
/// [`ReferenceError`] where the exact radiance is not to be had.
pub fn samples<C: Case>(
    case: &C,
    run: &Run,
    method: usize,
    oracle: Option<&Run>,
) -> Result<Vec<Sample>, ReferenceError> {
    let radiance = exact_radiance(case, run.bits)?;
    Ok(errors(&radiance, &case.length(), run, method, oracle))
}

fn errors(
    radiance: &Float,
    length: &Rational,
    run: &Run,
    method: usize,
    oracle: Option<&Run>,
) -> Vec<Sample> {
    let unit = Float::with_val(64, radiance.abs_ref()) >> run.bits;
    let Some(radiances) = run.radiances.get(method) else {
        return Vec::new();
    };
    let levels = run.ladder.iter().zip(radiances);
    let samples = levels.map(|(&n, value)| {
        let error = Float::with_val(radiance.prec(), value - radiance);
        let rounding = match oracle.and_then(|o| o.radiance_at(method, n)) {
            Some(oracle) => Float::with_val(64, value - oracle).abs(),
            None => Float::with_val(64, &unit * 16_u32) * n,
        };
        let floor = if rounding > unit {
            rounding
        } else {
            unit.clone()
        };
        Sample {
            n: Some(n),
            step: Rational::from(length / n).to_f64(),
            error,
            floor,
        }
    });
    samples.collect()
}

impl Run {
    /// The same run, at some of its levels only; levels it was not run at are left out.
    #[must_use]
    pub fn at_levels(&self, ladder: &[u64]) -> Run {
        let kept: Vec<usize> = (0..self.ladder.len())
            .filter(|&level| ladder.contains(&self.ladder[level]))
            .collect();
        Run {
            bits: self.bits,
            ladder: kept.iter().map(|&level| self.ladder[level]).collect(),
            radiances: self
                .radiances
                .iter()
                .map(|levels| kept.iter().map(|&level| levels[level].clone()).collect())
                .collect(),
            evaluations: self.evaluations,
        }
    }

    /// Runs of the same methods in the same format on levels of their own, as one.
    #[cfg(feature = "studies")]
    pub(super) fn joined<'a>(
        runs: impl Iterator<Item = &'a Run>,
        methods: usize,
        bits: u32,
    ) -> Run {
        let mut joined = Run {
            bits,
            ladder: Vec::new(),
            radiances: vec![Vec::new(); methods],
            evaluations: 0,
        };
        for run in runs {
            joined.ladder.extend(&run.ladder);
            joined.evaluations += run.evaluations;
            for (all, own) in joined.radiances.iter_mut().zip(&run.radiances) {
                all.extend_from_slice(own);
            }
        }
        joined
    }

    fn radiance_at(&self, method: usize, n: u64) -> Option<&Float> {
        let level = self.ladder.iter().position(|&other| other == n)?;
        self.radiances.get(method)?.get(level)
    }
}

//! What a study will take, before it is run.

use super::{Block, Errors, Sweep, kept};
use crate::method::{Inner, Method};
use crate::quadrature::Rule;
use crate::real::FormatName;

/// What a study will take, roughly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Most bytes that values of nodes take at once.
    pub bytes: f64,
    /// Work in units of about one evaluation of a medium in binary64.
    pub work: f64,
    /// Seconds that a unit of work takes on one core, roughly.
    unit: f64,
}

/// Seconds that a unit of work takes on one core, roughly, where errors are split, for each node or depth that its methods take
/// of a segment: most of it is the oracle's, whose precision is bounded below. Measured with two methods and with twenty in 53,
/// 341 and 1,000 bits, it is right within a factor of 3.
const SECONDS: f64 = 7e-7;
/// The same of errors as a whole: a segment of one method in binary64, which evaluates its nodes itself.
const SECONDS_WHOLE: f64 = 1.5e-7;
/// Bytes a number takes beside its digits: the header and the allocation of an MPFR number.
const HEADER_BYTES: f64 = 48.0;
/// s, C and τ, kept by place and in a column.
const NUMBERS_A_NODE: f64 = 8.0;
/// For each number at a node some more for depths and transmittances of every inner rule.
const NUMBERS_A_SEGMENT: f64 = 2.0;

impl Estimate {
    /// Of `sweep` on `threads` threads.
    #[must_use]
    pub fn new(sweep: &Sweep, threads: usize) -> Estimate {
        let work = sweep.formats.iter().flat_map(|format| {
            Self::levels(sweep).map(|n| Self::work(sweep, *format, n, sweep.methods.len()) as f64)
        });
        let (bytes, unit) = match sweep.errors {
            Errors::Split => {
                let methods = sweep.methods.len().max(1) as f64;
                let unit = SECONDS * kept::looks(&sweep.methods) / methods;
                (Self::bytes_split(sweep, threads), unit)
            }
            Errors::Total => (Self::bytes_whole(sweep, threads), SECONDS_WHOLE),
        };
        Estimate {
            bytes,
            work: work.sum::<f64>() * sweep.cases.len() as f64,
            unit,
        }
    }

    /// What is shared, or the rays that some methods keep, of as many units as there are threads.
    fn bytes_whole(sweep: &Sweep, threads: usize) -> f64 {
        let units = sweep.formats.iter().flat_map(|&format| {
            let level = move |&n: &u64| {
                if kept::shares(&sweep.methods, format, n) {
                    return kept::bytes_shared(&sweep.methods, format, n);
                }
                let methods = sweep.methods.iter();
                let alone = methods.map(|method| kept::bytes_alone(method, format, n));
                alone.fold(0.0, f64::max)
            };
            sweep.levels.iter().map(level)
        });
        let at_once = threads.min(sweep.cases.len().saturating_mul(sweep.formats.len()));
        units.fold(0.0, f64::max) * at_once as f64
    }

    fn bytes_split(sweep: &Sweep, threads: usize) -> f64 {
        let finest = sweep.levels.iter().copied().max().unwrap_or(0) as f64;
        let looks: f64 = sweep.methods.iter().map(looks).sum();
        let numbers = finest * (NUMBERS_A_NODE + NUMBERS_A_SEGMENT) * looks.max(1.0);
        // The format's own values, the oracle's, and what replays and sums have of theirs.
        let bytes = |format: &FormatName| {
            let oracle = oracle_bits(*format);
            let own = f64::from(format.bits()) / 8.0 + HEADER_BYTES;
            own + 3.0 * oracle / 8.0 + 2.0 * HEADER_BYTES
        };
        let widest = sweep.formats.iter().map(bytes).fold(0.0, f64::max);
        let at_once = (2 * threads).min(sweep.cases.len()) as f64;
        numbers * widest * at_once
    }

    /// Seconds on `threads` threads of as many cores, within a factor of a few.
    #[must_use]
    pub fn seconds(&self, threads: usize) -> f64 {
        self.work * self.unit / threads.max(1) as f64
    }

    /// Seconds of a block on one core.
    #[must_use]
    pub fn seconds_of(&self, sweep: &Sweep, block: &Block) -> f64 {
        block.work(sweep) as f64 * self.unit
    }

    /// All work, as progress counts it.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative, and saturating"
    )]
    pub fn work_units(&self) -> u64 {
        self.work as u64
    }

    /// All levels of a unit, those for models alone among them.
    pub fn levels(sweep: &Sweep) -> impl Iterator<Item = u64> {
        let between = sweep.errors.between(&sweep.levels);
        sweep.levels.iter().copied().chain(between)
    }

    /// Work of so many methods at one level of one unit.
    #[must_use]
    pub fn work(sweep: &Sweep, format: FormatName, n: u64, methods: usize) -> u64 {
        let weight = match (sweep.errors, format) {
            (Errors::Split, _) => 2 + u64::from(format.bits()) / 32,
            (Errors::Total, FormatName::Mpfr(bits)) => of_mpfr(bits),
            (Errors::Total, FormatName::Ieee(_) | FormatName::Fixed(_)) => EMULATED,
            (Errors::Total, _) => 1,
        };
        n.saturating_mul(methods as u64).saturating_mul(weight)
    }
}

/// Units of work of a segment of one method in an emulated format.
const EMULATED: u64 = 8;

/// The same in MPFR: functions of b bits take about b^1.5.
fn of_mpfr(bits: u32) -> u64 {
    let words = 1 + u64::from(bits) / 64;
    4 + words * words.isqrt()
}

/// Rows of nodes that a method looks at.
fn looks(method: &Method) -> f64 {
    let of_rule = |rule: Rule| match rule {
        Rule::GaussLegendre(points) => f64::from(points),
        Rule::Boole => 4.0,
        Rule::Simpson => 2.0,
        _ => 1.0,
    };
    match method {
        Method::Nested(nested) => {
            let inner = match nested.inner {
                Inner::PerSegment(rule) => of_rule(rule),
                _ => 1.0,
            };
            let outer = match nested.outer.0 {
                Rule::GaussLegendre(points) => f64::from(points),
                Rule::Midpoint => 1.0,
                _ => 0.0,
            };
            inner * (1.0 + outer)
        }
        Method::Preintegrated(_) | Method::Composited(_) | Method::Layered(_) => 2.0,
    }
}

fn oracle_bits(format: FormatName) -> f64 {
    f64::from(format.bits().saturating_add(64)).max(128.0)
}

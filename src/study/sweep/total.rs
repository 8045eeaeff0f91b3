//! Units of errors as a whole: no oracle, no levels between; nodes shared, or none kept.

use super::floor::Sizes;
use super::record::{LevelRecord, Unit};
use super::{Block, Estimate, Sweep, kept, number};
use crate::case::{AnyNodes, Fresh, Shared, SymbolicCase};
use crate::method::{Level, Method, MethodError};
use crate::parallel;
use crate::real::{Format, FormatName, Real, WithFormat, row};
use crate::reference::{self, Reference, ReferenceError};
use crate::study::Progress;
use rug::Float;
use rug::float::Special;

/// I is known to so many bits beyond the widest format's. An error of u·|I| then has 67 bits, the twenty digits that it is
/// written with, behind 29 more for a radiance that is nearer to I than its format's numbers are to each other.
const GUARD_BITS: u32 = 96;

/// What all formats of a case are compared with.
#[derive(Debug)]
pub(super) struct Truth {
    reference: Result<Reference, ReferenceError>,
    sizes: Sizes,
}

impl Truth {
    /// I of `case` at the most bits that any of the formats needs, which are all of a study: those that are done already
    /// among them, so that what is resumed has the same digits.
    pub(super) fn new(case: &SymbolicCase, formats: &[FormatName]) -> Truth {
        let bits = formats.iter().map(|format| format.bits()).max();
        let bits = bits.unwrap_or(0).saturating_add(GUARD_BITS);
        Truth {
            reference: reference::radiance(case, bits),
            sizes: Sizes::of(case),
        }
    }
}

/// One case in one format, the format still to be chosen.
pub(super) struct OneUnit<'a> {
    pub(super) sweep: &'a Sweep,
    pub(super) block: &'a Block,
    pub(super) name: &'a str,
    pub(super) case: &'a SymbolicCase,
    pub(super) format: FormatName,
    pub(super) truth: &'a Truth,
    pub(super) levels_in_parallel: bool,
    pub(super) progress: &'a dyn Progress,
}

/// The radiances of all methods at one level.
type Radiances = Vec<Result<Float, MethodError>>;

impl WithFormat for OneUnit<'_> {
    type Output = (Unit, u64);

    fn run<F: Format>(self, format: F) -> (Unit, u64) {
        let shared = Shared::new(self.case, format);
        let fresh = Fresh::new(self.case, format);
        let methods = self.block.methods(self.sweep);
        let radiances = |n| {
            if kept::shares(methods, self.format, n) {
                together(AnyNodes::new(&shared), n, methods)
            } else {
                one_by_one(AnyNodes::new(&fresh), n, methods)
            }
        };
        let records = self.all(format.bits(), &radiances);
        let (radiance, unproved) = match &self.truth.reference {
            Ok(reference) => (reference.value.clone(), reference.unproved(self.case)),
            // Each level says why.
            Err(_) => (Float::with_val(format.bits(), Special::Nan), Vec::new()),
        };
        let unit = Unit {
            case: self.name.into(),
            format: self.format.to_string(),
            bits: format.bits(),
            radiance: number::rounded(&radiance),
            unproved,
            rows: self.block.rows(self.sweep, self.case, &records),
        };
        (unit, shared.evaluations() + fresh.evaluations())
    }
}

/// What methods have in common is computed once.
fn together<F: Format>(nodes: AnyNodes<'_, F>, n: u64, methods: &[Method]) -> Radiances {
    let mut level = Level::of_any(nodes, n);
    row(methods
        .iter()
        .map(|method| Ok(level.radiance(method)?.to_float())))
}

/// Nothing is kept.
fn one_by_one<F: Format>(nodes: AnyNodes<'_, F>, n: u64, methods: &[Method]) -> Radiances {
    row(methods
        .iter()
        .map(|method| Ok(method.stream(nodes, n)?.to_float())))
}

impl OneUnit<'_> {
    /// The records of the methods at each level; `radiances` gives those of one.
    fn all(
        &self,
        bits: u32,
        radiances: &(dyn Fn(u64) -> Radiances + Sync),
    ) -> Vec<Vec<LevelRecord>> {
        let methods = self.block.methods.len();
        let at = |&n: &u64| {
            let records = self.records(n, bits, radiances);
            self.progress
                .advance(Estimate::work(self.sweep, self.format, n, methods));
            records
        };
        let levels = self.block.levels(self.sweep);
        if self.levels_in_parallel {
            parallel::map(&levels, at)
        } else {
            levels.iter().map(at).collect()
        }
    }

    /// The records of all methods at one level.
    fn records(
        &self,
        n: u64,
        bits: u32,
        radiances: &(dyn Fn(u64) -> Radiances + Sync),
    ) -> Vec<LevelRecord> {
        let methods = self.block.methods(self.sweep);
        let exact = match &self.truth.reference {
            Ok(reference) => &reference.value,
            Err(error) => {
                return vec![LevelRecord::refused(n, error.to_string()); methods.len()];
            }
        };
        let record = |(method, radiance): (&Method, Result<Float, MethodError>)| match radiance {
            Ok(radiance) => {
                let total = Float::with_val(exact.prec(), &radiance - exact);
                let sizes = &self.truth.sizes;
                let floor = sizes.floor(exact, method, self.format, bits, n);
                LevelRecord::whole(n, &total, &floor)
            }
            Err(error) => LevelRecord::refused(n, error.to_string()),
        };
        methods.iter().zip(radiances(n)).map(record).collect()
    }
}

//! Parts of a unit, which machines do apart.

use super::record::{Header, LevelRecord, Row, Unit};
use super::{Estimate, Sweep};
use crate::case::SymbolicCase;
use crate::method::{Method, expected_on};
use crate::real::FormatName;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Some methods at some levels of a case in a format, done in one go. Places are those in the lists of the study; the levels
/// for models alone stand behind the others.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Case and format, counted case by case.
    pub unit: usize,
    /// Levels.
    pub levels: Range<usize>,
    /// Methods.
    pub methods: Range<usize>,
}

impl Block {
    /// All of every unit of a study.
    #[must_use]
    pub fn whole(header: &Header) -> Vec<Block> {
        let units = header.cases.len().saturating_mul(header.formats.len());
        Self::all(units, header.every_level().len(), header.methods.len())
    }

    /// The same.
    pub(super) fn whole_of(sweep: &Sweep) -> Vec<Block> {
        let units = sweep.cases.len().saturating_mul(sweep.formats.len());
        Self::all(units, Estimate::levels(sweep).count(), sweep.methods.len())
    }

    fn all(units: usize, levels: usize, methods: usize) -> Vec<Block> {
        let all = (0..units).map(|unit| Block {
            unit,
            levels: 0..levels,
            methods: 0..methods,
        });
        all.collect()
    }

    /// What a message calls it.
    pub(super) fn name(&self, header: &Header) -> String {
        let mut units = header.units();
        let (case, format) = units.nth(self.unit).unwrap_or_default();
        let mut name = format!("{case} in {format}");
        let all = header.every_level();
        let levels = all.get(self.levels.clone()).unwrap_or_default();
        if levels.len() < all.len() {
            let levels: Vec<String> = levels.iter().map(ToString::to_string).collect();
            name = format!("{name}, n = {}", levels.join(", "));
        }
        let methods = header.methods.get(self.methods.clone()).unwrap_or_default();
        if methods.len() < header.methods.len() {
            name = format!("{name}, {}", methods.join(", "));
        }
        name
    }

    /// The case, by its place.
    pub(super) fn case(&self, sweep: &Sweep) -> usize {
        self.unit / sweep.formats.len().max(1)
    }

    /// The format.
    pub(super) fn format(&self, sweep: &Sweep) -> Option<FormatName> {
        let place = self.unit.checked_rem(sweep.formats.len())?;
        sweep.formats.get(place).copied()
    }

    /// Its levels, those for models alone among them.
    pub(super) fn levels(&self, sweep: &Sweep) -> Vec<u64> {
        let levels = Estimate::levels(sweep).skip(self.levels.start);
        levels.take(self.levels.len()).collect()
    }

    /// What it takes in units of work, all methods of a level being the same.
    #[must_use]
    pub fn work(&self, sweep: &Sweep) -> u64 {
        let Some(format) = self.format(sweep) else {
            return 0;
        };
        let levels = self.levels(sweep).into_iter();
        let work = |n| Estimate::work(sweep, format, n, self.methods.len());
        levels.map(work).fold(0, u64::saturating_add)
    }

    /// Its methods.
    pub(super) fn methods<'s>(&self, sweep: &'s Sweep) -> &'s [Method] {
        sweep.methods.get(self.methods.clone()).unwrap_or_default()
    }

    /// The rows of its methods; `records` has all of them at each of its levels. Theory has the whole ladder before it.
    pub(super) fn rows(
        &self,
        sweep: &Sweep,
        case: &SymbolicCase,
        records: &[Vec<LevelRecord>],
    ) -> Vec<Row> {
        let own = sweep.levels.len().saturating_sub(self.levels.start);
        let (levels, between) = records.split_at(own.min(records.len()));
        let of = |levels: &[Vec<LevelRecord>], m: usize| {
            let records = levels.iter().filter_map(|level| level.get(m).cloned());
            records.collect()
        };
        let methods = self.methods(sweep).iter().enumerate();
        let rows = methods.map(|(m, method)| Row {
            method: method.name(),
            expected: expected_on(method, case, &sweep.levels).into(),
            levels: of(levels, m),
            between: of(between, m),
        });
        rows.collect()
    }
}

/// The unit that blocks are of, in the order of levels and methods; `None` where they are not all there.
pub(super) fn joined(header: &Header, blocks: Vec<(&Block, Unit)>) -> Option<Unit> {
    let own = header.levels.len();
    let levels = header.every_level().len();
    let mut rows: Vec<Row> = Vec::with_capacity(header.methods.len());
    for method in 0..header.methods.len() {
        let mut all: Option<Row> = None;
        let mut next = 0;
        // Blocks of a method stand in the order of their levels.
        for (block, unit) in &blocks {
            let Some(place) = method.checked_sub(block.methods.start) else {
                continue;
            };
            let (true, Some(row)) = (block.methods.contains(&method), unit.rows.get(place)) else {
                continue;
            };
            if block.levels.start != next {
                return None;
            }
            next = block.levels.end;
            let all = all.get_or_insert_with(|| Row {
                levels: Vec::with_capacity(own),
                between: Vec::with_capacity(levels - own),
                ..row.clone()
            });
            all.levels.extend_from_slice(&row.levels);
            all.between.extend_from_slice(&row.between);
        }
        rows.push(all.filter(|_| next == levels)?);
    }
    let (_, first) = blocks.into_iter().next()?;
    Some(Unit { rows, ..first })
}

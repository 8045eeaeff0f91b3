//! A study on many machines.

use super::block::{self, Block};
use super::journal::{JournalError, Shape, write_whole};
use super::keep::Keep;
use super::pieces::{self, Shares};
use super::record::{Header, Unit};
use super::stopped::SweepError;
use super::{Estimate, Sweep};
use crate::study::shards::{Divisible, Division, FileError, Gathered, Key, Shard};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::path::Path;

/// What reports are made of, besides the units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Divided {
    /// What is run.
    pub header: Header,
    /// The bits that are swept for a map of digits.
    pub sweep_bits: Option<RangeInclusive<u32>>,
    /// Of each format whether it is there for the map alone.
    pub swept: Vec<bool>,
    /// What is done in one go each, in the order of cases and formats, and of levels and methods within.
    pub blocks: Vec<Block>,
}

impl Divisible for Divided {
    const KIND: &'static str = "study";
    const COMMAND: &'static str = "study";

    fn keys(&self) -> Vec<Key> {
        let blocks = self.blocks.iter();
        blocks.map(|block| self.header.key(block)).collect()
    }

    fn name(&self, block: usize) -> String {
        let block = self.blocks.get(block);
        block.map_or_else(String::new, |block| block.name(&self.header))
    }

    /// However its units are cut into blocks, it is the same study.
    fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let maps = |of: &Self| match &of.sweep_bits {
            Some(bits) => format!("{}..{}", bits.start(), bits.end()),
            None => "none".into(),
        };
        let of_header = self.header.difference(&other.header);
        of_header.or_else(|| {
            let (ours, theirs) = (maps(self), maps(other));
            let same = ours == theirs && self.swept == other.swept;
            (!same).then_some(("sweep-bits", ours, theirs))
        })
    }
}

impl Divided {
    /// Whole units.
    #[must_use]
    pub fn new(header: Header, sweep_bits: Option<RangeInclusive<u32>>, swept: Vec<bool>) -> Self {
        Divided {
            blocks: Block::whole(&header),
            header,
            sweep_bits,
            swept,
        }
    }

    /// The same in blocks for so many shards, of units that cost so much each.
    #[must_use]
    pub fn cut(self, costs: &[f64], shards: usize) -> Self {
        Divided {
            blocks: pieces::cut(&self.header, costs, shards),
            ..self
        }
    }

    /// The cost of every block, of those of the units: by its segments, as far as methods are alike.
    #[must_use]
    pub fn shares(&self, costs: &[f64]) -> Vec<f64> {
        let shares = Shares::new(&self.header);
        let cost = |block: &Block| {
            costs
                .get(block.unit)
                .map_or(0.0, |cost| cost * shares.of(block))
        };
        self.blocks.iter().map(cost).collect()
    }

    /// Seconds that each unit takes, as [`Estimate`] foresees it.
    #[must_use]
    pub fn model(sweep: &Sweep, estimate: &Estimate) -> Vec<f64> {
        let whole = Block::whole_of(sweep);
        whole
            .iter()
            .map(|block| estimate.seconds_of(sweep, block))
            .collect()
    }

    /// The same with what an earlier study has taken: what the model says of a unit, times what that unit took there of what the
    /// model said of it; or else all units of its format, or all.
    #[must_use]
    pub fn learned(
        &self,
        model: &[f64],
        earlier: &Division<Divided>,
        gathered: &Gathered,
    ) -> Vec<f64> {
        let mut sums: HashMap<Whose<'_>, (f64, f64)> = HashMap::new();
        let before = &earlier.work;
        let blocks = before.blocks.iter().zip(before.keys());
        for ((block, key), model) in blocks.zip(&earlier.model) {
            let Some((_, took)) = gathered.seconds(key) else {
                continue;
            };
            for whose in Whose::of(&before.header, block.unit) {
                let sum = sums.entry(whose).or_default();
                sum.0 += took;
                sum.1 += model;
            }
        }
        let ratio = |whose: &Whose<'_>| {
            let (took, model) = sums.get(whose)?;
            Some(took / model).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
        };
        let learned = (0..).zip(model).map(|(unit, model)| {
            let whose = Whose::of(&self.header, unit);
            model * whose.iter().find_map(ratio).unwrap_or(1.0)
        });
        learned.collect()
    }

    /// All units, in their order; `None` where a part of one is missing.
    ///
    /// # Errors
    /// [`JournalError`] where a unit cannot be read, or is none of this study.
    #[must_use]
    pub fn units(&self, gathered: &Gathered) -> Option<Result<Vec<Unit>, JournalError>> {
        let keys = self.keys();
        if !keys.iter().all(|key| gathered.has(*key)) {
            return None;
        }
        let shape = Shape::new(&self.header);
        let parts: Vec<(&Block, Key)> = self.blocks.iter().zip(keys).collect();
        let units = parts.chunk_by(|(a, _), (b, _)| a.unit == b.unit);
        let units = units.zip(1..).map(|(parts, number)| {
            let wrong = |reason: String| JournalError::Line {
                path: format!("unit {number}"),
                line: 1,
                reason,
            };
            let texts = parts.iter();
            let texts = texts.filter_map(|(block, key)| Some((*block, gathered.unit(*key)?)));
            let read = texts.map(|(block, text)| {
                let text = text.map_err(|error: FileError| JournalError::Shard(error))?;
                let part: Unit = serde_json::from_str(&text).map_err(|e| wrong(e.to_string()))?;
                Ok((block, part))
            });
            let unit = block::joined(&self.header, read.collect::<Result<_, JournalError>>()?);
            let unit = unit.ok_or_else(|| wrong("its parts do not cover it".into()))?;
            shape.check(&unit).map_err(wrong)?;
            Ok(unit)
        });
        Some(units.collect())
    }

    /// Writes the journal that one machine writes.
    ///
    /// # Errors
    /// [`JournalError`] where it cannot be written.
    pub fn write_journal(&self, path: &Path, units: &[Unit]) -> Result<(), JournalError> {
        write_whole(path, &self.header, units)
    }
}

/// What costs are learned of.
#[derive(PartialEq, Eq, Hash)]
enum Whose<'h> {
    /// A case in a format.
    Unit(&'h [String; 5], &'h str),
    /// All cases in a format.
    Format(&'h str),
    /// Everything.
    Study,
}

impl<'h> Whose<'h> {
    /// Whose costs those of a unit are, its own first.
    fn of(header: &'h Header, unit: usize) -> Vec<Whose<'h>> {
        let formats = header.formats.len().max(1);
        let case = header.cases.get(unit / formats);
        let format = header.formats.get(unit % formats);
        let own = case.zip(format);
        let own = own.map(|(case, format)| Whose::Unit(case, format));
        let of_format = format.map(|format| Whose::Format(format));
        own.into_iter()
            .chain(of_format)
            .chain([Whose::Study])
            .collect()
    }
}

/// A shard of a study.
#[derive(Debug)]
pub struct StudyShard {
    shard: Shard,
    blocks: Vec<(Block, Key)>,
}

impl StudyShard {
    /// Takes the blocks of this study that the shard still wants.
    #[must_use]
    pub fn new(shard: Shard, work: &Divided) -> StudyShard {
        let blocks = work.blocks.iter().cloned().zip(work.keys());
        StudyShard {
            blocks: blocks.filter(|(_, key)| shard.wants(*key)).collect(),
            shard,
        }
    }

    /// What is still to be done.
    #[must_use]
    pub fn wanted(&self) -> Vec<Block> {
        let left = self.blocks.iter();
        let left = left.filter(|(_, key)| self.shard.wants(*key));
        left.map(|(block, _)| block.clone()).collect()
    }

    /// The shard.
    #[must_use]
    pub fn into_shard(self) -> Shard {
        self.shard
    }
}

impl Keep for StudyShard {
    fn left(&self, _: &Sweep) -> Vec<Block> {
        self.wanted()
    }

    fn keep(&mut self, block: &Block, unit: Unit, took: f64) -> Result<(), SweepError> {
        match self.blocks.iter().find(|(own, _)| own == block) {
            Some((_, key)) => Ok(self.shard.append(*key, took, &unit)?),
            None => Ok(()),
        }
    }
}

//! A study on many machines.

use super::journal::{JournalError, check, write_whole};
use super::keep::Keep;
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
}

impl Divisible for Divided {
    const KIND: &'static str = "study";

    fn keys(&self) -> Vec<Key> {
        self.header.keys()
    }

    fn name(&self, unit: usize) -> String {
        let (case, format) = self.header.units().nth(unit).unwrap_or_default();
        format!("{case} in {format}")
    }

    fn difference(&self, other: &Self) -> (&'static str, String, String) {
        let maps = |of: &Self| match &of.sweep_bits {
            Some(bits) => format!("{}..{}", bits.start(), bits.end()),
            None => "none".into(),
        };
        let of_header = self.header.difference(&other.header);
        of_header.unwrap_or_else(|| ("sweep-bits", maps(self), maps(other)))
    }
}

impl Divided {
    /// Seconds that each unit takes, as [`Estimate`] foresees it.
    #[must_use]
    pub fn model(sweep: &Sweep, estimate: &Estimate) -> Vec<f64> {
        let of_case: Vec<f64> = sweep
            .formats
            .iter()
            .map(|format| estimate.seconds_of_unit(sweep, *format))
            .collect();
        sweep.cases.iter().flat_map(|_| of_case.clone()).collect()
    }

    /// The same with what an earlier study has taken: a unit that was run there takes what it took; another one what the model
    /// says, times what units of its format took there, or all of them, of what the model said.
    #[must_use]
    pub fn learned(
        &self,
        model: &[f64],
        earlier: &Division<Divided>,
        gathered: &Gathered,
    ) -> Vec<f64> {
        let keys = earlier.work.keys();
        let mut sums: HashMap<&str, (f64, f64)> = HashMap::new();
        let mut all = (0.0, 0.0);
        let units = keys.iter().zip(&earlier.model);
        for ((key, model), (_, format)) in units.zip(earlier.work.header.units()) {
            if let Some((_, took)) = gathered.seconds(*key) {
                for (sum, sum_of_model) in [&mut all, sums.entry(format).or_default()] {
                    *sum += took;
                    *sum_of_model += model;
                }
            }
        }
        let ratio = |(took, model): (f64, f64)| {
            let ratio = took / model;
            Some(ratio).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
        };
        let units = self.keys().into_iter().zip(model);
        let costs = units.zip(self.header.units());
        costs
            .map(|((key, model), (_, format))| {
                if let Some((_, took)) = gathered.seconds(key) {
                    return took;
                }
                let of_format = sums.get(format).and_then(|sums| ratio(*sums));
                model * of_format.or_else(|| ratio(all)).unwrap_or(1.0)
            })
            .collect()
    }

    /// All units, in their order; `None` where one is missing.
    ///
    /// # Errors
    /// [`JournalError`] where a unit cannot be read, or is none of this study.
    #[must_use]
    pub fn units(&self, gathered: &Gathered) -> Option<Result<Vec<Unit>, JournalError>> {
        let keys = self.keys();
        if !keys.iter().all(|key| gathered.has(*key)) {
            return None;
        }
        let texts = keys.iter().filter_map(|key| gathered.unit(*key));
        let units = texts.zip(1..).map(|(text, number)| {
            let wrong = |reason: String| JournalError::Line {
                path: format!("unit {number}"),
                line: 1,
                reason,
            };
            let text = text.map_err(|error: FileError| JournalError::Shard(error))?;
            let unit: Unit = serde_json::from_str(&text).map_err(|e| wrong(e.to_string()))?;
            check(&unit, &self.header).map_err(wrong)?;
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

/// A shard of a study.
#[derive(Debug)]
pub struct StudyShard {
    shard: Shard,
    keys: HashMap<(String, String), Key>,
}

impl StudyShard {
    /// Takes the units of this study that the shard still wants.
    #[must_use]
    pub fn new(shard: Shard, work: &Divided) -> StudyShard {
        let names = work.header.units();
        let names = names.map(|(case, format)| (case.to_string(), format.to_string()));
        StudyShard {
            shard,
            keys: names.zip(work.keys()).collect(),
        }
    }

    /// The shard.
    #[must_use]
    pub fn into_shard(self) -> Shard {
        self.shard
    }

    fn key(&self, case: &str, format: &str) -> Option<Key> {
        self.keys.get(&(case.into(), format.into())).copied()
    }
}

impl Keep for StudyShard {
    fn wants(&self, case: &str, format: &str) -> bool {
        let key = self.key(case, format);
        key.is_some_and(|key| self.shard.wants(key))
    }

    fn keep(&mut self, unit: Unit, took: f64) -> Result<(), SweepError> {
        match self.key(&unit.case, &unit.format) {
            Some(key) => Ok(self.shard.append(key, took, &unit)?),
            None => Ok(()),
        }
    }
}

//! `--shard` and `--on`: work in shards, run one at a time or handed to an engine.

mod engine;

pub(super) use engine::SCRIPT;

use super::budget::time;
use super::output::{noun, said};
use super::{Failure, Outcome, write_out};
use clap::Args;
use engine::{Array, Engine};
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use volver::study::shards::{Divisible, Division, Gathered, Shard};

/// A part of the work, or all parts.
#[derive(Args)]
pub(super) struct Sharding {
    /// Run one of N shards into the directory of --out: K/N, K from 1
    #[arg(long, value_name = "K/N", requires = "out", conflicts_with = "on")]
    shard: Option<Share>,
    /// Write what runs all shards: slurm submits an array, kubernetes writes a manifest,
    /// shell prints a line each
    #[arg(long, value_enum, value_name = "ENGINE", requires_all = ["out", "shards"])]
    on: Option<Engine>,
    /// How many shards
    #[arg(long, value_name = "N", requires = "on", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    shards: Option<u32>,
    /// Only these shards, as 'volver merge' lists them: 3,7 or 3-5,9
    #[arg(long, value_name = "LIST", requires = "on")]
    only: Option<Only>,
    /// More words for sbatch, in one argument
    #[arg(long, value_name = "ARGS", requires = "on", allow_hyphen_values = true)]
    sbatch_args: Option<String>,
    /// The container image with this program
    #[arg(long, value_name = "IMAGE", requires = "on", default_value = "volver")]
    image: String,
    /// The persistent volume claim that holds the working directory
    #[arg(long, value_name = "CLAIM", requires = "on", default_value = "volver")]
    claim: String,
    /// Learn from what the shards of an earlier run took
    #[arg(long, value_name = "DIR", requires = "out")]
    pub(super) costs: Option<PathBuf>,
}

/// Options that divide, each with a value: the command of one machine has none of them.
const OPTIONS: [&str; 9] = [
    "--shard",
    "--on",
    "--shards",
    "--only",
    "--sbatch-args",
    "--image",
    "--claim",
    "--costs",
    "--threads",
];

/// A shard of so many.
#[derive(Clone, Copy, Debug)]
struct Share {
    shard: usize,
    of: usize,
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text.split_once('/').and_then(|(shard, of)| {
            let share = (shard.parse().ok()?, of.parse().ok()?);
            (1..=share.1).contains(&share.0).then_some(share)
        });
        let (shard, of) = numbers.ok_or("no shard (allowed: K/N, K from 1 to N)")?;
        Ok(Share { shard, of })
    }
}

/// Numbers of shards that ascend.
#[derive(Clone, Debug)]
struct Only(Vec<usize>);

impl FromStr for Only {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let range = |part: &str| -> Option<std::ops::RangeInclusive<usize>> {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            let range = first.trim().parse().ok()?..=last.trim().parse().ok()?;
            (*range.start() >= 1 && !range.is_empty() && *range.end() <= 100_000).then_some(range)
        };
        let ranges: Option<Vec<_>> = text.split(',').map(range).collect();
        let ranges = ranges.ok_or("no shards (allowed: numbers from 1, such as 3,7 or 3-5,9)")?;
        let mut shards: Vec<usize> = ranges.into_iter().flatten().collect();
        shards.sort_unstable();
        shards.dedup();
        Ok(Only(shards))
    }
}

/// What shards take of a machine.
pub(super) struct Needs {
    /// Threads of one.
    pub(super) threads: usize,
    /// Bytes of one.
    pub(super) bytes: f64,
    /// Words that each is run with besides.
    pub(super) words: String,
}

impl Sharding {
    /// Whether it is run in shards.
    pub(super) fn is_asked(&self) -> bool {
        self.shard.is_some() || self.on.is_some()
    }

    /// Refuses options that are for all of the work at once.
    pub(super) fn refuse(&self, given: &[(&str, bool)]) -> Result<(), Failure> {
        match given.iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) if self.is_asked() => Err(Failure::Usage(format!(
                "{option} with {} (allowed: without shards)",
                if self.on.is_some() { "--on" } else { "--shard" }
            ))),
            _ => Ok(()),
        }
    }

    /// How many shards.
    pub(super) fn count(&self) -> usize {
        let of = self.shards.and_then(|shards| usize::try_from(shards).ok());
        self.shard.map(|share| share.of).or(of).unwrap_or(1)
    }

    /// The shard to run here, counted from 1.
    pub(super) fn here(&self) -> Option<usize> {
        self.shard.map(|share| share.shard)
    }

    /// The work in so many shards, as the directory keeps it; the last `own` words of the command are not volver's.
    pub(super) fn divided<W: Divisible>(
        &self,
        directory: &Path,
        work: W,
        (model, costs): (Vec<f64>, Vec<f64>),
        own: usize,
    ) -> Result<Division<W>, Failure> {
        let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
        let command = one_machine(&words.collect::<Vec<_>>(), own);
        let division = Division::new(work, command, model, costs, self.count());
        division.map_err(said)?.kept_in(directory).map_err(said)
    }

    /// Lets an engine run the shards.
    pub(super) fn hand_over<W: Divisible>(
        &self,
        division: &Division<W>,
        directory: &Path,
        own: usize,
        needs: Needs,
    ) -> Result<Outcome, Failure> {
        let Some(engine) = self.on else {
            return Ok(Outcome::Good);
        };
        let array = Array {
            command: &division.command,
            verb: W::COMMAND,
            own,
            directory,
            shards: division.shards(),
            only: self.only(division.shards())?,
            needs,
        };
        let said = match engine {
            Engine::Slurm => array.slurm(self.sbatch_args.as_deref())?,
            Engine::Kubernetes => array.kubernetes(&self.image, &self.claim)?,
            Engine::Shell => array.shell(),
        };
        write_out(&said)?;
        let (mean, slowest) = division.seconds();
        let threads = array.needs.threads as f64;
        // Beside lines that are for a shell.
        if io::stderr().is_terminal() {
            // Who does not hear it has lost nothing.
            let _ = writeln!(
                io::stderr(),
                "a shard takes about {}, the slowest {}",
                time(mean / threads),
                time(slowest / threads)
            );
        }
        Ok(Outcome::Good)
    }

    fn only(&self, shards: usize) -> Result<Vec<usize>, Failure> {
        let Some(Only(only)) = &self.only else {
            return Ok((1..=shards).collect());
        };
        match only.last() {
            Some(last) if *last > shards => Err(Failure::Usage(format!(
                "--only: shard {last} of {shards} (allowed: 1 to {shards})"
            ))),
            _ => Ok(only.clone()),
        }
    }
}

/// Gives a shard's file its name, and says so; `before` units were there when it began.
pub(super) fn finish(
    shard: Shard,
    number: usize,
    of: usize,
    before: usize,
    quiet: bool,
) -> Result<Outcome, Failure> {
    let units = shard.units();
    let file = shard.finish().map_err(said)?;
    if !quiet {
        let again = match before {
            0 => String::new(),
            before => format!(", {before} of them by earlier runs"),
        };
        write_out(&format!(
            "shard {number} of {of}: {}{again}, in {}\n",
            noun(units, "unit", "units"),
            file.display()
        ))?;
    }
    Ok(Outcome::Good)
}

/// What an earlier run has, to learn from.
pub(super) fn earlier<W: Divisible>(directory: &Path) -> Result<(Division<W>, Gathered), Failure> {
    let division: Division<W> = Division::open(directory).map_err(said)?;
    let gathered = Gathered::new(directory, &division).map_err(said)?;
    Ok((division, gathered))
}

/// A command without what divides it; its last `own` words are left as they are.
fn one_machine(words: &[String], own: usize) -> Vec<String> {
    let (words, own) = words.split_at(words.len().saturating_sub(own));
    let mut kept = Vec::new();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        if OPTIONS.contains(&word.as_str()) {
            words.next();
            continue;
        }
        let is_joined = OPTIONS.iter().any(|option| {
            let value = word.strip_prefix(option);
            value.is_some_and(|value| value.starts_with('='))
        });
        if !is_joined {
            kept.push(word.clone());
        }
    }
    kept.extend_from_slice(own);
    kept
}

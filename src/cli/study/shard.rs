//! `--shard` and `--on`: a study in shards, run one at a time or handed to an engine.

use super::Study;
use super::engine::{Array, Engine};
use crate::cli::budget::{Budget, HOUR, time};
use crate::cli::output::{noun, said};
use crate::cli::{Bar, Failure, Outcome, write_out};
use clap::Args;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use volver::render;
use volver::study::Progress;
use volver::study::shards::{Division, Gathered, Shard};
use volver::study::sweep::{Divided, Estimate, StudyShard, Sweep, run};

/// A part of a study, or all of them.
#[derive(Args)]
pub(super) struct Sharding {
    /// Run one of N shards into the directory of --out: K/N, K from 1
    #[arg(long, value_name = "K/N", requires = "out", conflicts_with_all = ["resume", "json", "csv", "on"])]
    shard: Option<Share>,
    /// Write what runs all shards: slurm submits an array, kubernetes writes a manifest,
    /// shell prints a line each
    #[arg(long, value_enum, value_name = "ENGINE", requires_all = ["out", "shards"], conflicts_with_all = ["resume", "json", "csv"])]
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
    /// Learn from what the shards of an earlier study took
    #[arg(long, value_name = "DIR", requires = "out")]
    costs: Option<PathBuf>,
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

impl Sharding {
    /// Whether the study is run in shards.
    pub(super) fn is_asked(&self) -> bool {
        self.shard.is_some() || self.on.is_some()
    }

    fn shards(&self) -> usize {
        let of = self.shards.and_then(|shards| usize::try_from(shards).ok());
        self.shard.map(|share| share.of).or(of).unwrap_or(1)
    }
}

impl Study {
    /// Runs the shard, or lets an engine run all.
    pub(super) fn in_shards(
        &self,
        sweep: &Sweep,
        work: Divided,
        threads: usize,
        estimate: &Estimate,
    ) -> Result<Outcome, Failure> {
        let Some(directory) = &self.out else {
            return Ok(Outcome::Good);
        };
        render::check_directory(directory)?;
        let model = Divided::model(sweep, estimate);
        let costs = match &self.sharding.costs {
            Some(earlier) => {
                let division: Division<Divided> = Division::open(earlier).map_err(said)?;
                let gathered = Gathered::new(earlier, &division).map_err(said)?;
                work.learned(&model, &division, &gathered)
            }
            None => model.clone(),
        };
        let shards = self.sharding.shards();
        let work = work.cut(&costs, shards);
        let (model, costs) = (work.shares(&model), work.shares(&costs));
        let command = one_machine(std::env::args_os().map(|word| word.to_string_lossy().into()));
        let division = Division::new(work, command, model, costs, shards);
        let division = division.map_err(said)?.kept_in(directory).map_err(said)?;
        match (self.sharding.shard, self.sharding.on) {
            (Some(share), _) => self.one(sweep, &division, share, threads, estimate, directory),
            (None, Some(engine)) => {
                let array = Array {
                    command: &division.command,
                    directory,
                    shards: division.shards(),
                    only: self.only(division.shards())?,
                    threads: self.threads.map_or(1, usize::from),
                    bytes: estimate.bytes,
                };
                let said = match engine {
                    Engine::Slurm => array.slurm(self.sharding.sbatch_args.as_deref())?,
                    Engine::Kubernetes => {
                        array.kubernetes(&self.sharding.image, &self.sharding.claim)?
                    }
                    Engine::Shell => array.shell(),
                };
                write_out(&said)?;
                let (mean, slowest) = division.seconds();
                let threads = array.threads as f64;
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
            (None, None) => Ok(Outcome::Good),
        }
    }

    fn only(&self, shards: usize) -> Result<Vec<usize>, Failure> {
        let Some(Only(only)) = &self.sharding.only else {
            return Ok((1..=shards).collect());
        };
        match only.last() {
            Some(last) if *last > shards => Err(Failure::Usage(format!(
                "--only: shard {last} of {shards} (allowed: 1 to {shards})"
            ))),
            _ => Ok(only.clone()),
        }
    }

    fn one(
        &self,
        sweep: &Sweep,
        division: &Division<Divided>,
        share: Share,
        threads: usize,
        estimate: &Estimate,
        directory: &Path,
    ) -> Result<Outcome, Failure> {
        let units = division.units(share.shard).map_err(said)?;
        let costs = division.costs.get(units.clone()).unwrap_or_default();
        let budget = Budget {
            what: "the shard",
            bytes: estimate.bytes,
            seconds: costs.iter().sum::<f64>() / threads as f64,
            usual: HOUR,
        };
        budget.check(self.yes)?;
        budget.announce();
        let shard = Shard::begin(directory, division, share.shard).map_err(said)?;
        let (all, before) = (shard.units(), shard.units() - shard.left());
        let mut shard = StudyShard::new(shard, &division.work);
        let blocks = division.work.blocks.get(units).unwrap_or_default();
        let works = blocks.iter().map(|block| block.work(sweep));
        let works = works.fold(0, u64::saturating_add);
        let bar = Bar::new(works);
        let ran = run(sweep, &mut shard, threads, &bar as &dyn Progress);
        bar.finish();
        ran.map_err(said)?;
        let file = shard.into_shard().finish().map_err(said)?;
        if !self.forms.quiet {
            let again = match before {
                0 => String::new(),
                before => format!(", {before} of them by earlier runs"),
            };
            write_out(&format!(
                "shard {} of {}: {}{again}, in {}\n",
                share.shard,
                share.of,
                noun(all, "unit", "units"),
                file.display()
            ))?;
        }
        Ok(Outcome::Good)
    }
}

/// A command without what divides it.
fn one_machine(words: impl Iterator<Item = String>) -> Vec<String> {
    let mut kept = Vec::new();
    let mut words = words.peekable();
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
            kept.push(word);
        }
    }
    kept
}

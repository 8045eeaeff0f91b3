//! What runs shards on many machines.

mod kubernetes;
mod shell;
mod slurm;

pub(in crate::cli) use slurm::SCRIPT;

use clap::ValueEnum;
use std::path::Path;
use volver::document::quoted;

/// Who runs the shards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Engine {
    /// An array of jobs, submitted by sbatch
    Slurm,
    /// An indexed job, as a manifest
    Kubernetes,
    /// Lines for GNU parallel, xargs or a terminal
    Shell,
}

/// Shards to run.
pub(in crate::cli) struct Array<'a> {
    /// The command of one machine.
    pub(in crate::cli) command: &'a [String],
    /// Where the shards are kept.
    pub(in crate::cli) directory: &'a Path,
    /// How many there are.
    pub(in crate::cli) shards: usize,
    /// Those to run, ascending.
    pub(in crate::cli) only: Vec<usize>,
    /// Threads of one.
    pub(in crate::cli) threads: usize,
    /// Bytes that one takes.
    pub(in crate::cli) bytes: f64,
}

impl Array<'_> {
    /// The command of a shard for a POSIX shell, `shard` being its number there, run by `program`. What it takes was said when it
    /// was divided.
    fn command(&self, program: &str, shard: &str) -> String {
        let mut words = vec![quoted(program)];
        let given = self.command.iter().skip(1).map(String::as_str);
        let given = given.filter(|word| !["--yes", "--quiet"].contains(word));
        words.extend(given.map(quoted));
        let (shards, threads) = (self.shards, self.threads);
        words.push(format!(
            "--shard {shard}/{shards} --threads {threads} --yes --quiet"
        ));
        words.join(" ")
    }

    /// The numbers of shards: `1-8`, `3,7`.
    fn list(&self) -> String {
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for &shard in &self.only {
            match runs.last_mut() {
                Some((_, last)) if *last + 1 == shard => *last = shard,
                _ => runs.push((shard, shard)),
            }
        }
        let runs = runs.iter().map(|(first, last)| match last - first {
            0 => first.to_string(),
            _ => format!("{first}-{last}"),
        });
        runs.collect::<Vec<_>>().join(",")
    }

    /// Whole MiB that one asks for.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative, and saturating"
    )]
    fn mebibytes(&self) -> u64 {
        /// What the program takes beside the numbers that are counted.
        const OWN: f64 = 256.0;
        (self.bytes / f64::from(1 << 20) + OWN).ceil() as u64
    }
}

/// This program, where every machine that sees the same files finds it.
fn this_program() -> String {
    let path = std::env::current_exe();
    path.map_or_else(|_| "volver".into(), |path| path.display().to_string())
}

//! What runs shards on many machines.

mod kubernetes;
mod shell;
mod slurm;

pub(in crate::cli) use slurm::SCRIPT;

use super::Needs;
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
    /// The word of it that says what it does.
    pub(in crate::cli) verb: &'static str,
    /// How many of its last words are not volver's.
    pub(in crate::cli) own: usize,
    /// Where the shards are kept.
    pub(in crate::cli) directory: &'a Path,
    /// How many there are.
    pub(in crate::cli) shards: usize,
    /// Those to run, ascending.
    pub(in crate::cli) only: Vec<usize>,
    /// What one takes.
    pub(in crate::cli) needs: Needs,
}

impl Array<'_> {
    /// The command of a shard for a POSIX shell, `shard` being its number there, run by `program`. What it takes was said when it
    /// was divided.
    fn command(&self, program: &str, shard: &str) -> String {
        let given = self.command.get(1..).unwrap_or_default();
        let (given, own) = given.split_at(given.len().saturating_sub(self.own));
        let own = own.iter().map(String::as_str);
        let mut words = vec![quoted(program)];
        for word in given {
            if !["--yes", "--quiet"].contains(&word.as_str()) {
                words.push(quoted(word));
            }
            // Behind the command's name: what is behind a kernel is the kernel's.
            if word == self.verb {
                words.push(format!(
                    "--shard {shard}/{} {}",
                    self.shards, self.needs.words
                ));
            }
        }
        words.extend(own.map(quoted));
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
        (self.needs.bytes / f64::from(1 << 20) + OWN).ceil() as u64
    }
}

/// This program, where every machine that sees the same files finds it.
fn this_program() -> String {
    let path = std::env::current_exe();
    path.map_or_else(|_| "volver".into(), |path| path.display().to_string())
}

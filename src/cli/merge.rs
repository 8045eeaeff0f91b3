//! `volver merge`: what the shards of a study have finished, as one machine writes it.

use super::output::{noun, said};
use super::study::SCRIPT;
use super::study::results::{self, Forms, JOURNAL};
use super::{Failure, Outcome, waiting, write_out};
use clap::Args;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write as _};
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};
use volver::document::About;
use volver::study::shards::{Divisible, Division, Gathered, Trouble};
use volver::study::sweep::Divided;

/// How often --watch looks.
const PAUSE: Duration = Duration::from_secs(2);

const EXAMPLES: &str = "\
DIR is where 'volver study --shard' or '--on' keeps the files of shards. Where every
unit is there, DIR gets the files that one machine writes, byte for byte. Otherwise
what is missing is listed by shards to run again, nothing is written, and the exit code is 1.

Units count once, whichever file has them: those of runs that were killed too. A line
that is not as it was written counts for nothing; a unit that came out differently in two
runs is refused until one of the two files is gone.

Work: to read the shards' files, once more where a unit is taken.

Examples:
  volver study --cases sine-squared --levels 8..64 --out sharded --shard 1/2 --quiet
  volver study --cases sine-squared --levels 8..64 --out sharded --shard 2/2 --quiet
  volver merge sharded --quiet";

/// Join the shards of a study, or list what is missing
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Merge {
    /// The directory of the shards
    #[arg(value_name = "DIR")]
    directory: PathBuf,
    /// Show what is done until all is, then join
    #[arg(long)]
    watch: bool,
    #[command(flatten)]
    forms: Forms,
}

impl Merge {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let division: Division<Divided> = Division::open(&self.directory).map_err(said)?;
        let output = self.forms.output(Some(&self.directory));
        output.check()?;
        let gathered = if self.watch {
            self.watch(&division)?
        } else {
            waiting("reading", || Gathered::new(&self.directory, &division)).map_err(said)?
        };
        let differs = |trouble: &&Trouble| matches!(trouble, Trouble::Differs { .. });
        if let Some(trouble) = gathered.troubles.iter().find(differs) {
            return Err(Failure::Usage(format!(
                "{trouble} (allowed: one of the two, the other moved away)"
            )));
        }
        let Some(units) = division.work.units(&gathered) else {
            write_out(&self.missing(&division, &gathered))?;
            return Ok(Outcome::CheckFailed);
        };
        let units = units.map_err(said)?;
        let journal = self.directory.join(JOURNAL);
        division
            .work
            .write_journal(&journal, &units)
            .map_err(said)?;
        let about = About::new(&division.command);
        results::hand_out(division.work, units, &about, &output)
    }

    /// What is missing, and how it is run.
    fn missing(&self, division: &Division<Divided>, gathered: &Gathered) -> String {
        let keys = division.work.keys();
        let missing = (0..).zip(&keys).filter(|(_, key)| !gathered.has(**key));
        let missing: Vec<usize> = missing.map(|(unit, _)| unit).collect();
        let shards: BTreeSet<usize> = missing
            .iter()
            .map(|unit| division.shard_of(*unit))
            .collect();
        let list: Vec<String> = shards.iter().map(ToString::to_string).collect();
        let list = list.join(",");
        let mut text = String::new();
        // Writing to a String does not fail.
        for trouble in &gathered.troubles {
            let _ = writeln!(text, "{trouble}");
        }
        let _ = writeln!(
            text,
            "{} of {} missing, of {} {list} of {}, the first {}",
            missing.len(),
            noun(keys.len(), "unit", "units"),
            if shards.len() == 1 { "shard" } else { "shards" },
            division.shards(),
            missing
                .first()
                .map(|unit| division.work.name(*unit))
                .unwrap_or_default(),
        );
        let script = self.directory.join(SCRIPT);
        if script.exists() {
            let _ = writeln!(text, "again: sbatch --array={list} {}", script.display());
        } else {
            let _ = writeln!(
                text,
                "again: the command that made them, with --on ENGINE --shards {} --only {list}",
                division.shards()
            );
        }
        text
    }

    /// Looks until every unit is there.
    fn watch(&self, division: &Division<Divided>) -> Result<Gathered, Failure> {
        let keys = division.work.keys();
        let begun = Instant::now();
        let mut first = None;
        let mut shown = String::new();
        loop {
            let gathered = Gathered::new(&self.directory, division).map_err(said)?;
            let cost_of = |is_done: bool| -> f64 {
                let units = keys.iter().zip(&division.costs);
                let units = units.filter(|(key, _)| gathered.has(**key) == is_done);
                units.map(|(_, cost)| cost).sum()
            };
            let (done, left) = (cost_of(true), cost_of(false));
            let since = begun.elapsed().as_secs_f64();
            let before = *first.get_or_insert(done);
            let whole = gathered.parts.iter().filter(|part| part.is_whole).count();
            let line = format!(
                "{} of {}, {whole} of {} whole{}",
                gathered.len(),
                noun(keys.len(), "unit", "units"),
                noun(division.shards(), "shard", "shards"),
                match since * left / (done - before) {
                    seconds if seconds.is_finite() && left > 0.0 =>
                        format!(", about {seconds:.0} s left"),
                    _ => String::new(),
                }
            );
            if line != shown && !self.forms.quiet {
                let mut err = io::stderr().lock();
                // Nobody is left to tell where standard error is closed.
                let _ = if err.is_terminal() {
                    write!(err, "\r\x1b[K{line}")
                } else {
                    writeln!(err, "{line}")
                };
                shown = line;
            }
            if gathered.len() == keys.len() {
                if io::stderr().is_terminal() && !self.forms.quiet {
                    let _ = writeln!(io::stderr());
                }
                return Ok(gathered);
            }
            thread::sleep(PAUSE);
        }
    }
}

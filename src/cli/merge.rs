//! `volver merge`: what shards have finished, as one machine writes it.

use super::output::{noun, said};
use super::shards::SCRIPT;
use super::study::results::{self, Forms, JOURNAL};
use super::{Arguments, Command, Failure, Outcome, waiting, write_out};
use clap::{Args, Parser};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write as _};
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};
use volver::document::About;
use volver::study::shards::{Divisible, Division, Gathered, Trouble, kind_in};
use volver::study::sweep::Divided;
use volver::study::verify::apart::{self, Entry};

/// How often --watch looks.
const PAUSE: Duration = Duration::from_secs(2);

const EXAMPLES: &str = "\
DIR is where --shard or --on of 'volver study' or 'volver verify' keeps the files of
shards. Where every unit is there, DIR gets the files that one machine writes, byte for
byte. Otherwise what is missing is listed by shards to run again, nothing is written, and
the exit code is 1.

Units count once, whichever file has them: those of runs that were killed too. A line
that is not as it was written counts for nothing; a unit that came out differently in two
runs is refused until one of the two files is gone. A verification is judged here, by the
answers that shards have kept: no kernel is run.

Work: to read the shards' files, once more where a unit is taken.

Examples:
  volver study --cases sine-squared --levels 8..64 --out sharded --shard 1/2 --quiet
  volver study --cases sine-squared --levels 8..64 --out sharded --shard 2/2 --quiet
  volver merge sharded --quiet";

/// Join the shards of a study or a verification, or list what is missing
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
        match kind_in(&self.directory) {
            Some(kind) if kind == apart::Divided::KIND => self.verification(),
            // What there is none of is said as of a study.
            Some(_) | None => self.study(),
        }
    }

    fn study(&self) -> Result<Outcome, Failure> {
        let division: Division<Divided> = Division::open(&self.directory).map_err(said)?;
        let output = self.forms.output(Some(&self.directory));
        output.check()?;
        let Some(gathered) = self.gathered(&division)? else {
            return Ok(Outcome::CheckFailed);
        };
        let units = division.work.units(&gathered);
        // All are there.
        let units = units.unwrap_or_else(|| Ok(Vec::new())).map_err(said)?;
        let journal = self.directory.join(JOURNAL);
        let written = division.work.write_journal(&journal, &units);
        written.map_err(said)?;
        let about = About::new(&division.command);
        results::hand_out(division.work, units, &about, &output)
    }

    fn verification(&self) -> Result<Outcome, Failure> {
        let division: Division<apart::Divided> = Division::open(&self.directory).map_err(said)?;
        if self.forms.csv.is_some() {
            return Err(Failure::Usage(
                "--csv of a verification (allowed: --json, or what it was asked for)".into(),
            ));
        }
        let Some(gathered) = self.gathered(&division)? else {
            return Ok(Outcome::CheckFailed);
        };
        let mut entries = Vec::new();
        for key in division.work.keys() {
            let text = gathered.unit(key).transpose().map_err(said)?;
            let read = serde_json::from_str::<Vec<Entry>>(&text.unwrap_or_default());
            entries.extend(read.map_err(|error| {
                said(format!(
                    "{}: answers that cannot be read: {error} (allowed: as 'volver verify --shard' writes them)",
                    self.directory.display()
                ))
            })?);
        }
        let words = division.command.iter();
        match Arguments::try_parse_from(words)?.command {
            Command::Verify(verify) => {
                verify.join(&division, entries, &self.directory, &self.forms)
            }
            _ => Err(said(format!(
                "{}: its command is none of 'volver verify' (allowed: a directory that this wrote)",
                self.directory.display()
            ))),
        }
    }

    /// All units; `None` where some are missing, which are listed then.
    fn gathered<W: Divisible>(&self, division: &Division<W>) -> Result<Option<Gathered>, Failure> {
        let gathered = if self.watch {
            self.watch(division)?
        } else {
            waiting("reading", || Gathered::new(&self.directory, division)).map_err(said)?
        };
        let differs = |trouble: &&Trouble| matches!(trouble, Trouble::Differs { .. });
        if let Some(trouble) = gathered.troubles.iter().find(differs) {
            return Err(Failure::Usage(format!(
                "{trouble} (allowed: one of the two, the other moved away)"
            )));
        }
        let is_whole = division.work.keys().iter().all(|key| gathered.has(*key));
        if !is_whole {
            write_out(&self.missing(division, &gathered))?;
        }
        Ok(is_whole.then_some(gathered))
    }

    /// What is missing, and how it is run.
    fn missing<W: Divisible>(&self, division: &Division<W>, gathered: &Gathered) -> String {
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
    fn watch<W: Divisible>(&self, division: &Division<W>) -> Result<Gathered, Failure> {
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

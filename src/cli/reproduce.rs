//! `volver reproduce`: the paper's tables, measured again.

mod nonsmooth;

use super::about::about;
use super::budget::{Budget, HOUR, WORK};
use super::output::Output;
use super::{Bar, Color, Failure, Outcome};
use clap::Args;
use std::collections::HashSet;
use std::path::PathBuf;
use std::str::FromStr;
use volver::convergence::Ladder;
use volver::real::FormatName;
use volver::report::reproduce::{document, json, write};
use volver::study::reproduce::{
    Entry, LADDER, ORACLE_BITS, RuleName, Settings, TableNumber, bytes, reproduce, seconds, work,
};

/// All methods of a table keep their nodes: about a kilobyte a segment.
const FINEST: u64 = 1 << 20;

const EXAMPLES: &str = "\
For every entry: the paper's figure, the paper's protocol in binary64 (least
squares over n = 8 … 1024), the asymptotic order in the format asked for with
its interval, a verdict, and one line wherever paper and order differ. Monte
Carlo always runs 64 replicas in binary64 on n = 8 … 1024; its order is that of
the standard deviation. In JSON an order that cannot be given is null. The exit
code is 1 where a measurement contradicts theory.

RULE is riemann, trapezoid, simpson, boole (outer), gauss-3, monte-carlo,
monte-carlo-independent or monte-carlo-stratified (inner).
LADDER is a number of segments n (16), a range by doubling (8..4096) or by another
ratio (9..5000x3), or a list (12,24,48,96). Table 1 has Boole's rule, which needs
multiples of 4.

Examples:
  volver reproduce --table 2 --levels 8..1024
  volver reproduce --table 1 --format f32 --format mpfr:256 --levels 8..512
  volver reproduce --inner simpson --outer boole --levels 8..16384
  volver reproduce --table 1 --levels 8..256 --json -
  volver reproduce --nonsmooth";

/// Measure the paper's Tables 1 and 2 again
#[derive(Args)]
#[command(after_help = format!("{WORK}\n\n{EXAMPLES}"))]
pub(crate) struct Reproduce {
    /// Only this table: 1 or 2
    #[arg(long = "table", value_name = "TABLE", value_parser = TableNumber::from_str)]
    tables: Vec<TableNumber>,
    /// Only rows of Table 1 with this inner rule, repeatable
    #[arg(long, value_name = "RULE", value_parser = RuleName::inner)]
    inner: Vec<RuleName>,
    /// Only columns of Table 1 with this outer rule, repeatable
    #[arg(long, value_name = "RULE", value_parser = RuleName::outer)]
    outer: Vec<RuleName>,
    /// Format that orders are measured in, repeatable: f16, bf16, f32, f64, tf32, fp8-e4m3,
    /// fp8-e5m2, ieee:BITS,EMIN,EMAX, fixed:FRACTION, fixed:INTEGER.FRACTION or
    /// mpfr:BITS [default: mpfr:128]
    #[arg(long = "format", value_name = "FORMAT", value_parser = FormatName::from_str)]
    formats: Vec<FormatName>,
    /// Numbers of segments that orders are measured on [default: 8..4096]
    #[arg(long, value_name = "LADDER", value_parser = Ladder::from_str)]
    levels: Option<Ladder>,
    /// Instead of the tables: what jumps and kinks cost, rule by rule, beside theory
    #[arg(long, conflicts_with_all = ["tables", "inner", "outer", "formats", "levels", "seed"])]
    nonsmooth: bool,
    /// Seed of the first Monte Carlo replica
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Run even if it takes more than 2 GiB of memory or 1 h
    #[arg(long)]
    yes: bool,
    /// Write all of it as one JSON document; - is standard output, without tables
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the report, as a page, Markdown and JSON with SVG plots, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no tables
    #[arg(long)]
    quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

impl Reproduce {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        if self.nonsmooth {
            self.output().check()?;
            return self.nonsmooth();
        }
        let settings = self.settings()?;
        settings
            .check()
            .map_err(|error| Failure::Usage(format!("--levels: {error}")))?;
        let budget = Budget {
            what: "the reproduction",
            bytes: bytes(&settings),
            seconds: seconds(&settings),
            usual: HOUR,
        };
        budget.check(self.yes)?;
        self.output().check()?;
        let bar = Bar::new(work(&settings));
        let entries = reproduce(&settings, &bar);
        bar.finish();
        let entries = entries.map_err(|error| Failure::Usage(error.to_string()))?;
        self.output().hand_out(
            &document(&settings, &entries, &about()),
            |directory| write(directory, &settings, &entries, &about()),
            |_| json(&settings, &entries),
        )?;
        Ok(if entries.iter().any(Entry::contradicts_theory) {
            Outcome::CheckFailed
        } else {
            Outcome::Good
        })
    }

    fn settings(&self) -> Result<Settings, Failure> {
        let ladder = match &self.levels {
            None => LADDER.to_vec(),
            Some(ladder) => ladder
                .as_segments()
                .ok_or_else(|| {
                    Failure::Usage(format!(
                        "--levels: '{ladder}' is a ladder of steps (allowed: numbers of segments)"
                    ))
                })?
                .to_vec(),
        };
        if let Some(n) = ladder.iter().find(|&&n| n > FINEST) {
            return Err(Failure::Usage(format!(
                "--levels: n = {n} segments take more memory than is reasonable (allowed: up to {FINEST})"
            )));
        }
        Ok(Settings {
            tables: self.chosen_tables()?,
            inner: self.inner.clone(),
            outer: self.outer.clone(),
            formats: if self.formats.is_empty() {
                vec![FormatName::Mpfr(ORACLE_BITS)]
            } else {
                let mut formats = self.formats.clone();
                let mut seen = HashSet::new();
                formats.retain(|&format| seen.insert(format));
                formats
            },
            ladder,
            seed: self.seed,
        })
    }

    /// Rules belong to Table 1: they choose it, and nothing else goes with them.
    fn chosen_tables(&self) -> Result<Vec<TableNumber>, Failure> {
        let with_rules = !self.inner.is_empty() || !self.outer.is_empty();
        match &self.tables[..] {
            [] if with_rules => Ok(vec![TableNumber::One]),
            [] => Ok(vec![TableNumber::One, TableNumber::Two]),
            tables if with_rules && tables.contains(&TableNumber::Two) => Err(Failure::Usage(
                "--inner and --outer choose rules of Table 1, not of '--table 2' (allowed: --table 1)"
                    .into(),
            )),
            tables => Ok(tables.to_vec()),
        }
    }

    /// Where reports go to.
    pub(super) fn output(&self) -> Output<'_> {
        Output {
            out: self.out.as_deref(),
            files: vec![("--json", self.json.as_deref())],
            quiet: self.quiet,
            color: self.color,
        }
    }
}

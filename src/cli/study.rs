//! `volver study`: cases × methods × formats × levels, every error split into parts or known as a whole.

pub(super) mod asked;
pub(super) mod cases;
mod errors;
pub(super) mod formats;
pub(super) mod levels;
pub(super) mod methods;
pub(super) mod results;
mod shard;

use super::about::about;
use super::budget::{Budget, HOUR, WORK};
use super::output::said;
use super::shards::Sharding;
use super::{Bar, Failure, Outcome, waiting};
use asked::Asking;
use clap::Args;
use formats::Formats;
pub(super) use formats::names as format_names;
use results::Forms;
use std::path::PathBuf;
use std::thread;
use volver::render;
use volver::study::Progress;
use volver::study::sweep::{Divided, Estimate, Header, Journal, Keep, Sweep, Unit, run};

const EXAMPLES: &str = "\
Every error of every method on every case in every format at every n is split into
discretization, input rounding and arithmetic rounding, which are fitted each:
docs/study.md says how. FILE is a study.toml, with the keys cases, methods,
formats, levels, sweep-bits and errors ('volver schema study'); options go before it.

With --errors total errors are known as a whole alone, with orders and verdicts on them,
at a small part of the time and memory: nothing is replayed, and rays of many segments
are gone along without keeping them. What tells of roundoff by itself is left out.

CASES are names that 'volver cases' lists, NAME/CHANNEL, @TAG for all cases with a
tag, or paths of case files; every channel is a case of its own. METHODS are nested
rules, INNER/OUTER[/EXPONENTIAL], of riemann-left, riemann-right, midpoint,
trapezoid, simpson, boole and gauss-POINTS; ORDER/POSITION/OPACITY, such as
front-to-back/middle/expm1/neumaier, back-to-front/front/subtraction or
tree/middle/relative; and preintegrated/COLOR/OPACITY, such as
preintegrated/linear/linear: docs/study.md has them all. FORMATS are f16, bf16, f32, f64, f32-lanes, f64-lanes, tf32, fp8-e4m3, fp8-e5m2,
ieee:BITS,EMIN,EMAX, fixed:INTEGER.FRACTION or mpfr:BITS. Lists are separated by
commas, blanks or semicolons; options may be repeated.

The exit code is 1 where a discretization error contradicts theory, or with --errors
total the order of the whole error above the floor of rounding.

Examples:
  volver study --cases sine-squared --methods trapezoid/trapezoid,simpson/simpson --levels 8..512
  volver study --cases sine-squared --formats f32,ieee:11,-14,15 --levels 8..128 --csv -
  volver study --cases rgb-transfer/red --methods gauss-2/simpson --levels 8..128 --json -
  volver study --cases sine-squared --errors total --levels 8..65536
  volver study --cases sine-squared --formats f32 --levels 8..64 --sweep-bits 8..24 --quiet";

/// Split errors into discretization and roundoff, for cases × methods × formats × levels
#[derive(Args)]
#[command(after_help = format!("{WORK}\n\n{EXAMPLES}"))]
pub(crate) struct Study {
    /// What to run: a study.toml
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Cases, repeatable
    #[arg(long, value_name = "CASES")]
    cases: Vec<String>,
    /// Methods, repeatable [default: riemann-left/riemann-left, trapezoid/trapezoid,
    /// simpson/simpson, front-to-back/middle/subtraction]
    #[arg(long, value_name = "METHODS")]
    methods: Vec<String>,
    /// Formats, repeatable [default: f32, f64]
    #[arg(long, value_name = "FORMATS")]
    formats: Vec<String>,
    /// Numbers of segments: 8..4096 by doubling, 9..5000x3, 12,24,48 or 16 alone
    /// [default: 8..4096]
    #[arg(long, value_name = "LADDER")]
    levels: Option<String>,
    /// Map correct digits over n and the bits of mpfr:A to mpfr:B
    #[arg(long, value_name = "A..B")]
    sweep_bits: Option<String>,
    /// Errors split into parts, or as a whole: split or total [default: split]
    #[arg(long, value_name = "WHICH")]
    errors: Option<String>,
    /// Keep results, a page, tables and plots in a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Go on with the results in the directory
    #[arg(long, requires = "out")]
    resume: bool,
    #[command(flatten)]
    sharding: Sharding,
    /// Threads to run on [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Run even if it takes more than 2 GiB of memory or 1 h
    #[arg(long)]
    yes: bool,
    #[command(flatten)]
    forms: Forms,
}

impl Study {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let threads = self.threads();
        // Cases are read side by side, and so may the levels of a unit be.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build_global().map_err(said)?;
        let asking = Asking::new(self.file.as_deref())?;
        let Formats {
            names: formats,
            swept,
            bits,
        } = formats::chosen(&asking, &self.formats, self.sweep_bits.as_deref())?;
        let methods = methods::chosen(&asking, &self.methods)?;
        let levels = levels::chosen(&asking, self.levels.as_deref())?;
        let errors = errors::chosen(&asking, self.errors.as_deref())?;
        let sweep = Sweep {
            errors,
            cases: waiting("deriving", || cases::chosen(&asking, &self.cases))?,
            methods,
            formats,
            levels,
        };
        let estimate = Estimate::new(&sweep, threads);
        let work = Divided::new(Header::new(&sweep), bits, swept);
        if self.sharding.is_asked() {
            return self.in_shards(&sweep, work, threads, &estimate);
        }
        let budget = Budget {
            what: "the study",
            bytes: estimate.bytes,
            seconds: estimate.seconds(threads),
            usual: HOUR,
        };
        budget.check(self.yes)?;
        self.forms.output(self.out.as_deref()).check()?;
        budget.announce();
        let units = self.units(&sweep, &work.header, threads, &estimate)?;
        results::hand_out(
            work,
            units,
            &about(),
            &self.forms.output(self.out.as_deref()),
        )
    }

    fn threads(&self) -> usize {
        let all = || thread::available_parallelism().map_or(1, usize::from);
        self.threads.map_or_else(all, usize::from)
    }

    /// Runs what is not in the journal yet; the finished units, in their order.
    fn units(
        &self,
        sweep: &Sweep,
        header: &Header,
        threads: usize,
        estimate: &Estimate,
    ) -> Result<Vec<Unit>, Failure> {
        let mut journal = match &self.out {
            Some(directory) => {
                render::make_directory(directory)?;
                let path = directory.join(results::JOURNAL);
                let journal = if self.resume {
                    Journal::resume(&path, header)
                } else {
                    Journal::begin(&path, header)
                };
                journal.map_err(said)?
            }
            None => Journal::unkept(),
        };
        let bar = Bar::new(estimate.work_units());
        let left = journal.left(sweep);
        let left = left.iter().map(|block| block.work(sweep));
        let left = left.fold(0, u64::saturating_add);
        bar.skip(estimate.work_units().saturating_sub(left));
        let ran = run(sweep, &mut journal, threads, &bar as &dyn Progress);
        bar.finish();
        ran.map_err(said)?;
        journal.finish(header).map_err(said)
    }
}

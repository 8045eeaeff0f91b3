//! `volver tradeoff`: error against cost, and the cheapest way to an error.

use super::about::about;
use super::budget::{Budget, HOUR, WORK};
use super::output::{Output, csv, said};
use super::study::{asked::Asking, cases, formats, levels, methods};
use super::{Bar, Color, Failure, Outcome, waiting};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::thread;
use volver::render;
use volver::report::tradeoff;
use volver::study::sweep::{Errors, Header, Sweep};
use volver::study::tradeoff::{
    Cost, Journal, Pin, Results, Settings, bytes, default_formats, default_methods, estimate, run,
    seconds,
};

/// Where finished units are kept.
const JOURNAL: &str = "tradeoff.jsonl";

/// Where nobody says: from one segment on.
const LEVELS: &str = "1..4096";

const EXAMPLES: &str = "\
Every method runs in every format at every n on every case. Of each run there is the
error, relative to |I| where I is not 0; the work, counted; and with --cost modelled
or measured also the time. The table says how an error of 1e-2, 1e-3, … 1e-30 is had
for the least cost, and what the usual choice would take for the same: left Riemann
sums with opacity 1 - exp(-tau d) in f32. docs/tradeoff.md says how costs are found.

--cost evaluations and --cost operations give the same bytes on every machine and
every run; nothing is timed then. Cases, methods, formats and levels are named as
for 'volver study'.

Examples:
  volver tradeoff --cases sine-squared --levels 1..256 --cost evaluations
  volver tradeoff --cases homogeneous --formats f32,f64 --levels 1..64
  volver tradeoff --cases rgb-transfer/red --methods simpson/simpson --formats f64 --levels 4..64 --cost operations --csv -";

/// Find the cheapest method, format and n for an error: error against cost
#[derive(Args)]
#[command(after_help = format!("{WORK}\n\n{EXAMPLES}"))]
pub(crate) struct Tradeoff {
    /// Cases, repeatable
    #[arg(long, value_name = "CASES", required = true)]
    cases: Vec<String>,
    /// Methods, repeatable [default: 40 of all families]
    #[arg(long, value_name = "METHODS")]
    methods: Vec<String>,
    /// Formats, repeatable [default: f32, f64, mpfr:113, mpfr:160]
    #[arg(long, value_name = "FORMATS")]
    formats: Vec<String>,
    /// Numbers of segments: 1..4096 by doubling, 9..5000x3, 12,24,48 or 16 alone
    /// [default: 1..4096]
    #[arg(long, value_name = "LADDER")]
    levels: Option<String>,
    /// By which cost methods are compared
    #[arg(long, value_enum, default_value = "modelled", value_name = "COST")]
    cost: By,
    /// Keep results, tables and plots in a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads to run on, but for measurements: those have one [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Run even if it takes more than 2 GiB of memory or 1 h
    #[arg(long)]
    yes: bool,
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all runs as CSV; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the table for LaTeX; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    latex: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the headings
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

/// [`Cost`], on a command line.
#[derive(Clone, Copy, ValueEnum)]
enum By {
    /// Evaluations of the medium
    Evaluations,
    /// Operations and functions
    Operations,
    /// Time, from counts and a calibration of this machine
    Modelled,
    /// Time, measured
    Measured,
}

impl From<By> for Cost {
    fn from(by: By) -> Cost {
        match by {
            By::Evaluations => Cost::Evaluations,
            By::Operations => Cost::Operations,
            By::Modelled => Cost::Modelled,
            By::Measured => Cost::Measured,
        }
    }
}

impl Tradeoff {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        self.output().check()?;
        let all = || thread::available_parallelism().map_or(1, usize::from);
        let threads = self.threads.map_or_else(all, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build_global().map_err(said)?;
        let cost = Cost::from(self.cost);
        let settings = Settings {
            sweep: self.sweep()?,
            timed: cost.is_timed(),
        };
        let budget = Budget {
            what: "the comparison",
            bytes: bytes(&settings, threads),
            seconds: seconds(&settings, threads),
            usual: HOUR,
        };
        budget.check(self.yes)?;
        let header = Header::new(&settings.sweep);
        let mut journal = match &self.out {
            Some(directory) => {
                render::make_directory(directory)?;
                let path = directory.join(JOURNAL);
                Some(Journal::begin(&path, &header).map_err(said)?)
            }
            None => None,
        };
        let pin = cost.is_timed().then(Pin::here);
        let bar = Bar::new(estimate(&settings));
        let units = run(&settings, &bar, |unit| match &mut journal {
            Some(journal) => journal.append(unit),
            None => Ok(()),
        });
        bar.finish();
        let pinned = pin.as_ref().map(Pin::is_pinned);
        drop(pin);
        let results = Results::new(header, cost, pinned, units.map_err(said)?);
        self.hand_out(&results)?;
        Ok(Outcome::Good)
    }

    fn sweep(&self) -> Result<Sweep, Failure> {
        let asking = Asking::new(None)?;
        let methods = if self.methods.is_empty() {
            default_methods()
        } else {
            methods::chosen(&asking, &self.methods)?
        };
        let formats = if self.formats.is_empty() {
            default_formats()
        } else {
            formats::chosen(&asking, &self.formats, None)?.names
        };
        let levels = self.levels.as_deref().unwrap_or(LEVELS);
        Ok(Sweep {
            // What a journal of studies says of errors says nothing of this one.
            errors: Errors::default(),
            methods,
            formats,
            levels: levels::chosen(&asking, Some(levels))?,
            cases: waiting("deriving", || cases::chosen(&asking, &self.cases))?,
        })
    }

    fn hand_out(&self, results: &Results) -> Result<(), Failure> {
        let document = tradeoff::document(results, &about());
        self.output().hand_out(
            &document,
            |directory| {
                let mut files = tradeoff::write(directory, results, &about())?;
                files.push(directory.join(JOURNAL));
                Ok(files)
            },
            |option| match option {
                "--csv" => csv(&document),
                "--latex" => Ok(render::latex(&document)),
                _ => tradeoff::json(results),
            },
        )
    }

    /// Where reports go to.
    fn output(&self) -> Output<'_> {
        Output {
            out: self.out.as_deref(),
            files: vec![
                ("--json", self.json.as_deref()),
                ("--csv", self.csv.as_deref()),
                ("--latex", self.latex.as_deref()),
            ],
            quiet: self.quiet,
            color: self.color,
        }
    }
}

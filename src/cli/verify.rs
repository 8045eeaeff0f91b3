//! `volver verify`: a kernel put to the test.

use super::kernel::{KERNELS, KernelArguments, subjects};
use super::{Bar, Color, Failure, Outcome, width, write_out};
use clap::{Args, ValueEnum};
use rug::Rational;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use volver::convergence::{Ladder, MIN_REPLICAS};
use volver::kernel::{Kernel, Subject};
use volver::report::{self, verify as shown};
use volver::study::verify::{
    Axis, Baseline, Conclusion, Line, REPLICAS, Settings, Verification, verify,
};
use volver::symbolic::parse_number;

const EXAMPLES: &str = "\
The exit code is 0 where orders are confirmed, nothing contradicts and the values are
those of the method that the kernel declares; 1 where not; 2 where it could not run.

CASES are names that 'volver cases' lists, NAME/CHANNEL, tags, or paths of case files.
LADDER is as for 'volver reproduce'. ORDER is a number, 2 or 3/2.

Examples:
  volver verify method:front-to-back/middle/expm1@f32
  volver verify --cases sine-squared,thick method:trapezoid/trapezoid
  volver verify --uneven --cases polynomial method:tree/front/expm1 --json -";

/// Put a renderer's kernel to the test
#[derive(Args)]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
#[allow(clippy::doc_markdown)] // Help is no Markdown.
pub(crate) struct Verify {
    #[command(flatten)]
    kernel: KernelArguments,
    /// Only these cases, by commas, repeatable [default: the whole catalogue]
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
    cases: Vec<String>,
    /// Numbers of segments [default: 8..1024]
    #[arg(long, value_name = "LADDER", alias = "levels", value_parser = Ladder::from_str)]
    ladder: Option<Ladder>,
    /// What is refined: the step along the ray, or the grid of the volume
    #[arg(long, value_enum, default_value = "step", value_name = "AXIS")]
    axis: RefinedAxis,
    /// Steps that divide no ray: 7/8 of D/n
    #[arg(long)]
    uneven: bool,
    /// The order to expect, in place of what the kernel declares
    #[arg(long, value_name = "ORDER", value_parser = order)]
    expect: Option<Rational>,
    /// Seeds a level, for kernels that draw random numbers [default: 30]
    #[arg(long, value_name = "N", value_parser = replicas)]
    replicas: Option<usize>,
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write JUnit XML, which CI servers show
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the report, as Markdown, JSON and JUnit XML with SVG plots, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Keep what came out, for 'volver check'
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

/// What is refined.
#[derive(Clone, Copy, ValueEnum)]
enum RefinedAxis {
    Step,
    Grid,
}

fn order(text: &str) -> Result<Rational, String> {
    let order = parse_number(text).ok();
    order
        .filter(|order| *order > 0 && *order <= 100)
        .ok_or_else(|| "allowed: a number above 0 and up to 100, such as 2, 1.5 or 3/2".into())
}

fn replicas(text: &str) -> Result<usize, String> {
    let count: Option<usize> = text.parse().ok();
    count
        .filter(|count| (MIN_REPLICAS..=10_000).contains(count))
        .ok_or_else(|| format!("allowed: {MIN_REPLICAS} to 10000"))
}

/// A ladder as settings, or why not.
pub(super) fn settings(ladder: Option<&Ladder>) -> Result<Settings, Failure> {
    let settings = match ladder {
        None => Settings::standard(),
        Some(ladder) => Settings::new(ladder),
    };
    settings.map_err(|error| Failure::Usage(format!("--ladder: {error}")))
}

impl Verify {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let mut settings = settings(self.ladder.as_ref())?;
        settings.axis = match self.axis {
            RefinedAxis::Step => Axis::Step,
            RefinedAxis::Grid => Axis::Grid,
        };
        settings.uneven = self.uneven;
        settings.expect.clone_from(&self.expect);
        settings.replicas = self.replicas.unwrap_or(REPLICAS);
        let subjects = subjects(&self.cases)?;
        if let Some(directory) = &self.out {
            report::prepare_directory(directory)?;
        }
        let files = [&self.json, &self.junit, &self.save];
        for file in files.into_iter().flatten().filter(|file| !is_dash(file)) {
            report::check_file(file)?;
        }
        let mut kernel = self.kernel.start()?;
        let table = Table {
            printed: !self.quiet && !self.json.as_deref().is_some_and(is_dash),
            color: self.color.is_on(),
        };
        let verification = table.run(kernel.as_mut(), &subjects, &settings, &self.kernel)?;
        // The child is gone before the last word.
        drop(kernel);
        self.hand_out(&verification)?;
        outcome(&verification, &self.kernel)
    }

    fn hand_out(&self, verification: &Verification) -> Result<(), Failure> {
        if let Some(directory) = &self.out {
            shown::write(directory, verification)?;
        }
        if let Some(file) = &self.save {
            let baseline = Baseline::new(verification, &self.cases);
            let json = baseline.to_json().map_err(|e| Failure::Output(e.into()))?;
            report::write_file(file, &json)?;
        }
        let json = match &self.json {
            Some(file) => Some((file, shown::json(verification)?)),
            None => None,
        };
        let junit = self
            .junit
            .as_ref()
            .map(|file| (file, shown::junit(verification)));
        for (file, text) in json.into_iter().chain(junit) {
            if is_dash(file) {
                write_out(&text)?;
            } else {
                report::write_file(file, &text)?;
            }
        }
        Ok(())
    }
}

/// Where rows go as they come.
pub(super) struct Table {
    pub(super) printed: bool,
    pub(super) color: bool,
}

impl Table {
    /// Runs the kernel, a row a channel.
    pub(super) fn run(
        &self,
        kernel: &mut dyn Kernel,
        subjects: &[Subject],
        settings: &Settings,
        named: &KernelArguments,
    ) -> Result<Verification, Failure> {
        let mut failed = None;
        let mut print = |text: &str| {
            if self.printed && failed.is_none() {
                failed = write_out(text).err();
            }
        };
        print(&shown::heading(self.color));
        let work = settings.work(subjects, kernel.declaration());
        let bar = Bar::new(work);
        let (width, color) = (width(), self.color);
        let mut row = |line: &Line| bar.above(|| print(&shown::row(line, width, color)));
        let verification = verify(kernel, subjects, settings, &bar, &mut row);
        bar.finish();
        let verification = verification.map_err(|error| named.failed(error))?;
        print(&shown::closing(&verification, width, color));
        match failed {
            Some(failure) => Err(failure),
            None => Ok(verification),
        }
    }
}

/// What the exit code says.
pub(super) fn outcome(
    verification: &Verification,
    named: &KernelArguments,
) -> Result<Outcome, Failure> {
    match verification.conclusion() {
        Conclusion::Confirmed => Ok(Outcome::Good),
        Conclusion::NotConfirmed => Ok(Outcome::CheckFailed),
        Conclusion::CouldNotRun => {
            let first = verification.lines.iter().flat_map(|line| &line.failures);
            let why = first.map(|failure| failure.error.to_string()).next();
            let why = why.unwrap_or_else(|| "no level was answered".into());
            Err(named.failed(anyhow::anyhow!(why)))
        }
    }
}

fn is_dash(file: &(impl AsRef<Path> + ?Sized)) -> bool {
    file.as_ref() == Path::new("-")
}

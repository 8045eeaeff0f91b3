//! `volver verify`: a kernel put to the test.

mod apart;

use super::about::about;
use super::kernel::{KERNELS, KernelArguments, subjects};
use super::output::{Output, is_dash};
use super::shards::Sharding;
use super::spacing::{Spaced, spacing};
use super::{Bar, CLOSED_PIPE, Color, Failure, Outcome, extremes, width, write_out};
use clap::{Args, ValueEnum};
use rug::Rational;
use std::path::PathBuf;
use std::str::FromStr;
use volver::convergence::Ladder;
use volver::document::About;
use volver::kernel::{Kernel, Subject, process};
use volver::render::terminal;
use volver::report::verify::{document, heading, json, junit, row, scattered_heading, write};
use volver::study::verify::{
    Accepted, Axis, Baseline, Conclusion, Identify, Line, REPLICAS, Settings, SettingsError, Steps,
    Verification, verify,
};

const EXAMPLES: &str = "\
The exit code is 0 where the order shows wherever methods of that order show theirs,
nothing contradicts, the values are those of the method that the kernel declares, and
the rule that it computes has no deviation but those of --accept; 1 where not; 2 where
it could not run. Opacity, optical and expected depth are tested where it answers them.

Work: cases × levels × seeds, at most 64 levels of 524288 segments, and as many rays again
for the rule; with --batch 2 K + 32 rays of up to 64 segments; a program has --timeout for each
answer. A bar on the terminal says how much is left.

With --shard or --on a slow kernel is asked on many machines; 'volver merge' joins.

CASES are names that 'volver cases' lists, NAME/CHANNEL, tags, or paths of case files.
LADDER is as for 'volver reproduce'. ORDER is 2, 1.5 or 3/2.

Examples:
  volver verify method:front-to-back/middle/expm1
  volver verify --cases sine-squared,thick method:trapezoid/trapezoid@f32
  volver verify --uneven --cases polynomial --json - method:tree/front/expm1
  volver verify --extremes method:front-to-back/middle/subtraction@f32
  volver verify --cases sine-squared --out apart --shard 1/2 method:tree/middle/expm1
  volver new python ray && volver verify --spacing log --cases sine-squared python3 ray/kernel.py
  volver new python mine && volver verify --cases sine-squared --batch 64 python3 mine/kernel.py";

/// Put a renderer's kernel to the test
#[derive(Args)]
#[command(override_usage = "volver verify [OPTIONS] <KERNEL> [ARGS]...")]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
#[allow(clippy::doc_markdown)] // Help is no Markdown.
#[allow(clippy::struct_excessive_bools)] // Each is an option of its own.
pub(crate) struct Verify {
    #[command(flatten)]
    kernel: KernelArguments,
    /// Only these cases, by commas, repeatable [default: the whole catalogue]
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
    cases: Vec<String>,
    /// Numbers of segments [default: 9,21,33,69,129,261,513,1029; of a grid 8..1024]
    #[arg(long, value_name = "LADDER", alias = "levels", value_parser = Ladder::from_str)]
    ladder: Option<Ladder>,
    /// What is refined: the step along the ray, or the grid of the volume
    #[arg(long, value_enum, default_value = "step", value_name = "AXIS")]
    axis: RefinedAxis,
    /// Steps that divide the ray, d = D/n [default: the last segment is 3/10 of the others]
    #[arg(long, conflicts_with = "uneven")]
    divide: bool,
    /// Steps of 7/8 D/n: the last segment is another part of the others at every level
    #[arg(long)]
    uneven: bool,
    /// Segments of many lengths: even, square, log, disparity, random:SEED
    #[arg(long, value_name = "HOW", value_parser = spacing, conflicts_with_all = ["divide", "uneven"])]
    spacing: Option<Spaced>,
    /// The order to expect, in place of what the kernel declares
    #[arg(long, value_name = "ORDER", value_parser = Settings::order, allow_negative_numbers = true)]
    expect: Option<Rational>,
    /// Seeds a level, for kernels that draw random numbers [default: 30]
    #[arg(long, value_name = "N", value_parser = replicas, allow_negative_numbers = true)]
    replicas: Option<usize>,
    /// Read off what the kernel computes: auto asks no more rays than the ladder has, full
    /// as many as 'volver identify'
    #[arg(long, value_enum, default_value = "auto", value_name = "HOW")]
    identify: Identification,
    /// Ask a program K rays of different length, step and n in one request: each has to have
    /// the answer that it has alone
    #[arg(long, value_name = "K", value_parser = batch, allow_negative_numbers = true)]
    batch: Option<usize>,
    /// Let a known deviation pass as long as it is that, repeatable: early-end=0.0039
    #[arg(long, value_name = "NAME[=VALUE]", value_parser = Accepted::from_str)]
    accept: Vec<Accepted>,
    /// In place of orders, digits where numbers end: thin and thick rays, vacuum, tau below 0,
    /// one segment
    #[arg(long, conflicts_with_all = [
        "cases", "ladder", "axis", "divide", "uneven", "spacing", "expect", "replicas", "identify",
        "accept", "batch", "junit", "save",
    ])]
    extremes: bool,
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write JUnit XML, which CI servers show; - as above
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the report, as a page, Markdown, JSON and JUnit XML with SVG plots, into a
    /// directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Keep what came out, for 'volver check'; - as above
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    #[command(flatten)]
    sharding: Sharding,
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

/// Whether it is read off what a kernel computes.
#[derive(Clone, Copy, ValueEnum)]
enum Identification {
    Auto,
    Full,
    Off,
}

fn replicas(text: &str) -> Result<usize, SettingsError> {
    Settings::replicas(text.parse().unwrap_or(0))
}

fn batch(text: &str) -> Result<usize, SettingsError> {
    Settings::batch(text.parse().unwrap_or(0))
}

/// A ladder as settings, or why not.
fn settings(ladder: Option<&Ladder>, axis: Axis) -> Result<Settings, Failure> {
    let settings = match ladder {
        None => Settings::standard(axis),
        Some(ladder) => Settings::new(ladder).map(|settings| Settings { axis, ..settings }),
    };
    let settings = settings.and_then(Settings::with_enough_levels);
    settings.map_err(|error| Failure::Usage(format!("--ladder: {error}")))
}

impl Verify {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let output = self.output();
        check_dashes(&output)?;
        self.sharding.refuse(&[
            ("--extremes", self.extremes),
            ("fd:", self.kernel.is_caller()),
        ])?;
        if self.extremes {
            return extremes::run(&self.kernel, &output);
        }
        let settings = self.settings()?;
        let at_once = self.kernel.at_once()?;
        let subjects = subjects(&self.cases, "--cases")?;
        output.check()?;
        let mut kernel = at_once.map_or_else(|| self.kernel.program(), Ok)?;
        if self.sharding.is_asked() {
            return self.in_shards(kernel.as_mut(), &subjects, &settings);
        }
        self.tested(kernel, &subjects, &settings, &output, &about())
    }

    /// How the kernel is tested.
    fn settings(&self) -> Result<Settings, Failure> {
        let axis = match self.axis {
            RefinedAxis::Step => Axis::Step,
            RefinedAxis::Grid => Axis::Grid,
        };
        let mut settings = settings(self.ladder.as_ref(), axis)?;
        settings.steps = match (self.spacing, self.divide, self.uneven) {
            (Some(Spaced(Some(_))), ..) if axis == Axis::Grid => {
                return Err(Failure::Usage(
                    "--spacing with --axis grid (allowed: with --axis step)".into(),
                ));
            }
            (Some(Spaced(Some(spacing))), ..) => Steps::Spaced(spacing),
            (_, true, _) => Steps::Divide,
            (_, _, true) => Steps::Uneven,
            (_, false, false) => Steps::PartLast,
        };
        settings.expect.clone_from(&self.expect);
        settings.replicas = self.replicas.unwrap_or(REPLICAS);
        settings.identify = match self.identify {
            Identification::Auto => Identify::Auto,
            Identification::Full => Identify::Full,
            Identification::Off => Identify::Off,
        };
        settings.accept.clone_from(&self.accept);
        settings.batch = self.batch;
        if self.batch.is_some() {
            self.kernel
                .only_program("--batch", "which has no requests")?;
        }
        Ok(settings)
    }

    /// Runs it and hands out what came of it.
    fn tested(
        &self,
        mut kernel: Box<dyn Kernel>,
        subjects: &[Subject],
        settings: &Settings,
        output: &Output<'_>,
        about: &About,
    ) -> Result<Outcome, Failure> {
        let alone = output.out.is_none() && output.files.iter().all(|(_, file)| file.is_none());
        let mut rows = Rows::new(output.prints_text(), alone, self.color);
        let verification = rows.run(kernel.as_mut(), subjects, settings, &self.kernel)?;
        // The child is gone before the last word.
        drop(kernel);
        output.hand_out(
            &document(&verification, about),
            |directory| write(directory, &verification, about),
            |option| match option {
                "--json" => json(&verification),
                "--junit" => Ok(junit(&verification)),
                _ => Ok(Baseline::new(&verification, &self.cases).to_json()?),
            },
        )?;
        rows.finish()?;
        outcome(&verification, &self.kernel)
    }

    fn output(&self) -> Output<'_> {
        Output {
            out: self.out.as_deref(),
            files: vec![
                ("--json", self.json.as_deref()),
                ("--junit", self.junit.as_deref()),
                ("--save", self.save.as_deref()),
            ],
            quiet: self.quiet,
            color: self.color,
        }
    }
}

/// Standard output is for one thing at a time.
fn check_dashes(output: &Output<'_>) -> Result<(), Failure> {
    let printed = output.files.iter().filter(|(_, file)| is_dash(*file));
    let printed: Vec<&str> = printed.map(|(option, _)| *option).collect();
    match printed[..] {
        [first, second, ..] => Err(Failure::Usage(format!(
            "'{first} -' and '{second} -' both go to standard output (allowed: one of them)"
        ))),
        _ => Ok(()),
    }
}

/// Where rows go as they come.
pub(super) struct Rows {
    printed: bool,
    /// Whether there is no other place that anything goes to.
    alone: bool,
    color: bool,
    /// The first write that failed; nothing is written after it.
    failed: Option<Failure>,
}

impl Rows {
    pub(super) fn new(printed: bool, alone: bool, color: Color) -> Self {
        Rows {
            printed,
            alone,
            color: color.is_on(),
            failed: None,
        }
    }

    /// Whether all that was to be shown was.
    pub(super) fn finish(self) -> Result<(), Failure> {
        self.failed.map_or(Ok(()), Err)
    }

    fn print(&mut self, text: &str) {
        if self.printed && self.failed.is_none() {
            self.failed = write_out(text).err();
        }
        let is_over = self.failed.as_ref().is_some_and(Failure::is_closed_pipe);
        if is_over && self.alone {
            // Nobody hears of the rest, which may take hours.
            process::stop_all_and_exit(CLOSED_PIPE.into());
        }
    }

    /// Runs the kernel, a row a channel.
    pub(super) fn run(
        &mut self,
        kernel: &mut dyn Kernel,
        subjects: &[Subject],
        settings: &Settings,
        named: &KernelArguments,
    ) -> Result<Verification, Failure> {
        let work = settings.work(subjects, kernel.declaration());
        let bar = Bar::new(work);
        let (width, color) = (width(), self.color);
        // Above the first row: what cannot be tested has no table.
        let mut head = if kernel.declaration().stochastic {
            scattered_heading(width, color)
        } else {
            heading(width, color)
        };
        let first = kernel.declaration().first_answer();
        let mut show = |line: &Line| {
            let text = std::mem::take(&mut head) + &row(line, first, width, color);
            bar.above(|| self.print(&text));
        };
        let verification = verify(kernel, subjects, settings, &bar, &mut show);
        bar.finish();
        let verification = verification.map_err(|error| named.failed(error))?;
        self.print("\n");
        Ok(verification)
    }

    /// What the rows say.
    pub(super) fn close(&mut self, verification: &Verification) {
        let document = document(verification, &about());
        self.print(&terminal(&document, width(), self.color));
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

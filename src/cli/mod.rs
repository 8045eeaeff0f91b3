//! Arguments, output and exit codes; no numerics.

mod about;
mod adjoint;
mod ask;
mod budget;
mod case;
mod cases;
mod check;
mod completions;
mod extremes;
mod failure;
mod fit;
mod gallery;
mod gradient;
mod gradient_test;
mod identify;
mod image;
mod input;
mod kernel;
mod manufacture;
pub(crate) mod memory;
mod merge;
mod new;
mod output;
mod plan;
mod progress;
mod prove;
mod reference;
mod render;
mod report;
mod reproduce;
mod scene;
mod schema;
mod shards;
mod spacing;
mod stress;
mod study;
mod terminal;
mod tradeoff;
mod verify;

pub(crate) use failure::Failure;
pub(crate) use progress::{Bar, waiting};
pub(crate) use terminal::{Color, width};

use clap::{Parser, Subcommand};
use std::io::{self, Write};
use std::process::ExitCode;
use std::str::FromStr;
use volver::real::lanes::Width;

const EXAMPLES: &str = "\
Exit codes: 0 good, 1 a check failed, 2 wrong usage or input, 130 interrupted, 141
nobody reads what is printed.

Examples:
  volver verify --cases paper method:front-to-back/middle/expm1
  volver reproduce --table 1 --levels 8..512
  volver ask sine-squared -n 4
  printf '0.4 8e-2\\n0.2 2e-2\\n0.1 5e-3\\n0.05 1.25e-3\\n' | volver fit -
  volver cases sine-squared
  volver study --cases sine-squared --methods trapezoid/trapezoid --levels 8..256
  volver manufacture rgb-transfer --code python
  volver prove sine-squared --no-check --write target/proofs
  volver reference sine-squared --digits 100
  volver stress --scenarios depth --formats f16,f32
  volver plan examples/scenes/smoke.toml --tolerance 1e-4
  volver tradeoff --cases sine-squared --levels 1..64 --cost evaluations
  volver completions bash";

/// The exit code where nobody reads any more: what a shell reports of a program that SIGPIPE, number 13, has ended.
const CLOSED_PIPE: u8 = 128 + 13;

/// Verifies approximations of the volume rendering integral.
#[derive(Parser)]
#[command(version, after_help = EXAMPLES, arg_required_else_help = false)]
struct Arguments {
    /// Numbers side by side in the formats f32-lanes and f64-lanes: 1, 4, 8 or 16, as the processor has them [default: as
    /// many as it has]; results do not depend on it
    #[arg(long, global = true, value_name = "COUNT", value_parser = Width::from_str)]
    lanes: Option<Width>,
    #[command(subcommand)]
    command: Command,
}

/// What to do; each has a file of its own.
#[derive(Subcommand)]
pub(crate) enum Command {
    Verify(Box<verify::Verify>),
    Identify(Box<identify::Identify>),
    Image(Box<image::Image>),
    Check(check::Check),
    Gradient(gradient::Gradient),
    GradientTest(gradient_test::GradientTest),
    Adjoint(adjoint::Adjoint),
    Ask(ask::Ask),
    New(new::New),
    Reproduce(reproduce::Reproduce),
    Stress(stress::Stress),
    Fit(fit::Fit),
    Gallery(gallery::Gallery),
    Cases(cases::Cases),
    Manufacture(manufacture::Manufacture),
    Prove(prove::Prove),
    Reference(reference::ReferenceValue),
    Study(Box<study::Study>),
    Merge(merge::Merge),
    Report(report::Report),
    Plan(plan::PlanScene),
    Render(render::Render),
    Tradeoff(Box<tradeoff::Tradeoff>),
    Schema(schema::Schema),
    Completions(completions::Completions),
}

impl Command {
    /// Does it.
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        match self {
            Command::Verify(arguments) => arguments.run(),
            Command::Identify(arguments) => arguments.run(),
            Command::Image(arguments) => arguments.run(),
            Command::Check(arguments) => arguments.run(),
            Command::Gradient(arguments) => arguments.run(),
            Command::GradientTest(arguments) => arguments.run(),
            Command::Adjoint(arguments) => arguments.run(),
            Command::Ask(arguments) => arguments.run(),
            Command::New(arguments) => arguments.run(),
            Command::Reproduce(arguments) => arguments.run(),
            Command::Stress(arguments) => arguments.run(),
            Command::Fit(arguments) => arguments.run(),
            Command::Gallery(arguments) => arguments.run(),
            Command::Cases(arguments) => arguments.run(),
            Command::Manufacture(arguments) => arguments.run(),
            Command::Prove(arguments) => arguments.run(),
            Command::Reference(arguments) => arguments.run(),
            Command::Study(arguments) => arguments.run(),
            Command::Merge(arguments) => arguments.run(),
            Command::Report(arguments) => arguments.run(),
            Command::Plan(arguments) => arguments.run(),
            Command::Render(arguments) => arguments.run(),
            Command::Tradeoff(arguments) => arguments.run(),
            Command::Schema(arguments) => arguments.run(),
            Command::Completions(arguments) => arguments.run(),
        }
    }
}

/// How a run that came to an end went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Nothing was checked, or every check passed.
    Good,
    /// A check failed.
    CheckFailed,
}

/// Reads the command line.
pub(crate) fn parse() -> Result<Command, Failure> {
    let Arguments { lanes, command } = Arguments::try_parse()?;
    if let Some(width) = lanes {
        width
            .choose()
            .map_err(|error| Failure::Usage(error.to_string()))?;
    }
    Ok(command)
}

/// The exit code; what went wrong goes to standard error in one line.
pub(crate) fn report(outcome: Result<Outcome, Failure>) -> ExitCode {
    match outcome {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::CheckFailed) => ExitCode::from(1),
        Err(Failure::Shown(text)) => match write_out(&text) {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => report(Err(failure)),
        },
        // Whoever reads has enough, as in '| head': there is nothing to tell.
        Err(failure) if failure.is_closed_pipe() => ExitCode::from(CLOSED_PIPE),
        Err(failure) => {
            // Nobody is left to tell where standard error is closed.
            let mut err = io::stderr().lock();
            let _ = writeln!(err, "volver: {failure}");
            if let Some(excerpt) = failure.excerpt() {
                let _ = writeln!(err, "{excerpt}");
            }
            ExitCode::from(failure.exit_code())
        }
    }
}

/// Writes to standard output.
pub(crate) fn write_out(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(Failure::Output)
}

//! `volver check`: a kernel compared with what it showed before.

use super::kernel::{KERNELS, KernelArguments, subjects};
use super::verify::{Table, outcome, settings};
use super::{Color, Failure, Outcome, write_out};
use clap::Args;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use volver::study::verify::{Baseline, Conclusion};

const EXAMPLES: &str = "\
BASELINE is what 'volver verify --save' wrote: its cases and levels are run again. A
channel has moved where it stands otherwise (confirmed, contradicted, inconclusive …)
or where the intervals of its orders have nothing in common. The exit code is 1 where
something has moved, but for what is only better, and 2 where the kernel could not run.

Examples:
  volver verify --save base.json --cases paper method:tree/middle/expm1
  volver check base.json method:tree/middle/expm1";

/// Compare a kernel with what it showed before
#[derive(Args)]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
pub(crate) struct Check {
    /// What 'volver verify --save' wrote
    #[arg(value_name = "BASELINE")]
    baseline: PathBuf,
    #[command(flatten)]
    kernel: KernelArguments,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

impl Check {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let path = self.baseline.display().to_string();
        let text = fs::read_to_string(&self.baseline).map_err(|error| Failure::Input {
            path: path.clone(),
            error,
        })?;
        let baseline = Baseline::read(&text).map_err(|error| Failure::Content {
            path,
            error: error.into(),
        })?;
        let mut settings = settings(None)?;
        baseline.apply(&mut settings);
        let subjects = subjects(&baseline.cases)?;
        let mut kernel = self.kernel.start()?;
        let table = Table {
            printed: !self.quiet,
            color: self.color.is_on(),
        };
        let verification = table.run(kernel.as_mut(), &subjects, &settings, &self.kernel)?;
        drop(kernel);
        if verification.conclusion() == Conclusion::CouldNotRun {
            return outcome(&verification, &self.kernel);
        }
        let moved = baseline.moved(&verification);
        let mut said = String::new();
        for one in &moved {
            let how = if one.better { "better" } else { "moved" };
            // Writing to a String does not fail.
            let _ = writeln!(said, "{how}: {one}");
        }
        let worse = moved.iter().filter(|one| !one.better).count();
        let _ = match (worse, moved.len()) {
            (0, 0) => writeln!(said, "nothing has moved"),
            (0, better) => writeln!(said, "{better} for the better: save the baseline anew"),
            (worse, _) => writeln!(said, "{worse} moved"),
        };
        write_out(&said)?;
        Ok(if worse == 0 {
            Outcome::Good
        } else {
            Outcome::CheckFailed
        })
    }
}

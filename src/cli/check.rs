//! `volver check`: a kernel compared with what it showed before.

use super::input::read;
use super::kernel::{KERNELS, KernelArguments, subjects};
use super::verify::{Rows, outcome};
use super::{Color, Failure, Outcome, write_out};
use clap::Args;
use std::fmt::Write;
use volver::input::COMPUTED;
use volver::study::verify::{Baseline, BaselineError, Conclusion};

const EXAMPLES: &str = "\
BASELINE is what 'volver verify --save' wrote: its cases and levels are run again. A
channel has moved where it stands otherwise (confirmed, contradicted, inconclusive …)
or where the intervals of its orders have nothing in common; the kernel where it computes
something else, or deviates otherwise by more than a hundredth. The exit code is 1 where
something has moved, but for what is only better, and 2 where the kernel could not run.

Work: what 'volver verify' took to write BASELINE, of at most 64 MiB; a program has
--timeout for each answer. A bar on the terminal says how much is left.

Examples:
  volver verify --save base.json --cases paper method:tree/middle/expm1
  volver check base.json method:tree/middle/expm1";

/// Compare a kernel with what it showed before
#[derive(Args)]
#[command(override_usage = "volver check [OPTIONS] <BASELINE> <KERNEL> [ARGS]...")]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
pub(crate) struct Check {
    /// What 'volver verify --save' wrote; - for standard input
    #[arg(value_name = "BASELINE")]
    baseline: String,
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
        let wrong = |error: BaselineError| Failure::Content {
            path: self.baseline.clone(),
            error: error.into(),
        };
        let baseline = Baseline::read(&read(&self.baseline, COMPUTED)?).map_err(wrong)?;
        let settings = baseline.settings().map_err(wrong)?;
        let at_once = self.kernel.at_once()?;
        let subjects = subjects(&baseline.asked(), &self.baseline)?;
        let mut kernel = at_once.map_or_else(|| self.kernel.program(), Ok)?;
        let mut rows = Rows::new(!self.quiet, true, self.color);
        let verification = rows.run(kernel.as_mut(), &subjects, &settings, &self.kernel)?;
        drop(kernel);
        rows.close(&verification);
        rows.finish()?;
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
        for one in baseline.unrecorded(&verification) {
            let _ = writeln!(
                said,
                "found: {one} (the baseline is of version 1 and has none: save it anew)"
            );
        }
        for one in baseline.not_measured(&verification) {
            let _ = writeln!(
                said,
                "found: {one} (the baseline has no such quantity: save it anew)"
            );
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

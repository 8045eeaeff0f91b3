//! `volver gradient`: the gradients of a kernel beside theory.

use super::about::about;
use super::kernel::{KERNELS, KernelArguments, subjects};
use super::output::Output;
use super::{Bar, Color, Failure, Outcome};
use clap::Args;
use std::path::PathBuf;
use std::str::FromStr;
use volver::convergence::Ladder;
use volver::identify;
use volver::kernel::KernelError;
use volver::report::gradient::{Own, document, is_other, json, write};
use volver::study::gradient::{CASES, Conclusion, GradientError, Gradients, gradients};
use volver::study::verify::{Axis, Identify, REPLICAS, Settings, SettingsError};

/// Rays of the kernel's own values: six a value, of fourteen rays that have more where it takes multiples of many segments.
const OWN_VALUES: u64 = 4_000;

const EXAMPLES: &str = "\
The kernel declares by which values it differentiates: \"gradient\": \"middles\" or
\"edges\" (docs/protocol.md). Its derivatives by τ and C of every sample, divided by the
length that the sample stands for, are compared with T C − R and τ T, R being what comes
from behind: the error at every level, the largest and in the mean square, and its order.
On seven small rays they are also compared with the kernel's own values, which need no
small steps, and the term that is wrong is named.
Of a kernel that draws random numbers it is the mean over seeds, of sums along the ray:
its bias beside its standard error, and the order with which a bias falls.
docs/gradient.md says more.

The exit code is 0 where of both derivatives more lines are confirmed than not, but for those
that rounding ends, and none is contradicted; 1 where not, or where derivatives are not
those of the kernel's own values; 2 where it could not run.

Work: cases × levels × seeds, at most 64 levels of 524288 segments, each asked once and the
coarsest twice; a program has --timeout for each answer. A bar on the terminal says how much is left.

CASES are names that 'volver cases' lists, NAME/CHANNEL, tags, or paths of case files.
LADDER is as for 'volver reproduce'.

JSON: conclusion, counts, orders, at, sampling, and of every case its cotangents, left_out,
troubles, failures and lines with derivative, norm, order, half_width, verdict and samples,
or means with derivative, summed_with, bias, standard_error, verdict and fit;
own_values with compared, agree, left_out, deviations and the one that is farthest off.

Examples:
  volver gradient python3 examples/kernels/gradient.py
  volver gradient --cases rgb-transfer --levels 8..512 python3 examples/kernels/gradient.py
  volver gradient --json - python3 examples/kernels/gradient.py --sampling front
  volver gradient --replicas 60 python3 examples/kernels/gradient.py --sampling jittered";

/// Put the gradients of a kernel to the test
#[derive(Args)]
#[command(override_usage = "volver gradient [OPTIONS] <KERNEL> [ARGS]...")]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
#[allow(clippy::doc_markdown)] // Help is no Markdown.
pub(crate) struct Gradient {
    #[command(flatten)]
    kernel: KernelArguments,
    /// Only these cases, by commas, repeatable [default: seven smooth ones]
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
    cases: Vec<String>,
    /// Numbers of segments [default: 9,21,33,69,129,261,513,1029]
    #[arg(long, value_name = "LADDER", alias = "ladder", value_parser = Ladder::from_str)]
    levels: Option<Ladder>,
    /// Seeds a level, for kernels that draw random numbers [default: 30]
    #[arg(long, value_name = "N", value_parser = replicas, allow_negative_numbers = true)]
    replicas: Option<usize>,
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the report, as a page, Markdown and JSON, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

fn replicas(text: &str) -> Result<usize, SettingsError> {
    Settings::replicas(text.parse().unwrap_or(0))
}

impl Gradient {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let output = Output {
            out: self.out.as_deref(),
            files: vec![("--json", self.json.as_deref())],
            quiet: self.quiet,
            color: self.color,
        };
        let settings = self.settings()?;
        let at_once = self.kernel.at_once()?;
        let asked = if self.cases.is_empty() {
            CASES.map(String::from).into()
        } else {
            self.cases.clone()
        };
        let subjects = subjects(&asked, "--cases")?;
        output.check()?;
        let mut kernel = at_once.map_or_else(|| self.kernel.program(), Ok)?;
        if kernel.declaration().gradient.is_none() {
            return Err(self.kernel.failed(KernelError::NoGradient));
        }
        let bar = Bar::new(settings.work(&subjects, kernel.declaration()));
        let found = gradients(kernel.as_mut(), &subjects, &settings, &bar);
        bar.finish();
        kernel.renew();
        let budget = identify::Budget {
            rays: OWN_VALUES,
            ..identify::Budget::default()
        };
        let own = identify::gradients(kernel.as_mut(), budget, &mut |_| ());
        self.kernel.still_there(kernel.as_ref())?;
        // The child is gone before the last word.
        drop(kernel);
        let found = found.map_err(|error| self.failed(error))?;
        output.hand_out(
            &document(&found, &own, &about()),
            |directory| write(directory, &found, &own, &about()),
            |_| json(&found, &own),
        )?;
        self.outcome(&found, &own)
    }

    fn settings(&self) -> Result<Settings, Failure> {
        let settings = match &self.levels {
            None => Settings::standard(Axis::Step),
            Some(ladder) => Settings::new(ladder),
        };
        let settings = settings.and_then(Settings::with_enough_levels);
        let settings = settings.map_err(|error| Failure::Usage(format!("--levels: {error}")))?;
        Ok(Settings {
            identify: Identify::Off,
            replicas: self.replicas.unwrap_or(REPLICAS),
            ..settings
        })
    }

    fn failed(&self, error: GradientError) -> Failure {
        self.kernel.failed(error)
    }

    fn outcome(&self, found: &Gradients, own: &Own) -> Result<Outcome, Failure> {
        match found.conclusion() {
            Conclusion::Confirmed if is_other(own) => Ok(Outcome::CheckFailed),
            Conclusion::Confirmed => Ok(Outcome::Good),
            Conclusion::NotConfirmed => Ok(Outcome::CheckFailed),
            Conclusion::CouldNotRun => {
                let first = found.cases.iter().flat_map(|case| &case.failures).next();
                let why = first.map(|failure| failure.error.to_string());
                let why = why.unwrap_or_else(|| "no level was answered".into());
                Err(self.kernel.failed(anyhow::anyhow!(why)))
            }
        }
    }
}

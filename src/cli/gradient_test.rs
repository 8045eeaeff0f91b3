//! `volver gradient-test`: whether a gradient is right, from anybody's Taylor remainders.

use super::about::about;
use super::fit::{decimal, floor};
use super::input::read;
use super::output::Output;
use super::{Color, Failure, Outcome};
use clap::Args;
use std::path::Path;
use volver::convergence::table::remainders;
use volver::convergence::{Decimal, Taylor, taylor};
use volver::input::COMPUTED;
use volver::report::gradient_test::{document, json};

const EXAMPLES: &str = "\
FILE has one row a step: h and |f(x + hv) − f(x) − h g·v|, g being the gradient that is
tested and v any direction; perhaps |f(x + hv) − f(x)| behind it, separated by commas,
semicolons, tabs or blanks. A header may name the columns h, remainder and change; # starts
a comment. JSON is read too: [[h, r], …], or {\"h\": […], \"remainder\": […], \"change\": […]}.

Of a right gradient the remainder is of the second order. Of a wrong one a part of the first
order is left, which is told from roundoff by fitting both powers.

The exit code is 0 where the gradient is right, 1 where it is wrong or the steps do not tell,
2 where the input is wrong.

Work: at most 64 MiB and 1048576 rows are read; time and memory grow with the rows.

JSON: remainder, passes, first, second, slope, wrong_by, roundoff (the first
level at it), fit, samples.

Examples:
  printf '.1 1e-2\\n.05 2.5e-3\\n.025 6.25e-4\\n.0125 1.5625e-4\\n' | volver gradient-test -
  printf '[[0.8,0.64],[0.4,0.16],[0.2,0.04],[0.1,0.01]]' | volver gradient-test - --json";

/// Tell from Taylor remainders whether a gradient is right
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct GradientTest {
    /// Table of steps and remainders; - reads standard input
    file: String,
    /// g·v, where the table has no changes: what a wrong gradient is off is said as a part of it
    #[arg(long, value_name = "X", value_parser = slope, allow_hyphen_values = true)]
    slope: Option<f64>,
    /// Roundoff of every remainder [default: where they stop falling]
    #[arg(long, value_name = "F", value_parser = floor, allow_hyphen_values = true)]
    floor: Option<Decimal>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
    /// Colour the verdict
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

impl GradientTest {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let text = read(&self.file, COMPUTED)?;
        let found = self.taylor(&text).map_err(|error| Failure::Content {
            path: self.file.clone(),
            error,
        })?;
        let output = Output {
            out: None,
            files: vec![("--json", self.json.then_some(Path::new("-")))],
            quiet: false,
            color: self.color,
        };
        output.show(&document(&found, &about()), |_| json(&found))?;
        Ok(if found.smoothness.passes() {
            Outcome::Good
        } else {
            Outcome::CheckFailed
        })
    }

    fn taylor(&self, text: &str) -> anyhow::Result<Taylor> {
        let rows = remainders(text)?;
        let floor = self.floor.as_ref().map(|floor| &floor.value);
        Ok(taylor(&rows, self.slope, floor)?)
    }
}

fn slope(text: &str) -> Result<f64, &'static str> {
    let slope = decimal(text)?.value.to_f64();
    let is_good = slope.is_finite() && slope != 0.0;
    is_good
        .then_some(slope)
        .ok_or("no slope (allowed: a finite number other than 0)")
}

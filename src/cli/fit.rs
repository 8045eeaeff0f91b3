//! `volver fit`: an order and a verdict from a table of steps and errors, or values.

use super::about::about;
use super::input::read;
use super::output::Output;
use super::{Color, Failure, Outcome, waiting};
use clap::Args;
use std::path::Path;
use volver::convergence::table::{self, Levels, Reading};
use volver::convergence::{Decimal, fit, fit_differences, fit_uncertain};
use volver::input::COMPUTED;
use volver::method::Expected;
use volver::report::fit::{Fitted, Source, document, json};

const EXAMPLES: &str = "\
FILE has one row a level: step and error, separated by commas, semicolons, tabs
or blanks. A header may name the columns: h, d, dx, step or n (h = 1/n); error,
err, e, or value, v, q, result; floor; stderr or se, the standard error of an
error or value. nan and inf are verdict NotFinite. # starts a comment.

Examples:
  printf '.4 8e-2\\n.2 2e-2\\n.1 5e-3\\n.05 1.25e-3\\n' | volver fit - --expect 2
  printf 'n,v\\n4,1.01\\n8,1.005\\n16,1.0025\\n32,1.00125\\n' | volver fit - --exact 1
  printf '8 1.80000\\n4 1.4\\n2 1.2\\n1 1.1\\n.5 1.05\\n' | volver fit - --richardson
  printf '8 8.01\\n4 4\\n2 2\\n1 1\\n.5 .5\\n' | volver fit - --at-least .9
  printf 'h,e\\n4,0\\n2,0\\n1,0\\n.5,0\\n' | volver fit - --expect exact --json

Work: at most 64 MiB and 1048576 rows are read; time and memory grow with the rows.

JSON: verdict, passes, expected, at_least, source, order, half_width,
log2_constant, window, floor, floor_source, cut, pairs, notes, samples. Order,
half-width and constant are null without a window. An error below 1e-300 is a
string.";

/// Fit an order of accuracy to errors, or values, at decreasing steps
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Fit {
    /// Table of steps with errors or values; - reads standard input
    file: String,
    /// The exact value: the table holds values
    #[arg(long, value_name = "X", value_parser = decimal, allow_hyphen_values = true)]
    exact: Option<Decimal>,
    /// Fit the differences of values, where no exact value is known
    #[arg(long, conflicts_with = "exact")]
    richardson: bool,
    /// Check the order: exit with 1 unless it is P (or the word exact)
    #[arg(long, value_name = "P", value_parser = expected, allow_hyphen_values = true)]
    expect: Option<Expected>,
    /// Check the order: exit with 1 unless the whole interval lies at or above P
    #[arg(long, value_name = "P", value_parser = order, allow_hyphen_values = true)]
    at_least: Option<f64>,
    /// Roundoff floor of every error or value; for values the default is half a
    /// unit of the last digit
    #[arg(long, value_name = "F", value_parser = floor, allow_hyphen_values = true)]
    floor: Option<Decimal>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
    /// Colour the verdict
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

impl Fit {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let fitted = waiting("fitting", || {
            let text = read(&self.file, COMPUTED)?;
            self.fit(&text).map_err(|error| Failure::Content {
                path: self.file.clone(),
                error,
            })
        })?;
        let output = Output {
            out: None,
            files: vec![("--json", self.json.then_some(Path::new("-")))],
            quiet: false,
            color: self.color,
        };
        if self.json {
            output.print(String::new(), |_| json(&fitted))?;
        } else {
            output.show(&document(&fitted, &about()), |_| json(&fitted))?;
        }
        match fitted.passes() {
            Some(false) => Ok(Outcome::CheckFailed),
            _ => Ok(Outcome::Good),
        }
    }

    fn fit(&self, text: &str) -> anyhow::Result<Fitted> {
        let reading = Reading {
            exact: self.exact.as_ref().map(|x| x.value.clone()),
            differences: self.richardson,
            floor: self.floor.as_ref().map(|f| f.value.clone()),
        };
        let table = table::read(text, &reading)?;
        let of_errors = match self.exact {
            Some(_) => Source::Exact,
            None => Source::Errors,
        };
        let (fit, samples, source) = match table.levels {
            Levels::Errors(samples) => (fit(&samples, self.expect)?, samples, of_errors),
            Levels::Uncertain(samples, deviations) => {
                let fit = fit_uncertain(&samples, &deviations, self.expect)?;
                (fit, samples, of_errors)
            }
            Levels::Values(values) => {
                let found = fit_differences(&values, self.expect)?;
                (found.fit, found.samples, Source::Differences)
            }
        };
        Ok(Fitted {
            fit,
            samples,
            expected: self.expect,
            at_least: self.at_least,
            floor_source: table.floor_source,
            source,
        })
    }
}

pub(super) fn decimal(text: &str) -> Result<Decimal, &'static str> {
    Decimal::parse(text).ok_or("not a number (allowed: finite decimal numbers)")
}

pub(super) fn floor(text: &str) -> Result<Decimal, &'static str> {
    decimal(text)?;
    Decimal::parse(text)
        .filter(|f| f.value >= 0)
        .ok_or("negative (allowed: 0 or above)")
}

fn expected(text: &str) -> Result<Expected, &'static str> {
    if text.eq_ignore_ascii_case("exact") {
        return Ok(Expected::Exact);
    }
    order(text)
        .map(Expected::Order)
        .map_err(|_| "no order (allowed: a finite number, or exact)")
}

fn order(text: &str) -> Result<f64, &'static str> {
    Decimal::parse(text)
        .map(|p| p.value.to_f64())
        .filter(|p| p.is_finite())
        .ok_or("no order (allowed: a finite number)")
}

//! `volver reference`: the radiance of a case to any number of digits.

use super::about::about;
use super::case::{self, SOURCES};
use super::output::Output;
use super::{Color, Failure, Outcome};
use clap::Args;
use rayon::prelude::*;
use rug::Float;
use std::f64::consts::LOG2_10;
use std::path::Path;
use volver::case::SymbolicCase;
use volver::case::manufacture::Manufactured;
use volver::reference::{
    Reference, ReferenceError, Source, enclosed_radiance, estimated_radiance, radiance,
};
use volver::report::reference::{Difference, Found, document, json};

/// The most digits that can be asked for.
const MAX_DIGITS: u32 = 10_000;

/// Print the radiance of a case to any number of digits
#[derive(Args)]
#[command(after_help = examples())]
pub(crate) struct ReferenceValue {
    /// A name of the catalogue, a channel of it, or a file
    #[arg(value_name = "CASE")]
    case: String,
    /// Significant digits
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = digits)]
    digits: u32,
    /// Enclose the integral even where there is a closed form, and compare
    #[arg(long, conflicts_with = "estimate")]
    integrate: bool,
    /// Estimate the integral by Chebyshev series, without a proof, and compare
    #[arg(long, alias = "spectral")]
    estimate: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

fn examples() -> String {
    format!(
        "{SOURCES}

A closed form is evaluated in intervals where there is one. Otherwise, and with
--integrate, the integral of C and tau is enclosed: panels between kinks and jumps,
which are found, with a bound of all that series leave out. Either way the error is
proved, and with it every digit. Where there is no bound the value is an estimate
by Chebyshev series, and 'source' says why: what is narrower than the distance of
its points can be missed. The transcendental functions counted are those of the
medium and of the transmittance, a sine and cosine of the same number as one.

With --integrate and --estimate the exit code is 1 where the difference to the
closed form is more than both errors.

JSON: volver (its version) and references, an object a channel: name, channel,
radiance (text of N digits), asked and digits (those that the error leaves; null for
an exact 0), error, proved (whether error is), not_proved (why not, or null), source
(closed form, enclosure, estimate), panels, points, evaluations,
transcendental_calls, difference (to the closed form, or null), unproved (claim and
reason of each statement on the case that is not proved).

Examples:
  volver reference sine-squared
  volver reference kink-moving --digits 200 --integrate
  volver reference rgb-transfer/red --digits 20 --json
  printf 'name=\"a\"\\nlength=1\\nextinction=\"1+s^3\"\\nemission=\"exp(-s)\"' | volver reference -"
    )
}

fn digits(text: &str) -> Result<u32, String> {
    let digits = text.parse().ok().filter(|d| (1..=MAX_DIGITS).contains(d));
    digits.ok_or_else(|| format!("no number of digits (allowed: 1 to {MAX_DIGITS})"))
}

impl ReferenceValue {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let loaded = case::load(&self.case)?;
        let found: Result<Vec<Found<'_>>, ReferenceError> = loaded
            .cases
            .par_iter()
            .map(|case| self.find(case))
            .collect();
        let found = found.map_err(|error| Failure::Content {
            path: self.case.clone(),
            error: error.into(),
        })?;
        let output = Output {
            out: None,
            files: vec![("--json", self.json.then_some(Path::new("-")))],
            quiet: false,
            color: Color::Never,
        };
        let document = document(&found, self.digits, &about());
        output.show(&document, |_| json(&found, self.digits))?;
        let mut differences = found.iter().filter_map(|found| found.difference.as_ref());
        Ok(
            if differences.all(|difference| difference.is_within_errors) {
                Outcome::Good
            } else {
                Outcome::CheckFailed
            },
        )
    }

    fn find<'c>(&self, case: &'c Manufactured) -> Result<Found<'c>, ReferenceError> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // At most 33,220.
        let bits = (f64::from(self.digits) * LOG2_10).ceil() as u32 + 1;
        let reference = if self.integrate {
            enclosed_radiance(&case.case, bits)?
        } else if self.estimate {
            estimated_radiance(&case.case, bits)?
        } else {
            return Ok(Found {
                case,
                reference: radiance(&case.case, bits)?,
                difference: None,
            });
        };
        let difference = difference(&case.case, &reference, bits)?;
        Ok(Found {
            case,
            reference,
            difference,
        })
    }
}

fn difference(
    case: &SymbolicCase,
    reference: &Reference,
    bits: u32,
) -> Result<Option<Difference>, ReferenceError> {
    let exact = radiance(case, bits)?;
    if exact.source != Source::ClosedForm {
        return Ok(None);
    }
    let amount = Float::with_val(64, &reference.value - &exact.value).abs();
    let allowed = Float::with_val(64, &reference.error + &exact.error);
    Ok(Some(Difference {
        is_within_errors: amount <= allowed,
        amount,
    }))
}

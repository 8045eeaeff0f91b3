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
use volver::reference::{Reference, ReferenceError, Source, radiance, spectral_radiance};
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
    /// Integrate numerically even where there is a closed form, and compare
    #[arg(long)]
    spectral: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

fn examples() -> String {
    format!(
        "{SOURCES}

A closed form is evaluated where there is one. Otherwise, and with --spectral, the
integral is found from C and tau alone: Chebyshev series on panels between the
breaks of the case. 'believed' are the digits that the value has by an estimate of
its error; the transcendental functions counted are those of the medium and of the
transmittance, a sine and cosine of the same number as one.

With --spectral the exit code is 1 where the difference to the closed form is more
than the estimated error.

JSON: volver (its version) and references, an object a channel: name, channel,
radiance (text of N digits), asked and believed (digits; null for an exact 0),
error, source (closed form, spectral), panels, points, evaluations,
transcendental_calls, difference (to the closed form, with --spectral, or null),
unproved (claim and reason of each statement on the case that is not proved).

Examples:
  volver reference sine-squared
  volver reference kink-moving --digits 200 --spectral
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
        if !self.spectral {
            return Ok(Found {
                case,
                reference: radiance(&case.case, bits)?,
                difference: None,
            });
        }
        let reference = spectral_radiance(&case.case, bits)?;
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

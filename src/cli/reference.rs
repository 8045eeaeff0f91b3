//! `volver reference`: the radiance of a case to any number of digits.

mod growth;

use super::about::about;
use super::budget::{Budget, MINUTE};
use super::case::{self, SOURCES};
use super::output::Output;
use super::{Color, Failure, Outcome, waiting};
use clap::Args;
use rayon::prelude::*;
use rug::Float;
use std::f64::consts::LOG2_10;
use std::path::Path;
use std::time::Instant;
use volver::case::SymbolicCase;
use volver::case::manufacture::Manufactured;
use volver::reference::{
    Reference, ReferenceError, Source, enclosed_radiance, estimated_radiance, radiance,
};
use volver::report::reference::{Difference, Found, document, json};

/// The most digits that can be asked for.
const MAX_DIGITS: u32 = 10_000;
/// As many take no time, and tell what more will take.
const FEW_DIGITS: u32 = 100;
/// The numbers that are kept of a point, and the bytes of each beside its digits.
const NUMBERS_A_POINT: f64 = 12.0;
const HEADER_BYTES: f64 = 32.0;

/// Print the radiance of a case to any number of digits
#[derive(Args)]
#[command(after_help = examples())]
#[allow(clippy::struct_excessive_bools)] // One an option.
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
    /// Run even if it takes more than 2 GiB of memory or 1 min
    #[arg(long)]
    yes: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

fn examples() -> String {
    format!(
        "{SOURCES}

A closed form is evaluated in intervals where there is one. Otherwise, and with
--integrate, the integral of C and tau is enclosed: panels between kinks and jumps,
which are found, with a bound of all that series leave out; roots at an end of one
(sqrt(s), or sqrt(abs(sin(s))) anywhere) take a power of the variable. Either way the
error is proved, and with it every digit. Where there is no bound the value is an estimate
by Chebyshev series, and 'source' says why: what is narrower than the distance of
its points can be missed. The transcendental functions counted are those of the
medium and of the transmittance, a sine and cosine of the same number as one.

Work: what would take more than 2 GiB of memory or 1 min is refused with an estimate
of both, from fewer digits, unless you say --yes.

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
    // What is beyond the most is told what it would take.
    let digits = text.parse().ok().filter(|digits| *digits > 0);
    digits.ok_or_else(|| format!("no number of digits (allowed: 1 to {MAX_DIGITS})"))
}

impl ReferenceValue {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let loaded = case::medium(&self.case)?;
        let wrong = |error: ReferenceError| Failure::Content {
            path: self.case.clone(),
            error: error.into(),
        };
        if self.digits > MAX_DIGITS {
            let refused = waiting("estimating", || self.beyond(&loaded.cases));
            return Err(Failure::Usage(refused.map_err(wrong)?));
        }
        self.budget(&loaded.cases).check(self.yes)?;
        let found: Result<Vec<Found<'_>>, ReferenceError> = waiting("integrating", || {
            loaded
                .cases
                .par_iter()
                .map(|case| self.find(case))
                .collect()
        });
        let found = found.map_err(wrong)?;
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

    /// What all channels take, by what fewer digits take.
    fn budget(&self, cases: &[Manufactured]) -> Budget<'_> {
        let mut budget = Budget {
            what: "the radiance",
            bytes: 0.0,
            seconds: 0.0,
            usual: MINUTE,
        };
        if self.digits <= FEW_DIGITS {
            return budget;
        }
        let more = f64::from(self.digits) / f64::from(FEW_DIGITS);
        let number = bytes_of(self.digits);
        for case in cases {
            let start = Instant::now();
            // What fails will fail; a closed form takes no time.
            if let Ok(few) = self.value(case, bits_of(FEW_DIGITS))
                && few.source != Source::ClosedForm
            {
                // Points grow with the digits, and what each costs faster than they do.
                budget.seconds += start.elapsed().as_secs_f64() * more.powf(2.8);
                budget.bytes += few.work.points as f64 * more * NUMBERS_A_POINT * number;
            }
        }
        budget
    }

    /// Why more digits than can be asked for are refused: what they would take.
    fn beyond(&self, cases: &[Manufactured]) -> Result<String, ReferenceError> {
        let growth = growth::measured(MAX_DIGITS, |digits| {
            let mut bytes = 0.0;
            for case in cases {
                let few = self.value(case, bits_of(digits))?;
                // A closed form has no points, and a few numbers.
                let points = few.work.points.max(1) as f64;
                bytes += points * NUMBERS_A_POINT * bytes_of(digits);
            }
            Ok(bytes)
        })?;
        let (bytes, seconds) = growth.at(self.digits);
        let budget = Budget {
            what: &format!("--digits {}: the radiance", self.digits),
            bytes,
            seconds,
            usual: MINUTE,
        };
        Ok(format!(
            "{budget}, by {growth} (allowed: 1 to {MAX_DIGITS})"
        ))
    }

    /// The radiance in the way that was asked for.
    fn value(&self, case: &Manufactured, bits: u32) -> Result<Reference, ReferenceError> {
        if self.integrate {
            enclosed_radiance(&case.case, bits)
        } else if self.estimate {
            estimated_radiance(&case.case, bits)
        } else {
            radiance(&case.case, bits)
        }
    }

    fn find<'c>(&self, case: &'c Manufactured) -> Result<Found<'c>, ReferenceError> {
        let bits = bits_of(self.digits);
        let reference = self.value(case, bits)?;
        if !self.integrate && !self.estimate {
            return Ok(Found {
                case,
                reference,
                difference: None,
            });
        }
        let difference = difference(&case.case, &reference, bits)?;
        Ok(Found {
            case,
            reference,
            difference,
        })
    }
}

/// A number of so many digits.
fn bytes_of(digits: u32) -> f64 {
    f64::from(digits) * LOG2_10 / 8.0 + HEADER_BYTES
}

fn bits_of(digits: u32) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // At most 33,220.
    let bits = (f64::from(digits) * LOG2_10).ceil() as u32;
    bits + 1
}

fn difference(
    case: &SymbolicCase,
    reference: &Reference,
    bits: u32,
) -> Result<Option<Difference>, ReferenceError> {
    // Without a closed form there is nothing to compare, and the integral is not taken twice.
    if case.formulas().radiance.is_none() {
        return Ok(None);
    }
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

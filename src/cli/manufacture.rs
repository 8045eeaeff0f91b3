//! `volver manufacture`: a case derived from a file, as text, LaTeX or source code.

use super::about::about;
use super::case::{self, DERIVING, SOURCES};
use super::cases::{JSON, figure_file, form, output};
use super::{Failure, Outcome, waiting};
use clap::Args;
use std::path::{Path, PathBuf};
use std::slice::from_ref;
use std::str::FromStr;
use volver::report::cases::{code, document, latex};
use volver::symbolic::code::Language;

/// Derive a case with an exact radiance from a file, and check it
#[derive(Args)]
#[command(after_help = examples())]
pub(crate) struct Manufacture {
    /// The case file, a name of the catalogue, or - for standard input
    #[arg(value_name = "CASE")]
    case: String,
    /// Write one JSON document; - is standard output, without the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Print the formulas in LaTeX, for the package amsmath
    #[arg(long, conflicts_with = "code")]
    latex: bool,
    /// Print source code of the functions: c, python or rust
    #[arg(long, value_name = "LANGUAGE", value_parser = Language::from_str)]
    code: Option<Language>,
    /// Draw the case along its ray, as SVG
    #[arg(long, value_name = "FILE", value_parser = figure_file)]
    plot: Option<PathBuf>,
}

fn examples() -> String {
    format!(
        "{SOURCES}

The exit code is 1 where a statement of the case is refuted: then there is no
case. C < 0 somewhere is a warning: kernels refuse such a case, analysis does not.

Code has LENGTH and the functions field(lambda), extinction(s), emission(s),
optical_depth(lambda) and radiance(lambda); of several channels, emission_NAME and
radiance_NAME.

{DERIVING}

{JSON}

Examples:
  printf 'name=\"a\"\\nlength=1\\ndepth=\"lambda\"\\nradiance=\"lambda\"' | volver manufacture -
  volver manufacture rgb-transfer --code python
  volver manufacture sine-squared --latex
  volver manufacture sine-squared --json -"
    )
}

impl Manufacture {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        if self.json.as_deref() == Some(Path::new("-")) && (self.latex || self.code.is_some()) {
            let other = if self.latex { "--latex" } else { "--code" };
            return Err(Failure::Usage(format!(
                "'--json -' and '{other}' both go to standard output (allowed: --json with a file)"
            )));
        }
        let output = output(self.json.as_deref(), self.plot.as_deref());
        output.check()?;
        let derived = waiting("deriving", || case::load(&self.case))?;
        let form = |option: &str| form(option, from_ref(&derived));
        match self.code {
            Some(language) => {
                let code = code(&derived, language).map_err(|error| Failure::Content {
                    path: self.case.clone(),
                    error: error.into(),
                })?;
                output.print(code, form)?;
            }
            None if self.latex => output.print(latex(&derived), form)?,
            None => output.show(&document(&derived, false, &about()), form)?,
        }
        Ok(Outcome::Good)
    }
}

//! `volver manufacture`: a case derived from a file, as text, LaTeX or source code.

mod code;
mod latex;

use super::case::{self, SOURCES, json};
use super::cases::{check_places, figure_file, plot, write};
use super::{Failure, Outcome};
use clap::Args;
use std::path::{Path, PathBuf};
use std::str::FromStr;
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

{}

Examples:
  printf 'name=\"a\"\\nlength=1\\ndepth=\"lambda\"\\nradiance=\"lambda\"' | volver manufacture -
  volver manufacture rgb-transfer --code python
  volver manufacture sine-squared --latex
  volver manufacture sine-squared --json -",
        json::HELP
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
        check_places(self.json.as_deref(), self.plot.as_deref())?;
        let loaded = case::load(&self.case)?;
        let text = match self.code {
            Some(language) => {
                code::render(&loaded, language).map_err(|error| Failure::Content {
                    path: self.case.clone(),
                    error: error.into(),
                })?
            }
            None if self.latex => latex::render(&loaded),
            None => case::text::render(&loaded, super::width(), false),
        };
        if let Some(file) = &self.plot {
            plot(file, &loaded)?;
        }
        write(&text, self.json.as_deref(), std::slice::from_ref(&loaded))?;
        Ok(Outcome::Good)
    }
}

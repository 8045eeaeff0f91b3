//! `volver cases`: what there is to verify against, and each case in full.

use super::about::about;
use super::case::{self, DERIVING, SOURCES};
use super::output::Output;
use super::{Color, Failure, Outcome, waiting};
use clap::Args;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use volver::case::catalogue;
use volver::document::Figure;
use volver::render::svg;
use volver::report::ReportError;
use volver::report::cases::{Derived, document, json, list};
use volver::report::plots::of_case;

/// What the help says of the document.
pub(crate) const JSON: &str = "\
JSON: volver (its version) and cases, an object a channel: name, channel, title,
tags, length, formulas (field, extinction, emission, optical_depth, radiance, and
extinction_along and emission_along of lambda), optical_depth and radiance at the
far end, checks (statement, claim, outcome, at, value), closed_form, proved,
suits_kernels, degenerate, breaks (part of the length, powers in extinction and
source), orders (method, order, theorem). Exact numbers are text, as in \"1/3\"; a value below 1e-300 is a string.";

/// Print cases: all of the catalogue, or one with its formulas, checks and derivation
#[derive(Args)]
#[command(after_help = examples())]
pub(crate) struct Cases {
    /// One case: a name, a channel of it, or a file [default: list all]
    #[arg(value_name = "CASE")]
    name: Option<String>,
    /// List only cases with this tag; repeated, with all of them
    #[arg(long = "tag", value_name = "TAG", conflicts_with = "name")]
    tags: Vec<String>,
    /// Write one JSON document; - is standard output, without the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Draw the case along its ray, as SVG
    #[arg(long, value_name = "FILE", requires = "name", value_parser = figure_file)]
    plot: Option<PathBuf>,
}

fn examples() -> String {
    format!(
        "{SOURCES}

The list has a line a channel: D, the total optical depth t(D) and the exact
radiance I(D) to six digits, and whether the closed form is proved. What is not
proved stands below its line.

{DERIVING}

{JSON}

Examples:
  volver cases
  volver cases --tag jump --tag off-node
  volver cases sine-squared
  volver cases rgb-transfer/red --json -"
    )
}

/// A figure goes to a file.
pub(crate) fn figure_file(text: &str) -> Result<PathBuf, &'static str> {
    match text {
        "-" => Err("no file (allowed: a file that can be written)"),
        text => Ok(text.into()),
    }
}

impl Cases {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let output = output(self.json.as_deref(), self.plot.as_deref());
        output.check()?;
        let derived = waiting("deriving", || match &self.name {
            Some(name) => Ok(vec![case::load(name)?]),
            None => self.listed(),
        })?;
        let document = match (&self.name, &derived[..]) {
            (Some(_), [case]) => document(case, true, &about()),
            _ => list(&derived, &self.tags, &about()),
        };
        output.show(&document, |option| form(option, &derived))?;
        Ok(Outcome::Good)
    }

    /// The cases of the catalogue with all the tags.
    fn listed(&self) -> Result<Vec<Derived>, Failure> {
        let described = catalogue::names().filter_map(|name| Some((name, catalogue::find(name)?)));
        let described = described.map(|(name, description)| {
            let path = || name.to_string();
            let in_file = |error| Failure::CaseFile {
                path: path(),
                error: Box::new(error),
            };
            description.map_err(in_file)
        });
        let mut described: Vec<_> = described.collect::<Result<_, _>>()?;
        let known = described.iter().flat_map(|d| &d.tags);
        let known: BTreeSet<&str> = known.map(String::as_str).collect();
        if let Some(unknown) = self.tags.iter().find(|tag| !known.contains(tag.as_str())) {
            let known: Vec<&str> = known.into_iter().collect();
            return Err(Failure::Usage(format!(
                "no case has the tag '{}' (allowed: {})",
                unknown.escape_debug(),
                known.join(", ")
            )));
        }
        described.retain(|d| self.tags.iter().all(|tag| d.tags.contains(tag)));
        described
            .into_par_iter()
            .map(|description| case::derive(&description.name.clone(), description))
            .collect()
    }
}

/// Where JSON and a figure go.
pub(crate) fn output<'a>(json: Option<&'a Path>, plot: Option<&'a Path>) -> Output<'a> {
    Output {
        out: None,
        files: vec![("--plot", plot), ("--json", json)],
        quiet: false,
        color: Color::Never,
    }
}

/// JSON of all cases, or a figure of the first with all its channels.
pub(crate) fn form(option: &str, derived: &[Derived]) -> Result<String, ReportError> {
    match (option, derived) {
        ("--plot", [case, ..]) => {
            let figure = Figure::new("", case.title(), of_case(&case.cases));
            Ok(svg::figure(&figure))
        }
        _ => json(derived),
    }
}

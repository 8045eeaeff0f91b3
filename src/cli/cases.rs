//! `volver cases`: what there is to verify against, and each case in full.

mod table;

use super::case::{self, Loaded, SOURCES, json};
use super::{Failure, Outcome, write_out};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use volver::case::catalogue;
use volver::document::Figure;
use volver::{render, report};

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

{}

Examples:
  volver cases
  volver cases --tag jump --tag off-node
  volver cases sine-squared
  volver cases rgb-transfer/red --json -",
        json::HELP
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
        check_places(self.json.as_deref(), self.plot.as_deref())?;
        let (loaded, text) = if let Some(name) = &self.name {
            let loaded = case::load(name)?;
            let text = case::text::render(&loaded, super::width(), true);
            (vec![loaded], text)
        } else {
            let loaded = self.listed()?;
            let text = table::render(&loaded, &self.tags, super::width());
            (loaded, text)
        };
        if let (Some(file), Some(loaded)) = (&self.plot, loaded.first()) {
            plot(file, loaded)?;
        }
        write(&text, self.json.as_deref(), &loaded)?;
        Ok(Outcome::Good)
    }

    /// The cases of the catalogue with all the tags.
    fn listed(&self) -> Result<Vec<Loaded>, Failure> {
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
        let known = table::tags(described.iter().map(|d| &d.tags[..]));
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

/// Refuses places that cannot be written before the work is done.
pub(crate) fn check_places(json: Option<&Path>, plot: Option<&Path>) -> Result<(), Failure> {
    let json = json.filter(|file| *file != Path::new("-"));
    for file in [json, plot].into_iter().flatten() {
        report::check_file(file)?;
    }
    Ok(())
}

/// Draws all channels that were loaded.
pub(crate) fn plot(file: &Path, loaded: &Loaded) -> Result<(), Failure> {
    let description = &loaded.description;
    let title = if description.title.is_empty() {
        &description.name
    } else {
        &description.title
    };
    let figure = Figure::new("", title, report::plots::of_case(&loaded.cases));
    Ok(report::write_file(file, &render::svg::figure(&figure))?)
}

/// The JSON document to its place, and the text to standard output unless that is the document's.
pub(crate) fn write(text: &str, json: Option<&Path>, loaded: &[Loaded]) -> Result<(), Failure> {
    let Some(file) = json else {
        return write_out(text);
    };
    let document = json::render(loaded.iter()).map_err(|error| Failure::Output(error.into()))?;
    if file == Path::new("-") {
        return write_out(&document);
    }
    report::write_file(file, &document)?;
    write_out(text)
}

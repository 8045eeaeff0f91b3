//! `volver report`: several reports on one page.

use super::about::about;
use super::output::noun;
use super::{Failure, Outcome, waiting, write_out};
use clap::Args;
use std::path::{Path, PathBuf};
use volver::render::{self, html};
use volver::report::comparison::{Comparison, compare, read_all};

/// What the page is called where nothing else is said.
const FILE: &str = "report.html";

const EXAMPLES: &str = "\
What differs comes first: facts side by side, then every cell of a table that shows
something else than in the first DIR, and by how much. All tables and plots follow.
Tables are compared where reports of one kind have them under the same heading.
Where PLACE is a directory, or has no extension, the page is PLACE/report.html.

Work: to read the pages, of at most 64 MiB each, and to compare their cells.

Examples:
  volver report before after
  volver report before after --out comparison.html
  volver report after --out pages";

/// Merge the pages of several --out directories into one, and compare them
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Report {
    /// Directories that other subcommands wrote with --out
    #[arg(value_name = "DIR", required = true)]
    directories: Vec<PathBuf>,
    /// Where the page goes, a file or a directory [default: report.html]
    #[arg(long, value_name = "PLACE")]
    out: Option<PathBuf>,
    /// Print nothing
    #[arg(long)]
    quiet: bool,
}

impl Report {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let parts = waiting("reading", || read_all(&self.directories))
            .map_err(|error| Failure::Usage(error.to_string()))?;
        let file = place(self.out.as_deref());
        match file.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => render::make_directory(parent)?,
            _ => {}
        }
        render::check_file(&file)?;
        let comparison = waiting("comparing", || -> Result<_, Failure> {
            let comparison = compare(&parts, about());
            render::write_file(&file, &html::render(&comparison.page)?)?;
            Ok(comparison)
        })?;
        if !self.quiet {
            write_out(&summary(&comparison, parts.len(), &file))?;
        }
        Ok(Outcome::Good)
    }
}

/// A file as it is given, or in the directory that is.
fn place(out: Option<&Path>) -> PathBuf {
    match out {
        None => FILE.into(),
        Some(out) if out.is_dir() || out.extension().is_none() => out.join(FILE),
        Some(out) => out.into(),
    }
}

/// "2 reports in report.html: of 40 cells in both 1 verdict and 3 others differ".
fn summary(comparison: &Comparison, reports: usize, file: &Path) -> String {
    let mut text = format!(
        "{} in {}",
        noun(reports, "report", "reports"),
        file.display()
    );
    if reports > 1 {
        text += &format_args!(
            ": of {} compared, {} and {} differ",
            noun(comparison.cells, "cell", "cells"),
            noun(comparison.verdicts, "verdict", "verdicts"),
            noun(comparison.others, "other", "others"),
        )
        .to_string();
    }
    text + "\n"
}

//! What a study hands out, whoever ran its units.

use crate::cli::output::{Output, csv, said};
use crate::cli::{Color, Failure, Outcome};
use clap::Args;
use std::path::{Path, PathBuf};
use volver::document::About;
use volver::report::study;
use volver::study::sweep::{Divided, Line, Results, Unit};

/// Where finished units are kept.
pub(in crate::cli) const JOURNAL: &str = "study.jsonl";

/// Where they are handed out to, besides a directory.
#[derive(Args)]
pub(in crate::cli) struct Forms {
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) json: Option<PathBuf>,
    /// Write all levels as CSV; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) csv: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    pub(in crate::cli) quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    pub(in crate::cli) color: Color,
}

impl Forms {
    /// The same, and the directory.
    pub(in crate::cli) fn output<'a>(&'a self, out: Option<&'a Path>) -> Output<'a> {
        Output {
            out,
            files: vec![
                ("--json", self.json.as_deref()),
                ("--csv", self.csv.as_deref()),
            ],
            quiet: self.quiet,
            color: self.color,
        }
    }
}

/// Reports of finished units, and whether one contradicts theory.
pub(in crate::cli) fn hand_out(
    work: Divided,
    units: Vec<Unit>,
    about: &About,
    output: &Output<'_>,
) -> Result<Outcome, Failure> {
    let Divided {
        header,
        sweep_bits,
        swept,
        ..
    } = work;
    let results = Results::new(header, sweep_bits, units, &swept).map_err(said)?;
    let document = study::document(&results, about);
    output.hand_out(
        &document,
        |directory| {
            let mut files = study::write(directory, &results, about)?;
            files.push(directory.join(JOURNAL));
            Ok(files)
        },
        |option| match option {
            "--csv" => csv(&document),
            _ => study::json(&results),
        },
    )?;
    let contradicts = |line: &Line| !line.swept && line.contradicts_theory();
    Ok(if results.lines.iter().any(contradicts) {
        Outcome::CheckFailed
    } else {
        Outcome::Good
    })
}

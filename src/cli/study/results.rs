//! What a study hands out, whoever ran its units.

use crate::cli::output::{Output, csv, said};
use crate::cli::{Failure, Outcome};
use volver::document::About;
use volver::report::study;
use volver::study::sweep::{Divided, Line, Results, Unit};

/// Where finished units are kept.
pub(in crate::cli) const JOURNAL: &str = "study.jsonl";

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

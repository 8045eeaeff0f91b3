//! `volver verify --extremes`: a kernel where numbers end.

use super::about::about;
use super::kernel::KernelArguments;
use super::output::Output;
use super::{Bar, Failure, Outcome};
use volver::report::extremes::{document, json, write};
use volver::study::extremes::{extremes, work};

/// Asks a kernel, and hands out what it showed.
pub(super) fn run(named: &KernelArguments, output: &Output<'_>) -> Result<Outcome, Failure> {
    let at_once = named.at_once()?;
    output.check()?;
    let mut kernel = at_once.map_or_else(|| named.program(), Ok)?;
    let bar = Bar::new(work(kernel.declaration()));
    let found = extremes(kernel.as_mut(), &bar);
    bar.finish();
    named.still_there(kernel.as_ref())?;
    // The child is gone before the last word.
    drop(kernel);
    let found = found.map_err(|error| named.failed(error))?;
    if let Some(why) = found.without_answer() {
        return Err(named.failed(anyhow::anyhow!(why.to_string())));
    }
    output.hand_out(
        &document(&found, &about()),
        |directory| write(directory, &found, &about()),
        |_| json(&found),
    )?;
    Ok(if found.faults().next().is_some() {
        Outcome::CheckFailed
    } else {
        Outcome::Good
    })
}

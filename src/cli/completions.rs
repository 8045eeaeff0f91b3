//! `volver completions`: completion scripts.

use super::{Arguments, Failure, Outcome, write_out};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print a completion script for a shell
#[derive(Args)]
#[command(after_help = "Work: none that grows with anything.")]
pub(crate) struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), "volver", &mut script);
        write_out(&String::from_utf8_lossy(&script))?;
        Ok(Outcome::Good)
    }
}

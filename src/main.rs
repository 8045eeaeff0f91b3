//! The command line tool; see `volver --help` and the library's documentation.

// A test may stop at what a program must not.
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = cli::parse().and_then(cli::Command::run);
    cli::report(outcome)
}

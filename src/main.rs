//! The command line tool; see `volver --help` and the library's documentation.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::memory::share();
    let outcome = cli::parse().and_then(cli::Command::run);
    cli::report(outcome)
}

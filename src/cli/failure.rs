//! Why a run came to no end, in one line: what, where, allowed; of files also the place, drawn.

use clap::CommandFactory;
use clap::error::ErrorKind;
use std::io;
use volver::case::FileError;
use volver::case::manufacture::ManufactureError;
use volver::input::InputError;
use volver::report::ReportError;

/// Why there is no outcome.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Help or version was asked for: the text to show, and no failure at all.
    #[error("{0}")]
    Shown(String),
    /// The command line is wrong.
    #[error("{0}")]
    Usage(String),
    /// A file cannot be read, or is too long.
    #[error("{path}: {error}")]
    Input {
        /// The path as given.
        path: String,
        /// Why.
        error: InputError,
    },
    /// What is in a file is wrong.
    #[error("{path}: {error}")]
    Content {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: anyhow::Error,
    },
    /// A case file is wrong somewhere.
    #[error("{path}: {error}")]
    CaseFile {
        /// The path as given.
        path: String,
        /// What is wrong, and where.
        error: Box<FileError>,
    },
    /// What a case states does not hold: a check that failed, and no wrong usage.
    #[error("{path}: verification failed: {error}")]
    Refuted {
        /// The path, or the name, as given.
        path: String,
        /// What is refuted, and where.
        error: Box<ManufactureError>,
    },
    /// A kernel cannot be put to the test.
    #[error("{kernel}: {error}")]
    Kernel {
        /// As given.
        kernel: String,
        /// Why.
        error: anyhow::Error,
    },
    /// A report cannot be made or written.
    #[error("{0} (allowed: a place that can be written)")]
    Report(#[from] ReportError),
    /// Standard output cannot be written.
    #[error("standard output: {0} (allowed: a reader that reads to the end)")]
    Output(io::Error),
}

impl Failure {
    /// Whether a pipe was closed that something was to be written to.
    pub(crate) fn is_closed_pipe(&self) -> bool {
        let error = match self {
            Failure::Output(error) => error,
            // Standard output by another name.
            Failure::Report(ReportError::File { reason, .. }) => reason,
            _ => return false,
        };
        error.kind() == io::ErrorKind::BrokenPipe
    }

    /// 1 where a check failed, 2 where usage or input is wrong.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Failure::Refuted { .. } => 1,
            _ => 2,
        }
    }

    /// Lines that show the place in a file, to go below the message.
    pub(crate) fn excerpt(&self) -> Option<String> {
        match self {
            Failure::CaseFile { error, .. } => error.caret(),
            _ => None,
        }
    }
}

impl From<clap::Error> for Failure {
    fn from(error: clap::Error) -> Self {
        let text = error.render().to_string();
        match error.kind() {
            ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Failure::Shown(text),
            kind => Failure::Usage(one_line(kind, &text)),
        }
    }
}

/// The first paragraph of clap's message in one line, and what is allowed.
fn one_line(kind: ErrorKind, text: &str) -> String {
    let paragraph: Vec<&str> = text
        .lines()
        .take_while(|line| !line.trim().is_empty())
        .map(str::trim)
        .collect();
    let line = paragraph.join(" ");
    let line = line.strip_prefix("error: ").unwrap_or(&line);
    let line = line
        .replace("[possible values: ", "(allowed: ")
        .replace("[subcommands: ", "(allowed: ");
    match line.strip_suffix(']') {
        Some(line) => format!("{line})"),
        None if line.contains("(allowed: ") => line,
        None if kind == ErrorKind::InvalidSubcommand => {
            let command = super::Arguments::command();
            let names: Vec<&str> = command
                .get_subcommands()
                .map(clap::Command::get_name)
                .collect();
            format!("{line} (allowed: {})", names.join(", "))
        }
        None => format!("{line} (allowed: see --help)"),
    }
}

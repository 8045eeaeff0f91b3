//! A program that is run once, to its end.

use super::child::{how, reap};
use super::ending::ends_within;
use super::registry;
use super::tail::Tail;
use std::fs::{self, File};
use std::io;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// How many of its last lines are shown.
const LAST_LINES: usize = 1;

/// How a program ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// With code 0.
    Well,
    /// Otherwise.
    Badly {
        /// "exited with code 3", "was killed by signal 11".
        how: String,
        /// The last line that it wrote to standard error, or to its output.
        said: String,
    },
    /// It was killed, having taken longer than allowed.
    Late,
}

/// Runs a program to its end, in a process group of its own of which nothing is left.
///
/// # Errors
/// The system's, where it could not be started.
pub fn once(program: &str, arguments: &[String], patience: Duration) -> io::Result<Ended> {
    let mut command = Command::new(program);
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .process_group(0);
    let (mut process, group) = registry::spawn(&mut command)?;
    let output = process
        .stdout
        .take()
        .map(|pipe| Tail::of(File::from(std::os::fd::OwnedFd::from(pipe)), None));
    let errors = process
        .stderr
        .take()
        .map(|pipe| Tail::of(File::from(std::os::fd::OwnedFd::from(pipe)), None));
    let in_time = ends_within(group, patience);
    let status = reap(&mut process, group);
    let said = |tail: Option<io::Result<Tail>>| {
        let tail = tail.and_then(Result::ok);
        tail.map_or(String::new(), |tail| tail.last_lines(LAST_LINES))
    };
    let (output, errors) = (said(output), said(errors));
    Ok(match status {
        _ if !in_time => Ended::Late,
        Some(status) if status.success() => Ended::Well,
        Some(status) => Ended::Badly {
            how: how(status),
            said: if errors.is_empty() { output } else { errors },
        },
        None => Ended::Badly {
            how: "ended in no known way".into(),
            said: errors,
        },
    })
}

/// A directory of files for a program, which nobody else can read; it goes with this value, and on Ctrl-C.
#[derive(Debug)]
pub struct Directory(PathBuf);

impl Directory {
    /// A new one.
    ///
    /// # Errors
    /// The system's.
    pub fn new() -> io::Result<Self> {
        let path = super::files::directory()?;
        registry::hold_directory(&path);
        Ok(Directory(path))
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
        registry::forget_directory(&self.0);
    }
}

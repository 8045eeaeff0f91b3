//! Coq at work: the theory compiled once, then any number of files on it.

use super::Script;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The part of `proofs/theory/` that cases rest on, in the order of their dependence.
const THEORY: [(&str, &str); 3] = [
    ("Integral.v", include_str!("../../proofs/theory/Integral.v")),
    ("Erf.v", include_str!("../../proofs/theory/Erf.v")),
    (
        "CaseTactic.v",
        include_str!("../../proofs/theory/CaseTactic.v"),
    ),
];

/// How long Coq may take over the theory, which takes seconds.
const THEORY_TIME: Duration = Duration::from_secs(300);

/// How often a running Coq is asked whether it has come to an end.
const PAUSE: Duration = Duration::from_millis(10);

/// What came of a theorem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Coq accepts the proof.
    Proved,
    /// Coq does not: the statement is wrong, or beyond the tactic.
    Failed {
        /// Coq's message.
        message: String,
    },
    /// No end within the time allowed.
    OutOfTime {
        /// That time.
        limit: Duration,
    },
}

/// Why nothing can be checked on this machine.
#[derive(Debug, thiserror::Error)]
pub enum CoqMissing {
    /// The program does not run.
    #[error("'{program}' does not run: {error} (allowed: coqc of Coq 8.16 or later)")]
    Program {
        /// The program.
        program: String,
        /// What the system said.
        error: io::Error,
    },
    /// The theory does not compile, mostly because a library is not there.
    #[error("Coq does not compile {file}: {message} (allowed: Coq 8.16 or later with Coquelicot)")]
    Theory {
        /// The file of the theory.
        file: &'static str,
        /// Coq's message.
        message: String,
    },
    /// There is no place for Coq's files.
    #[error("no place for Coq's files: {0} (allowed: a temporary directory that can be written)")]
    Folder(#[from] io::Error),
}

/// Coq with the theory of cases compiled; its files go with it.
#[derive(Debug)]
pub struct Coq {
    program: OsString,
    folder: TempDir,
}

impl Coq {
    /// Compiles the theory with that `coqc`.
    ///
    /// # Errors
    /// [`CoqMissing`] where the program does not run, or its libraries are not there.
    pub fn start(program: &OsStr) -> Result<Self, CoqMissing> {
        let coq = Coq {
            program: program.into(),
            folder: TempDir::with_prefix("volver-proofs-")?,
        };
        fs::create_dir(coq.folder.path().join("theory"))?;
        for (file, text) in THEORY {
            let path = coq.folder.path().join("theory").join(file);
            fs::write(&path, text)?;
            match coq.compile(&path, THEORY_TIME) {
                Ok(Verdict::Proved) => {}
                Ok(Verdict::Failed { message }) => {
                    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
                    return Err(CoqMissing::Theory { file, message });
                }
                Ok(Verdict::OutOfTime { limit }) => {
                    let message = format!("no end within {} s", limit.as_secs());
                    return Err(CoqMissing::Theory { file, message });
                }
                Err(error) => {
                    let program = program.display().to_string();
                    return Err(CoqMissing::Program { program, error });
                }
            }
        }
        Ok(coq)
    }

    /// Has the theorems of a file checked.
    ///
    /// # Errors
    /// What the system says where files cannot be written or the program does not start.
    pub fn check(&self, script: &Script, limit: Duration) -> io::Result<Verdict> {
        let folder = TempDir::new_in(self.folder.path())?;
        let path = folder.path().join(format!("{}.v", script.name));
        fs::write(&path, &script.text)?;
        self.compile(&path, limit)
    }

    fn compile(&self, path: &Path, limit: Duration) -> io::Result<Verdict> {
        let log = path.with_extension("log");
        let theory = self.folder.path().join("theory");
        let mut coq = Command::new(&self.program);
        coq.args(["-q", "-w", "none", "-R"]).arg(theory);
        coq.arg("Volver").arg(path);
        coq.stdin(Stdio::null()).stdout(Stdio::null());
        coq.stderr(File::create(&log)?);
        let Some(status) = wait(coq, limit)? else {
            return Ok(Verdict::OutOfTime { limit });
        };
        if status.success() {
            return Ok(Verdict::Proved);
        }
        let message = String::from_utf8_lossy(&fs::read(&log)?).into_owned();
        let message = match (message.trim(), status.code()) {
            ("", Some(code)) => format!("exit code {code}"),
            ("", None) => "ended by a signal".into(),
            (said, _) => match path.parent() {
                // The temporary folder tells nobody anything.
                Some(folder) => said.replace(&format!("{}/", folder.display()), ""),
                None => said.into(),
            },
        };
        Ok(Verdict::Failed { message })
    }
}

/// Runs the program to its end; `None` where it had to be stopped.
fn wait(mut command: Command, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let mut child = command.spawn()?;
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() >= limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(PAUSE);
    }
}

//! `volver prove`: cases as theorems, checked by Coq where it is installed.

use super::about::about;
use super::case::{self, DERIVING, SOURCES};
use super::output::Output;
use super::{Bar, Color, Failure, Outcome, waiting, width, write_out};
use clap::Args;
use rayon::prelude::*;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;
use volver::case::catalogue;
use volver::input::{self, InputError};
use volver::proof::{Coq, MARK, Script, Verdict, script};
use volver::render;
use volver::report::cases::Derived;
use volver::report::proofs::{Fate, Proof, document, json, row, table};
use volver::study::Progress;

/// What the help says of the document.
const JSON: &str = "\
JSON: volver (its version) and proofs, an object a case: case, file, theorems (as
Coq calls them in the file), outcome (proved, failed, not checked, not stated) and
reason, which is Coq's message where the proof failed.";

/// State cases as theorems and have Coq check them
#[derive(Args)]
#[command(after_help = examples())]
pub(crate) struct Prove {
    /// The case file, a name of the catalogue, or - for standard input
    #[arg(
        value_name = "CASE",
        required_unless_present = "all",
        conflicts_with = "all"
    )]
    case: Option<String>,
    /// All cases of the catalogue that can be stated
    #[arg(long)]
    all: bool,
    /// Where the files for Coq go, made if it is missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    write: PathBuf,
    /// Only write the files
    #[arg(long)]
    no_check: bool,
    /// The compiler of Coq
    #[arg(long, value_name = "PROGRAM", default_value = "coqc")]
    coqc: OsString,
    /// Seconds that Coq may take over one file
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 120,
        value_parser = clap::value_parser!(u64).range(1..=86400)
    )]
    timeout: u64,
    /// Write one JSON document; - is standard output, without the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

fn examples() -> String {
    format!(
        "{SOURCES}

The theorem says, for every D on the ray, that optical depth and volume rendering
integral exist and are the closed forms of the case. A case needs a closed form
without branches and fractional powers for it. Checking takes Coq 8.16 or later with
Coquelicot (Debian: apt-get install coq libcoq-coquelicot), and seconds a case.

The exit code is 1 where a theorem failed, or was not checked although --no-check did
not ask for that. A file that volver did not write is not overwritten.

{DERIVING} Coq has --timeout for each file; a bar on the
terminal says how much is left.

{JSON}

Examples:
  volver prove sine-squared --no-check --write target/proofs
  volver prove --all --no-check --write target/proofs --json -"
    )
}

impl Prove {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let output = self.output();
        output.check()?;
        let loaded = waiting("deriving", || self.loaded())?;
        let mut proofs = Vec::new();
        let mut scripts = Vec::new();
        for Derived { description, cases } in &loaded {
            match script(description, cases) {
                Ok(script) => scripts.push((description.name.clone(), script)),
                Err(error) if self.all => {
                    proofs.push(Proof::new(
                        &description.name,
                        Fate::NotStated(error.to_string()),
                    ));
                }
                Err(error) => {
                    return Err(Failure::Content {
                        path: self.case.clone().unwrap_or_default(),
                        error: error.into(),
                    });
                }
            }
        }
        let quiet = !output.prints_text();
        for proof in &proofs {
            say(proof, quiet)?;
        }
        let files: Vec<PathBuf> = scripts
            .iter()
            .map(|(_, script)| self.write_script(script))
            .collect::<Result<_, _>>()?;
        proofs.extend(self.check(&scripts, &files, quiet)?);
        proofs.sort_by(|a, b| a.case.cmp(&b.case));
        self.finish(&proofs)
    }

    fn output(&self) -> Output<'_> {
        Output {
            out: None,
            files: vec![("--json", self.json.as_deref())],
            quiet: false,
            color: Color::Never,
        }
    }

    fn loaded(&self) -> Result<Vec<Derived>, Failure> {
        match &self.case {
            Some(case) => Ok(vec![case::load(case)?]),
            None => catalogue::names()
                .collect::<Vec<_>>()
                .into_par_iter()
                .map(case::load)
                .collect(),
        }
    }

    /// Writes a file for Coq, but over none that somebody else wrote.
    fn write_script(&self, script: &Script) -> Result<PathBuf, Failure> {
        let file = self.write.join(format!("{}.v", script.name));
        let cannot = |error: std::io::Error| Failure::Content {
            path: file.display().to_string(),
            error: anyhow::anyhow!("{error} (allowed: a place that can be written)"),
        };
        if file.exists() && !is_ours(&file)? {
            return Err(Failure::Usage(format!(
                "{}: not written by volver, and so not overwritten (allowed: another --write)",
                file.display()
            )));
        }
        fs::create_dir_all(&self.write).map_err(cannot)?;
        render::write_file(&file, &script.text)?;
        Ok(file)
    }

    /// Has Coq check the files, and says of each what came of it as soon as it is known.
    fn check(
        &self,
        scripts: &[(String, Script)],
        files: &[PathBuf],
        quiet: bool,
    ) -> Result<Vec<Proof>, Failure> {
        let coq = if self.no_check {
            Err("as asked".to_string())
        } else {
            Coq::start(&self.coqc).map_err(|missing| missing.to_string())
        };
        let bar = Bar::new(scripts.len() as u64);
        let said = Mutex::new(Ok(()));
        let work = scripts.par_iter().zip(files);
        let proofs = work.map(|((name, script), file)| {
            let fate = match &coq {
                Err(reason) => Fate::NotChecked(reason.clone()),
                Ok(coq) => match coq.check(script, Duration::from_secs(self.timeout)) {
                    Ok(Verdict::Proved) => Fate::Proved,
                    Ok(Verdict::Failed { message }) => Fate::Failed(message),
                    Ok(Verdict::OutOfTime { limit }) => {
                        Fate::Failed(format!("no end within {} s", limit.as_secs()))
                    }
                    Err(error) => Fate::NotChecked(error.to_string()),
                },
            };
            let proof = Proof {
                file: Some(file.display().to_string()),
                theorems: script.theorems.clone(),
                ..Proof::new(name, fate)
            };
            if let Ok(mut said) = said.lock()
                && said.is_ok()
            {
                bar.above(|| *said = say(&proof, quiet));
            }
            bar.advance(1);
            proof
        });
        let proofs = proofs.collect();
        bar.finish();
        said.into_inner().unwrap_or(Ok(()))?;
        Ok(proofs)
    }

    fn finish(&self, proofs: &[Proof]) -> Result<Outcome, Failure> {
        let mut last = String::new();
        let output = self.output();
        if self.all && output.prints_text() {
            let conclusion = document(proofs, &about()).conclusion;
            last = conclusion.map_or(last, |conclusion| conclusion.words + "\n");
        }
        output.print(last, |_| json(proofs))?;
        let good = proofs.iter().all(|proof| match proof.fate {
            Fate::Proved | Fate::NotStated(_) => true,
            Fate::NotChecked(_) => self.no_check,
            Fate::Failed(_) => false,
        });
        Ok(if good {
            Outcome::Good
        } else {
            Outcome::CheckFailed
        })
    }
}

/// Whether volver wrote a file for Coq. None of its own is as long as what people write may be.
fn is_ours(file: &Path) -> Result<bool, Failure> {
    match input::text(file, input::WRITTEN) {
        Ok(text) => Ok(text.contains(MARK)),
        Err(InputError::TooLong { .. } | InputError::NotText { .. }) => Ok(false),
        Err(error) => Err(Failure::Input {
            path: file.display().to_string(),
            error,
        }),
    }
}

fn say(proof: &Proof, quiet: bool) -> Result<(), Failure> {
    if quiet {
        return Ok(());
    }
    write_out(&render::terminal::row(
        &table(),
        &row(proof),
        width(),
        false,
    ))
}

//! `volver new`: a kernel to begin with.

use super::{Failure, Outcome, write_out};
use clap::{Args, ValueEnum};
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use volver::document::quoted;
use volver::render::make_directory;
use volver::report::ReportError;

const EXAMPLES: &str = "\
The kernel composites front to back, one sample in the middle of every segment, and
passes 'volver verify'; its own test runs without volver. Put your renderer's loop in
place of its own. No file is overwritten, and nothing is fetched.

Work: none that grows with anything.

Examples:
  volver new python my-kernel && python3 my-kernel/test_kernel.py
  volver new c my-c-kernel && make -C my-c-kernel kernel test
  volver new rust my-rust-kernel";

/// Write a kernel to begin with, and its test
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct New {
    /// What it is written in
    #[arg(value_enum, value_name = "LANGUAGE")]
    language: Language,
    /// Where to; made where it does not exist
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

#[derive(Clone, Copy, ValueEnum)]
enum Language {
    Python,
    C,
    Rust,
}

/// A file's name, and what is in it.
type Template = (&'static str, &'static str);

const PYTHON: &[Template] = &[
    ("kernel.py", include_str!("new/python/kernel.py")),
    ("test_kernel.py", include_str!("new/python/test_kernel.py")),
    (
        "volver_kernel.py",
        include_str!("../../examples/kernels/volver_kernel.py"),
    ),
];
const C: &[Template] = &[
    ("composite.h", include_str!("new/c/composite.h")),
    ("kernel.c", include_str!("new/c/kernel.c")),
    ("test.c", include_str!("new/c/test.c")),
    (
        "json_lines.h",
        include_str!("../../examples/kernels/json_lines.h"),
    ),
    ("Makefile", include_str!("new/c/Makefile")),
];
// A manifest by its own name would be another package's to Cargo.
const RUST: &[Template] = &[
    ("Cargo.toml", include_str!("new/rust/manifest.toml")),
    ("src/main.rs", include_str!("new/rust/main.rs")),
    ("src/composite.rs", include_str!("new/rust/composite.rs")),
    ("src/json.rs", include_str!("new/rust/json.rs")),
];

impl Language {
    fn templates(self) -> &'static [Template] {
        match self {
            Language::Python => PYTHON,
            Language::C => C,
            Language::Rust => RUST,
        }
    }

    /// What to do next, `@` being the directory.
    fn next(self) -> &'static [&'static str] {
        match self {
            Language::Python => &[
                "python3 @/test_kernel.py",
                "volver verify python3 @/kernel.py",
            ],
            Language::C => &["make -C @ kernel test", "volver verify @/kernel"],
            Language::Rust => &[
                "cargo test --manifest-path @/Cargo.toml",
                "cargo build --release --manifest-path @/Cargo.toml",
                "volver verify @/target/release/kernel",
            ],
        }
    }
}

impl New {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let templates = self.language.templates();
        let path = |name: &str| self.directory.join(name);
        // A link that leads nowhere is there too.
        let is_there = |(name, _): &&Template| path(name).symlink_metadata().is_ok();
        if let Some((name, _)) = templates.iter().find(is_there) {
            let names: Vec<&str> = templates.iter().map(|(name, _)| *name).collect();
            return Err(Failure::Usage(format!(
                "'{}' is there already (allowed: a directory without {})",
                path(name).display(),
                names.join(", ")
            )));
        }
        for (name, text) in templates {
            write_new(&path(name), text)?;
        }
        let directory = self.directory.display().to_string();
        let said = self.language.next().iter();
        let word = quoted(&directory);
        let said: Vec<String> = said.map(|line| line.replace('@', &word)).collect();
        write_out(&format!(
            "written to {directory}; next:\n  {}\n",
            said.join("\n  ")
        ))?;
        Ok(Outcome::Good)
    }
}

/// Writes a file that is not there.
fn write_new(path: &Path, text: &str) -> Result<(), ReportError> {
    if let Some(parent) = path.parent() {
        make_directory(parent)?;
    }
    let written = File::create_new(path).and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|reason| ReportError::File {
        path: path.into(),
        reason,
    })
}

//! What made a page: enough to make it again.

use super::machine::machine;
use serde::{Deserialize, Serialize};
use std::ffi::OsStr;

/// What made a page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// The command, as a shell takes it.
    pub command: String,
    /// The version of this crate.
    pub version: String,
    /// The seeds of random numbers, where there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub seeds: Vec<u64>,
    /// Operating system, architecture, processor and cores: no names of people or hosts.
    pub machine: String,
}

impl About {
    /// This version on this machine, run with these arguments, the program's name first.
    ///
    /// Of a program given by its path the file's name is kept: where it is installed is nobody's business.
    #[must_use]
    pub fn new(arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Self {
        let mut words = Vec::new();
        for argument in arguments {
            let argument = argument.as_ref();
            let shown = match std::path::Path::new(argument).file_name() {
                Some(name) if words.is_empty() => name,
                _ => argument,
            };
            words.push(quoted(&shown.to_string_lossy()));
        }
        About {
            command: words.join(" "),
            version: env!("CARGO_PKG_VERSION").into(),
            seeds: Vec::new(),
            machine: machine(),
        }
    }
}

/// A word that a POSIX shell takes as it stands.
#[must_use]
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:,=@%+^".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

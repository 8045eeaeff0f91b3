//! Cases by name or from files, for every command that takes one.

mod nearest;

use super::Failure;
use super::input::read;
use std::path::Path;
use volver::case::catalogue;
use volver::case::file::MAX_FILE;
use volver::case::manufacture::{self, ManufactureError, Manufactured};
use volver::case::{Description, FileError};
use volver::confirm;
use volver::report::cases::Derived;

/// What a command line may say where it takes a case, for help texts.
pub(crate) const SOURCES: &str = "\
CASE is a name that 'volver cases' lists (sine-squared), one channel of such a
case (rgb-transfer/red), or a file: any path with a / in it or .toml at its end,
and - for standard input. docs/cases.md describes files.";

/// What deriving a case takes at most, for help texts.
pub(crate) const DERIVING: &str = "\
Work: a file of at most 1 MiB; a statement that would take more than 60000 steps of
its proof stays undecided.";

/// Where a case comes from.
enum Source<'a> {
    Catalogue {
        name: &'a str,
        channel: Option<&'a str>,
    },
    File(&'a str),
}

/// Finds, reads, derives and checks the case that `argument` names, for a command that needs a medium: what is none
/// is wrong input.
///
/// The closed forms of the catalogue are compared with the integral by the tests, which takes longer than to verify a
/// kernel by them; those of files are here.
pub(crate) fn medium(argument: &str) -> Result<Derived, Failure> {
    let loaded = source(argument).and_then(|source| match source {
        Source::Catalogue { .. } => {
            derived(argument, source.read(argument)?, manufacture::manufacture)
        }
        Source::File(_) => derive(argument, source.read(argument)?),
    });
    match loaded {
        Err(Failure::Refuted { path, error }) if error.is_of_medium() => Err(Failure::Content {
            path,
            error: anyhow::Error::new(*error),
        }),
        loaded => loaded,
    }
}

/// Finds, reads, derives and checks the case that `argument` names.
pub(crate) fn load(argument: &str) -> Result<Derived, Failure> {
    derive(argument, source(argument)?.read(argument)?)
}

/// Derives and checks what a file describes; `path` is for messages.
pub(crate) fn derive(path: &str, description: Description) -> Result<Derived, Failure> {
    derived(path, description, confirm::manufacture)
}

fn derived(
    path: &str,
    description: Description,
    manufacture: impl Fn(&Description) -> Result<Vec<Manufactured>, ManufactureError>,
) -> Result<Derived, Failure> {
    match manufacture(&description) {
        Ok(cases) => Ok(Derived { description, cases }),
        Err(error @ (ManufactureError::Refuted { .. } | ManufactureError::Contradicted(_))) => {
            Err(Failure::Refuted {
                path: path.into(),
                error: Box::new(error),
            })
        }
        Err(error) => Err(Failure::Content {
            path: path.into(),
            error: error.into(),
        }),
    }
}

impl Source<'_> {
    /// What it describes; `argument` is for messages.
    fn read(&self, argument: &str) -> Result<Description, Failure> {
        match *self {
            Source::Catalogue { name, channel } => {
                let description = catalogue::find(name).ok_or_else(|| unknown(name))?;
                let description = description.map_err(|error| in_file(argument, error))?;
                chosen(description, channel)
            }
            Source::File(path) => Description::read(&read(path, MAX_FILE as u64)?)
                .map_err(|error| in_file(path, error)),
        }
    }
}

fn source(argument: &str) -> Result<Source<'_>, Failure> {
    if argument == "-" {
        return Ok(Source::File(argument));
    }
    let (name, channel) = match argument.split_once('/') {
        Some((name, channel)) => (name, Some(channel)),
        None => (argument, None),
    };
    let is_known = catalogue::text(name).is_some();
    // A directory may be called like a case.
    if is_known && (channel.is_none() || !Path::new(argument).is_file()) {
        return Ok(Source::Catalogue { name, channel });
    }
    if channel.is_some() || has_extension(argument) {
        return Ok(Source::File(argument));
    }
    Err(unknown(argument))
}

fn has_extension(path: &str) -> bool {
    Path::new(path).extension().is_some_and(|e| e == "toml")
}

fn unknown(name: &str) -> Failure {
    let near = nearest::nearest(name, catalogue::names());
    let near = if near.is_empty() {
        String::new()
    } else {
        format!("nearest: {}; ", near.join(", "))
    };
    Failure::Usage(format!(
        "no case '{}' ({near}allowed: see volver cases, or a path with / or ending in .toml)",
        name.escape_debug()
    ))
}

/// The description with only the channel asked for.
fn chosen(mut description: Description, channel: Option<&str>) -> Result<Description, Failure> {
    let Some(channel) = channel else {
        return Ok(description);
    };
    let names: Vec<String> = description
        .channels
        .iter()
        .filter_map(|c| c.name.clone())
        .collect();
    description
        .channels
        .retain(|c| c.name.as_deref() == Some(channel));
    if !description.channels.is_empty() {
        return Ok(description);
    }
    let name = &description.name;
    let allowed: Vec<String> = if names.is_empty() {
        vec![name.clone()]
    } else {
        names.iter().map(|c| format!("{name}/{c}")).collect()
    };
    Err(Failure::Usage(format!(
        "no channel '{}' in {name} (allowed: {})",
        channel.escape_debug(),
        allowed.join(", ")
    )))
}

fn in_file(path: &str, error: FileError) -> Failure {
    Failure::CaseFile {
        path: path.into(),
        error: Box::new(error),
    }
}

//! Kernels by what stands on a command line, and the cases they are tested on.

use super::{Failure, case, gallery, waiting};
use clap::Args;
use rug::Rational;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;
use volver::case::{Case, catalogue};
use volver::kernel::library::LibraryKernel;
use volver::kernel::process::{self, Descriptors, Log, Options, ProcessKernel};
use volver::kernel::{BuiltIn, Kernel, Subject};
use volver::method::Method;
use volver::real::FormatName;
use volver::report::ReportError;

/// What a kernel may be, for help texts.
pub(super) const KERNELS: &str = "\
KERNEL is a program with its arguments, which is sent rays as JSON lines
(docs/protocol.md says how); a shared library, a path that ends in .so, .dylib or
.dll (include/volver.h); a method of volver's own, method:NAME[@FORMAT]; what a real
package computes, gallery:NAME ('volver gallery' lists them); or, of a process that is a
kernel and starts volver itself, fd:READ,WRITE, descriptors of pipes that volver reads
answers from and writes requests to.
What stands behind KERNEL is the program's: options of volver stand in front of it.";

/// Extensions of shared libraries.
const LIBRARIES: [&str; 3] = ["so", "dylib", "dll"];

/// Which kernel, and how long it is waited for.
#[derive(Args)]
pub(super) struct KernelArguments {
    // One list, so that all behind KERNEL is the program's, --timeout too.
    /// Program with its arguments, shared library, method:NAME[@FORMAT], gallery:NAME or fd:READ,WRITE
    #[arg(value_name = "KERNEL", required = true, trailing_var_arg = true)]
    command: Vec<String>,
    /// Seconds that a program may take to an answer
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds, allow_negative_numbers = true)]
    timeout: f64,
    /// Seconds that a program may take to start
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds, allow_negative_numbers = true)]
    start_timeout: f64,
    /// Keep all that volver and a program say to each other, and what the program prints
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
}

/// More than nothing, and no more than a week.
fn seconds(text: &str) -> Result<f64, String> {
    let seconds: Option<f64> = text.parse().ok();
    seconds
        .filter(|seconds| (0.001..=604_800.0).contains(seconds))
        .ok_or_else(|| "no time (allowed: 0.001 to 604800)".into())
}

impl KernelArguments {
    /// All of it as it stands on the command line.
    pub(super) fn words(&self) -> &[String] {
        &self.command
    }

    fn kernel(&self) -> &str {
        self.command.first().map_or("", String::as_str)
    }

    fn arguments(&self) -> &[String] {
        self.command.get(1..).unwrap_or_default()
    }

    /// What need not be started, so that what is wrong with it is said before any work; `None` of a program.
    pub(super) fn at_once(&self) -> Result<Option<Box<dyn Kernel>>, Failure> {
        if let Some(method) = self.kernel().strip_prefix("method:") {
            self.no_program("a method")?;
            return built_in(method).map(Some);
        }
        if let Some(name) = self.kernel().strip_prefix(gallery::PREFIX) {
            self.no_program("a row of the gallery")?;
            return gallery::kernel(name).map(Some);
        }
        if self.is_library() {
            self.no_program("a library")?;
            let path = Path::new(self.kernel());
            let library = LibraryKernel::open(path).map_err(|error| self.failed(error))?;
            return Ok(Some(Box::new(library)));
        }
        Ok(None)
    }

    /// Whatever it is, ready to be asked.
    pub(super) fn started(&self) -> Result<Box<dyn Kernel>, Failure> {
        self.at_once()?.map_or_else(|| self.program(), Ok)
    }

    /// The method and its name, where it is one of volver's own.
    pub(super) fn method(&self) -> Result<Option<(String, Method)>, Failure> {
        if !self.kernel().starts_with("method:") {
            return Ok(None);
        }
        let kernel = self.started()?;
        let declaration = kernel.declaration();
        let method = declaration.method;
        Ok(method.map(|method| (declaration.name.clone(), method)))
    }

    /// Another kernel, by words with blanks between them, which is waited for as long.
    pub(super) fn another(&self, command: &str) -> Self {
        KernelArguments {
            command: command.split_whitespace().map(Into::into).collect(),
            timeout: self.timeout,
            start_timeout: self.start_timeout,
            // The log is the first one's.
            log: None,
        }
    }

    /// Starts the program. Whatever ends this process from the keyboard ends the kernel's too.
    pub(super) fn program(&self) -> Result<Box<dyn Kernel>, Failure> {
        let log = self.log.as_deref().map(|path| {
            Log::create(path).map_err(|reason| ReportError::File {
                path: path.into(),
                reason,
            })
        });
        let options = Options {
            log: log.transpose()?,
            start_timeout: Duration::from_secs_f64(self.start_timeout),
            timeout: Duration::from_secs_f64(self.timeout),
            ..Options::default()
        };
        // 128 and the number of the signal, as shells have it.
        let handler = || process::stop_all_and_exit(130);
        match ctrlc::set_handler(handler) {
            // That of the first program stops all.
            Ok(()) | Err(ctrlc::Error::MultipleHandlers) => {}
            Err(error) => return Err(self.failed(error)),
        }
        let started = match self.descriptors()? {
            Some(descriptors) => ProcessKernel::caller(descriptors, options),
            None => ProcessKernel::start(self.kernel(), self.arguments(), options),
        };
        Ok(Box::new(started.map_err(|error| self.failed(error))?))
    }

    /// Whether it is the process that started this one.
    pub(super) fn is_caller(&self) -> bool {
        self.kernel().starts_with("fd:")
    }

    /// Those of the process that started this one, where it is the kernel.
    fn descriptors(&self) -> Result<Option<Descriptors>, Failure> {
        let Some(text) = self.kernel().strip_prefix("fd:") else {
            return Ok(None);
        };
        self.no_arguments("descriptors")?;
        let descriptors = text.parse().map_err(|error| self.failed(error))?;
        Ok(Some(descriptors))
    }

    /// Refuses to speak of a kernel that went away before the end.
    pub(super) fn still_there(&self, kernel: &dyn Kernel) -> Result<(), Failure> {
        kernel.gone().map_or(Ok(()), |why| Err(self.failed(why)))
    }

    fn is_library(&self) -> bool {
        let extension = Path::new(self.kernel()).extension();
        let extension = extension.and_then(|extension| extension.to_str());
        extension.is_some_and(|extension| LIBRARIES.contains(&extension))
    }

    /// Refuses an option with what is no program, and says why.
    pub(super) fn only_program(&self, option: &str, why: &str) -> Result<(), Failure> {
        let what = match self.kernel().strip_prefix("method:") {
            Some(_) => "a method",
            None if self.kernel().starts_with(gallery::PREFIX) => "a row of the gallery",
            None if self.is_library() => "a library",
            None => return Ok(()),
        };
        Err(Failure::Usage(format!(
            "'{option}' with {what}, {why} (allowed: with a program)"
        )))
    }

    /// Refuses what only programs take.
    fn no_program(&self, what: &str) -> Result<(), Failure> {
        if self.log.is_some() {
            self.only_program("--log", "which is not talked to")?;
        }
        self.no_arguments(what)
    }

    /// Refuses words behind what is no program.
    fn no_arguments(&self, what: &str) -> Result<(), Failure> {
        match self.arguments().first() {
            None => Ok(()),
            Some(first) => Err(Failure::Usage(format!(
                "'{}' behind {what}, which takes no arguments (allowed: options in front of KERNEL)",
                first.escape_debug()
            ))),
        }
    }

    pub(super) fn failed(&self, error: impl Into<anyhow::Error>) -> Failure {
        Failure::Kernel {
            kernel: self.kernel().escape_debug().to_string(),
            error: error.into(),
        }
    }
}

/// A method, NAME[@FORMAT].
pub(super) fn built_in(name: &str) -> Result<Box<dyn Kernel>, Failure> {
    let usage = |error: &dyn std::fmt::Display| Failure::Usage(format!("{error}"));
    // A seed of Monte Carlo stands behind an @ too, and an outer rule behind it; no format has a slash.
    let (method, format) = match name.rsplit_once('@') {
        Some((method, format)) if !format.contains('/') => (method, format),
        _ => (name, "f64"),
    };
    let method: Method = method.parse().map_err(|error| usage(&error))?;
    let format: FormatName = format.parse().map_err(|error| usage(&error))?;
    Ok(Box::new(BuiltIn::new(method, format)))
}

/// The cases asked for, by names, tags or paths; all of the catalogue where none is. `place` is where they are asked
/// for.
pub(super) fn subjects(asked: &[String], place: &str) -> Result<Vec<Subject>, Failure> {
    let loaded = waiting("deriving", || loaded(asked));
    loaded.map_err(|failure| match failure {
        Failure::Usage(why) => Failure::Usage(format!("{place}: {why}")),
        other => other,
    })
}

fn loaded(asked: &[String]) -> Result<Vec<Subject>, Failure> {
    let mut arguments: Vec<String> = Vec::new();
    let mut add = |argument: &str| {
        if !arguments.iter().any(|known| known == argument) {
            arguments.push(argument.into());
        }
    };
    for one in asked {
        // Looking for tags reads the whole catalogue.
        if catalogue::text(one).is_some() {
            add(one);
            continue;
        }
        let tagged = tagged(one.strip_prefix('@').unwrap_or(one));
        if one.starts_with('@') && tagged.is_empty() {
            return Err(no_tag(one));
        }
        if tagged.is_empty() {
            add(one);
        } else {
            for name in tagged {
                add(name);
            }
        }
    }
    if asked.is_empty() {
        catalogue::names().for_each(&mut add);
    }
    let subjects = arguments.iter().map(|argument| subject(argument));
    let subjects: Vec<Subject> = subjects.collect::<Result<_, _>>()?;
    let mut names = BTreeSet::new();
    let channels = subjects.iter().flat_map(Subject::cases);
    match channels.map(Case::name).find(|name| !names.insert(*name)) {
        None => Ok(subjects),
        Some(name) => Err(Failure::Usage(format!(
            "a case '{name}' a second time (allowed: each name once)"
        ))),
    }
}

/// One case by its name or path, with all its channels.
pub(super) fn subject(argument: &str) -> Result<Subject, Failure> {
    let loaded = case::medium(argument)?;
    let behind = loaded.description.channels.iter();
    let behind: Vec<Option<f64>> = behind
        .map(|channel| channel.background.as_ref().map(Rational::to_f64))
        .collect();
    let channels = loaded.cases.into_iter().map(|one| (one.channel, one.case));
    let subject = Subject::new(&loaded.description.name, channels.collect());
    let subject = if behind.iter().any(Option::is_some) {
        // Nothing is behind the channels that say nothing.
        let behind = behind.into_iter().map(Option::unwrap_or_default);
        subject.and_then(|subject| subject.before(behind.collect()))
    } else {
        subject
    };
    subject.map_err(|error| Failure::Usage(format!("{argument}: {error}")))
}

/// The cases of the catalogue with that tag.
fn tagged(tag: &str) -> Vec<&'static str> {
    let has = |name: &&str| match catalogue::find(name) {
        Some(Ok(description)) => description.tags.iter().any(|own| own == tag),
        _ => false,
    };
    catalogue::names().filter(has).collect()
}

fn no_tag(asked: &str) -> Failure {
    let mut tags = BTreeSet::new();
    for name in catalogue::names() {
        if let Some(Ok(description)) = catalogue::find(name) {
            tags.extend(description.tags);
        }
    }
    let tags: Vec<String> = tags.into_iter().collect();
    Failure::Usage(format!(
        "no case has the tag '{}' (allowed: {})",
        asked.trim_start_matches('@').escape_debug(),
        tags.join(", ")
    ))
}

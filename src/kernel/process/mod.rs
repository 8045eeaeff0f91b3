//! Kernels in processes of their own, by JSON lines over pipes, and by arrays behind these for those that take them.
//!
//! `docs/protocol.md` is what a kernel has to do. A child reads requests from descriptor 3 and writes answers to
//! descriptor 4; what it prints does no harm. It is waited for no longer than [`Options`] say. A child that fails
//! in any way is killed with its whole process group, and started anew when the next radiance is wanted; what is
//! dropped leaves no process behind, unless a process left the group.
//!
//! The kernel may also be the process that started this one ([`ProcessKernel::caller`]), which is waited for as long and never
//! killed or started.

pub(crate) mod answer;
pub(crate) mod bare;
mod caller;
mod child;
mod ending;
mod files;
mod frame;
pub(crate) mod greeting;
mod log;
mod message;
mod number;
#[cfg(feature = "studies")]
mod once;
mod options;
mod peer;
mod pipes;
mod registry;
mod request;
#[cfg(feature = "studies")]
mod schema;
mod spoken;
mod tail;
pub(crate) mod trouble;
pub(crate) mod written;

pub use caller::{Descriptors, DescriptorsError};
pub use log::Log;
#[cfg(feature = "studies")]
pub use once::{Directory, Ended, once};
pub use options::Options;
pub use registry::{stop_all, stop_all_and_exit};
#[cfg(feature = "studies")]
pub use schema::schema;
pub use spoken::{answer, declared, greeting, request};
pub use written::Numbers;

use super::pieces::{in_pieces, one};
use super::{Declaration, Gradient, Gradients, Kernel, KernelError, Rendering, Task};
use child::Child;
use files::Files;
use frame::Frame;
use greeting::Greeting;
use log::Stream;
use message::Arrays;
use peer::{Origin, Peer};
use request::Writer;
use std::io;
use std::time::Instant;

/// The first version of the protocol, which volver's greeting is of: a kernel answers it with the version that it keeps
/// to, which is the first or any other of [`VERSIONS`].
const VERSION: u64 = 1;

/// The versions of the protocol that a kernel may keep to.
const VERSIONS: [u64; 2] = [VERSION, SECOND];

/// The version that has other answers than the radiance.
const SECOND: u64 = 2;

/// One result a task.
type Results = Vec<Result<Rendering, KernelError>>;

/// A program that talks the protocol, or the process that started this one and does.
#[derive(Debug)]
pub struct ProcessKernel {
    origin: Origin,
    options: Options,
    greeting: Greeting,
    /// None between a failure and the next start.
    peer: Option<Peer>,
    files: Option<Files>,
    /// Ids go on when the child is started anew: no answer of one is taken for another's.
    last_id: u64,
    failures: u32,
    last_failure: Option<KernelError>,
}

impl ProcessKernel {
    /// Starts the program, and waits for its greeting.
    ///
    /// # Errors
    /// [`KernelError`] if it does not start, or does not greet as it should in time.
    pub fn start(
        program: &str,
        arguments: &[String],
        options: Options,
    ) -> Result<Self, KernelError> {
        let origin = Origin::Program {
            program: program.into(),
            arguments: arguments.to_vec(),
        };
        Self::greeted(origin, options)
    }

    /// Talks to the process that started this one, and waits for its greeting. It is not started anew: what fails once
    /// has [gone](Kernel::gone).
    ///
    /// # Errors
    /// [`KernelError`] if the descriptors are no pipes, or it does not greet as it should in time.
    pub fn caller(descriptors: Descriptors, options: Options) -> Result<Self, KernelError> {
        Self::greeted(Origin::Caller(descriptors), options)
    }

    fn greeted(origin: Origin, options: Options) -> Result<Self, KernelError> {
        let (peer, greeting) = start(&origin, &options)?;
        let files = match greeting.arrays {
            Arrays::Json => None,
            Arrays::Npy => Some(Files::new().map_err(|error| KernelError::message(&error))?),
        };
        Ok(ProcessKernel {
            origin,
            options,
            greeting,
            peer: Some(peer),
            files,
            last_id: 0,
            failures: 0,
            last_failure: None,
        })
    }

    /// The number of the child's process, and of its process group; none after a failure.
    #[must_use]
    pub fn id(&self) -> Option<u32> {
        self.peer.as_ref().and_then(Peer::child).map(Child::id)
    }

    /// The end of what the child printed on its standard output, 4 KiB at most.
    #[must_use]
    pub fn output(&self) -> String {
        let child = self.peer.as_ref().and_then(Peer::child);
        child.map(Child::output).unwrap_or_default()
    }

    /// The results of tasks in the form declared. One of several tasks may be the other ones' trouble: if no
    /// answer comes to all at once, they are asked one by one.
    fn results(&mut self, tasks: &[&Task<'_>]) -> Results {
        let mut results = Vec::with_capacity(tasks.len());
        let mut rest = tasks;
        while !rest.is_empty() {
            let (now, later) = rest.split_at(self.at_once(rest));
            rest = later;
            match self.request(now, None) {
                Ok(answered) => results.extend(answered),
                Err(error) if now.len() == 1 => results.push(Err(error)),
                Err(_) => {
                    let singly = now.iter();
                    results.extend(singly.flat_map(|task| self.results(&[task])));
                }
            }
        }
        results
    }

    /// How many of the tasks, from the first on, go into one request.
    fn at_once(&self, tasks: &[&Task<'_>]) -> usize {
        match self.greeting.declaration.batch {
            None => tasks.len(),
            Some(most) => frame::fits(tasks, most.get()),
        }
    }

    /// The results of tasks of as many channels as are declared, in any form.
    fn whole(&mut self, tasks: &[Task<'_>]) -> Vec<Result<Rendering, KernelError>> {
        let wanted = self.greeting.declaration.form;
        let fits = |task: &&Task<'_>| task.data.kind() == wanted;
        let fitting: Vec<&Task<'_>> = tasks.iter().filter(fits).collect();
        let results = match fitting.as_slice() {
            [] => Vec::new(),
            fitting => self.results(fitting),
        };
        let mut results = results.into_iter();
        let mut result = |task: &Task<'_>| {
            let given = task.data.kind();
            let fitting = (given == wanted).then(|| results.next()).flatten();
            fitting.unwrap_or(Err(KernelError::Form { given, wanted }))
        };
        tasks.iter().map(&mut result).collect()
    }

    /// Rays as the kernel takes them in a single request.
    fn in_one_request(&mut self, tasks: &[Task<'_>]) -> Result<Results, KernelError> {
        let wanted = self.greeting.declaration.form;
        let other = tasks.iter().map(|task| task.data.kind());
        if let Some(given) = other.into_iter().find(|given| *given != wanted) {
            return Err(KernelError::Form { given, wanted });
        }
        let tasks: Vec<&Task<'_>> = tasks.iter().collect();
        let (rays, most) = (tasks.len(), self.at_once(&tasks));
        if most < rays {
            return Err(KernelError::Together { rays, most });
        }
        self.request(&tasks, None)
    }

    /// Asks, unless it was in vain too often.
    fn request(
        &mut self,
        tasks: &[&Task<'_>],
        cotangents: Option<&[&[f64]]>,
    ) -> Result<Results, KernelError> {
        if let Some(last) = self.gone() {
            return Err(last);
        }
        if let Some(last) = &self.last_failure
            && self.failures >= self.options.max_failures.max(1)
        {
            return Err(KernelError::GivenUp {
                failures: self.failures,
                last: Box::new(last.clone()),
            });
        }
        let results = match self.greeting.declaration.batch {
            // Gradients go as text.
            Some(_) if cotangents.is_none() => self.ask_frame(tasks),
            _ => self.ask(tasks, cotangents),
        };
        if let Some(files) = &mut self.files {
            files.clear();
        }
        match &results {
            // What says that it refuses has not failed.
            Ok(_) | Err(KernelError::Refused { .. }) => self.failures = 0,
            Err(error) => {
                self.failures += 1;
                self.last_failure = Some(error.clone());
            }
        }
        results
    }

    fn ask(
        &mut self,
        tasks: &[&Task<'_>],
        cotangents: Option<&[&[f64]]>,
    ) -> Result<Results, KernelError> {
        self.last_id += 1;
        let mut writer = Writer {
            numbers: self.greeting.numbers,
            background: self.greeting.declaration.background,
            cotangents,
            files: self.files.as_mut(),
        };
        let line = writer.line(self.last_id, tasks);
        let line = line.map_err(|error| KernelError::message(&error))?;
        let mut peer = match self.peer.take() {
            Some(peer) => peer,
            None => self.start_anew()?,
        };
        self.keep(&line, tasks, cotangents)?;
        let timeout = self.options.timeout;
        let answer = peer
            .exchange(&line, Instant::now().checked_add(timeout))
            .and_then(|answer| {
                answer::read(
                    &answer,
                    self.last_id,
                    tasks,
                    &self.greeting,
                    cotangents.is_some(),
                )
            });
        match answer {
            Ok(results) => {
                self.peer = Some(peer);
                Ok(results)
            }
            Err(trouble) => Err(peer.fail(trouble, "answer", timeout)),
        }
    }

    /// Asks in a frame, whose answer is one.
    fn ask_frame(&mut self, tasks: &[&Task<'_>]) -> Result<Results, KernelError> {
        self.last_id += 1;
        let id = self.last_id;
        let log = self.options.log.clone();
        let background = self.greeting.declaration.background;
        let frame = frame::write(id, tasks, background, log.is_some());
        let Frame {
            line: mut message,
            bytes,
            text,
        } = frame.map_err(|error| KernelError::message(&error))?;
        let mut peer = match self.peer.take() {
            Some(peer) => peer,
            None => self.start_anew()?,
        };
        if let Some(log) = &log {
            log.tell(Stream::Requests, &message)?;
            log.tell(Stream::Requests, &text)?;
        }
        message.extend_from_slice(&bytes);
        let timeout = self.options.timeout;
        let deadline = Instant::now().checked_add(timeout);
        let read = |line: &[u8]| {
            let head = frame::head(line, id, tasks)?;
            let bytes = head.bytes;
            Ok((head, bytes))
        };
        match peer.exchange_frame(&message, deadline, read) {
            Err(trouble) => Err(peer.fail(trouble, "answer", timeout)),
            Ok((head, bytes)) => {
                self.peer = Some(peer);
                if let Some(log) = &log {
                    let text = head.text(&bytes).map_err(io::Error::from);
                    let text = text.map_err(|error| KernelError::message(&error))?;
                    log.tell(Stream::Answers, &text)?;
                }
                let results = frame::read(&head, &bytes, tasks, &self.greeting);
                results.map_err(|reason| KernelError::Refused { reason })
            }
        }
    }

    /// Logs a request before it is sent. Files are gone when the log is read: their arrays stand in the message there.
    fn keep(
        &self,
        line: &[u8],
        tasks: &[&Task<'_>],
        cotangents: Option<&[&[f64]]>,
    ) -> Result<(), KernelError> {
        let Some(log) = &self.options.log else {
            return Ok(());
        };
        if self.files.is_none() {
            return log.tell(Stream::Requests, line);
        }
        let mut writer = Writer {
            numbers: self.greeting.numbers,
            background: self.greeting.declaration.background,
            cotangents,
            files: None,
        };
        let line = writer.line(self.last_id, tasks);
        let line = line.map_err(|error| KernelError::message(&error))?;
        log.tell(Stream::Requests, &line)
    }

    fn start_anew(&self) -> Result<Peer, KernelError> {
        let (peer, greeting) = start(&self.origin, &self.options)?;
        let changes = self.greeting.changes(&greeting);
        if changes.is_empty() {
            return Ok(peer);
        }
        Err(KernelError::Changed {
            keys: changes.join(", "),
        })
    }
}

/// The other side, which has greeted.
fn start(origin: &Origin, options: &Options) -> Result<(Peer, Greeting), KernelError> {
    let timeout = options.start_timeout;
    let deadline = Instant::now().checked_add(timeout);
    let mut hello = serde_json::to_vec(&greeting::hello())
        .map_err(|error| KernelError::message(&error.into()))?;
    hello.push(b'\n');
    let log = options.log.as_ref();
    let mut peer = origin.peer(log)?;
    if let Some(log) = log {
        log.tell(Stream::Requests, &hello)?;
    }
    let greeting = peer.exchange(&hello, deadline);
    match greeting.and_then(|line| greeting::read(&line)) {
        Ok(greeting) => Ok((peer, greeting)),
        Err(trouble) => Err(peer.fail(trouble, "greeting", timeout)),
    }
}

/// An answer and its gradient, which was asked for.
fn parted(result: Result<Rendering, KernelError>) -> Result<(Rendering, Gradient), KernelError> {
    let mut rendering = result?;
    let gradient = rendering.gradient.take();
    let gradient = gradient.ok_or(KernelError::GradientAsked { given: false })?;
    Ok((rendering, gradient))
}

impl Kernel for ProcessKernel {
    fn declaration(&self) -> &Declaration {
        &self.greeting.declaration
    }

    fn greeting(&self) -> Option<&str> {
        Some(&self.greeting.said)
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        one(self.render_all(std::slice::from_ref(task)))
    }

    fn render_together(&mut self, tasks: &[Task<'_>]) -> Result<Results, KernelError> {
        let declaration = self.declaration().clone();
        let mut failure = None;
        let results = in_pieces(&declaration, tasks, |tasks| {
            self.in_one_request(tasks).unwrap_or_else(|error| {
                failure = Some(error);
                Vec::new()
            })
        });
        failure.map_or(Ok(results), Err)
    }

    fn render_all(&mut self, tasks: &[Task<'_>]) -> Vec<Result<Rendering, KernelError>> {
        let declaration = self.declaration().clone();
        in_pieces(&declaration, tasks, |tasks| self.whole(tasks))
    }

    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        if self.declaration().gradient.is_none() {
            return Err(KernelError::NoGradient);
        }
        let given = task.data.kind();
        let wanted = self.declaration().form;
        if given != wanted {
            return Err(KernelError::Form { given, wanted });
        }
        let mut results = self.request(&[task], Some(&[cotangents]))?;
        parted(results.pop().unwrap_or(Err(KernelError::NoGradient)))
    }

    fn gradients_together(
        &mut self,
        asked: &[(Task<'_>, &[f64])],
    ) -> Result<Gradients, KernelError> {
        if self.declaration().gradient.is_none() {
            return Err(KernelError::NoGradient);
        }
        let wanted = self.declaration().form;
        let other = asked.iter().map(|(task, _)| task.data.kind());
        if let Some(given) = other.into_iter().find(|given| *given != wanted) {
            return Err(KernelError::Form { given, wanted });
        }
        let (tasks, cotangents): (Vec<&Task<'_>>, Vec<&[f64]>) = asked
            .iter()
            .map(|(task, cotangents)| (task, *cotangents))
            .unzip();
        let (rays, most) = (tasks.len(), self.at_once(&tasks));
        if most < rays {
            return Err(KernelError::Together { rays, most });
        }
        let results = self.request(&tasks, Some(&cotangents))?;
        Ok(results.into_iter().map(parted).collect())
    }

    fn renew(&mut self) {
        self.failures = 0;
    }

    fn restart(&mut self) {
        if self.origin.starts_anew() {
            self.peer = None;
        }
    }

    fn gone(&self) -> Option<KernelError> {
        let is_left = self.peer.is_some() || self.origin.starts_anew();
        self.last_failure.clone().filter(|_| !is_left)
    }
}

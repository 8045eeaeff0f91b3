//! Kernels that misbehave, and whether anything of them is left.

use std::path::PathBuf;
use std::time::{Duration, Instant};
use std::{fs, thread};
use tempfile::TempDir;
use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::kernel::process::{Log, Options, ProcessKernel};
use volver::kernel::{Cut, Data, KernelError, Segments, Subject, Task};

/// Where the children of one test leave their numbers.
pub(crate) struct Fixture {
    directory: TempDir,
}

impl Fixture {
    pub(crate) fn new() -> Self {
        Fixture {
            directory: tempfile::tempdir().unwrap(),
        }
    }

    fn file(&self) -> PathBuf {
        self.directory.path().join("processes")
    }

    pub(crate) fn start(&self, mode: &str, options: Options) -> Result<ProcessKernel, KernelError> {
        self.run("kernel.py", &[mode], options)
    }

    /// Starts a script of this directory.
    pub(crate) fn run(
        &self,
        script: &str,
        words: &[&str],
        options: Options,
    ) -> Result<ProcessKernel, KernelError> {
        let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/kernels/kernel_process/");
        let (script, file) = (format!("{directory}{script}"), self.file());
        let before = ["-S", &script].into_iter().chain(words.iter().copied());
        let arguments = before.chain(file.to_str()).map(String::from);
        let arguments: Vec<String> = arguments.collect();
        ProcessKernel::start("python3", &arguments, options)
    }

    /// The requests that children were asked, as they write them down.
    pub(crate) fn asked(&self) -> Vec<String> {
        let file = self.file().with_extension("asked");
        let file = fs::read_to_string(file).unwrap_or_default();
        file.lines().map(Into::into).collect()
    }

    /// What a child wrote down of its end.
    pub(crate) fn told(&self) -> String {
        let file = self.file().with_extension("told");
        fs::read_to_string(file).unwrap_or_default()
    }

    /// A log of this test's own.
    pub(crate) fn log(&self) -> (Log, PathBuf) {
        let path = self.directory.path().join("log");
        (Log::create(&path).unwrap(), path)
    }

    /// The processes started, each of which led a group.
    fn groups(&self) -> Vec<u32> {
        let file = fs::read_to_string(self.file()).unwrap_or_default();
        file.lines().map(|line| line.parse().unwrap()).collect()
    }

    pub(crate) fn starts(&self) -> usize {
        self.groups().len()
    }

    /// Kills the child that was started last, as the system does when memory ends.
    pub(crate) fn kill(&self) {
        let id = self.groups().pop().unwrap();
        let id = rustix::process::Pid::from_raw(i32::try_from(id).unwrap()).unwrap();
        rustix::process::kill_process(id, rustix::process::Signal::KILL).unwrap();
    }

    /// Nothing lives in any of the groups. The dead whom nobody reaped are none of this process's: it reaps its
    /// own children.
    pub(crate) fn assert_gone(&self) {
        let groups = self.groups();
        eventually(|| living().all(|group| !groups.contains(&group)));
    }
}

/// Enough for all but a hanging child, on a slow machine too.
pub(crate) fn patient() -> Options {
    Options::default()
}

/// For those that do not greet.
pub(crate) fn hasty() -> Options {
    Options {
        start_timeout: Duration::from_millis(1500),
        ..Options::default()
    }
}

/// The group of every process that lives.
fn living() -> impl Iterator<Item = u32> {
    let processes = fs::read_dir("/proc").unwrap();
    processes.filter_map(|entry| {
        let stat = fs::read_to_string(entry.ok()?.path().join("stat")).ok()?;
        let (_, behind_name) = stat.rsplit_once(')')?;
        let mut fields = behind_name.split_whitespace();
        let alive = !matches!(fields.next()?, "Z" | "X");
        let group = fields.nth(1)?.parse().ok()?;
        alive.then_some(group)
    })
}

/// Waits for what is about to be.
pub(crate) fn eventually(mut condition: impl FnMut() -> bool) {
    let deadline = Instant::now() + Duration::from_secs(5);
    while !condition() {
        assert!(Instant::now() < deadline, "it never came");
        thread::sleep(Duration::from_millis(10));
    }
}

pub(crate) fn subject(name: &str) -> Subject {
    let description = catalogue::find(name).unwrap().unwrap();
    let channels = manufacture(&description).unwrap();
    let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
    Subject::new(name, channels).unwrap()
}

pub(crate) fn segments(subject: &Subject, n: u64) -> Segments {
    subject.segments(Cut::Segments(n)).unwrap()
}

pub(crate) fn task<'a>(subject: &'a Subject, segments: &'a Segments) -> Task<'a> {
    let count = segments.count() as u64;
    Task {
        subject,
        step: subject.length().to_f64() / count as f64,
        segments: count,
        seed: 0,
        data: Data::Segments(segments),
    }
}

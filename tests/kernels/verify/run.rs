//! volver run, the fixture kernel, and whether anything of it is left.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};
use std::{fs, process, thread};

/// Cases and levels that tell most kernels apart, in little time.
pub(crate) const SHORT: [&str; 4] = ["--cases", "sine-squared,thick,cloud", "--ladder", "8..256"];
pub(crate) const METHOD: &str = "method:front-to-back/middle/expm1";

/// volver with `arguments`, ready to run.
pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.args(arguments).timeout(Duration::from_secs(300));
    command
}

/// What came of a run.
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Run {
    pub(crate) fn of(mut command: Command) -> Run {
        let output = command.output().unwrap();
        Run {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// The exit code is `code`, and `code` alone says whether something is on standard error: one line where it
    /// is 2.
    pub(crate) fn with_code(self, code: i32) -> Run {
        let Run { out, err, .. } = &self;
        assert_eq!(self.code, Some(code), "{out}{err}");
        assert_eq!(err.lines().count(), usize::from(code == 2), "{err}");
        self
    }

    pub(crate) fn shows(&self, words: &str) {
        let text = self.unwrapped();
        assert!(text.contains(words), "{words}\nis not in\n{}", self.out);
    }

    pub(crate) fn hides(&self, words: &str) {
        let text = self.unwrapped();
        assert!(!text.contains(words), "{words}\nis in\n{}", self.out);
    }

    /// Standard output with wrapped lines made one.
    fn unwrapped(&self) -> String {
        let words: Vec<&str> = self.out.split_whitespace().collect();
        words.join(" ")
    }

    /// The row of that case, without what stands below it.
    pub(crate) fn row(&self, case: &str) -> &str {
        let is_row = |line: &&str| line.split_whitespace().nth(1) == Some(case);
        let row = self.out.lines().find(is_row);
        assert!(row.is_some(), "{case}\nhas no row in\n{}", self.out);
        row.unwrap_or_default()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap()
    }
}

pub(crate) fn volver(arguments: &[&str]) -> Run {
    Run::of(command(arguments))
}

/// A short verification of a kernel.
pub(crate) fn verify(options: &[&str], kernel: &[&str]) -> Run {
    volver(&[&["verify"], &SHORT[..], options, kernel].concat())
}

pub(crate) fn in_repository(path: &str) -> String {
    format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))
}

/// A text that stands among the arguments of all processes of one test.
pub(crate) struct Marked(String);

impl Marked {
    pub(crate) fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        Marked(format!("volver-verify-{}-{count}", process::id()))
    }

    /// The fixture as a command line.
    pub(crate) fn kernel(&self, options: &[&str]) -> Vec<String> {
        let script = in_repository("tests/kernels/verify/kernel.py");
        let head = ["python3", "-S", &script, "--marker", &self.0];
        let all = head.iter().chain(options);
        all.map(ToString::to_string).collect()
    }

    /// A short verification of the fixture, after which nothing of it is left.
    pub(crate) fn verify(&self, options: &[&str], kernel: &[&str]) -> Run {
        let kernel = self.kernel(kernel);
        let kernel: Vec<&str> = kernel.iter().map(String::as_str).collect();
        let run = verify(options, &kernel);
        self.assert_gone();
        run
    }

    /// Nobody with the marker lives: neither kernel nor volver.
    pub(crate) fn assert_gone(&self) {
        eventually(|| self.living() == 0);
    }

    /// How many processes there are.
    pub(crate) fn living(&self) -> usize {
        self.processes().count()
    }

    /// Kills what volver could not, as it was killed itself.
    pub(crate) fn kill(&self) {
        for process in self.processes() {
            let id = rustix::process::Pid::from_raw(process).unwrap();
            rustix::process::kill_process(id, rustix::process::Signal::KILL).unwrap();
        }
        self.assert_gone();
    }

    /// The dead have no arguments.
    fn processes(&self) -> impl Iterator<Item = i32> + '_ {
        let processes = fs::read_dir("/proc").unwrap();
        processes.flatten().filter_map(|entry| {
            let arguments = fs::read(entry.path().join("cmdline")).unwrap_or_default();
            let is_marked = String::from_utf8_lossy(&arguments).contains(&format!("{}\0", self.0));
            let id = entry.file_name().to_str()?.parse().ok()?;
            is_marked.then_some(id)
        })
    }
}

/// Waits for what is about to be.
pub(crate) fn eventually(mut condition: impl FnMut() -> bool) {
    let deadline = Instant::now() + Duration::from_secs(20);
    while !condition() {
        assert!(Instant::now() < deadline, "it never came");
        thread::sleep(Duration::from_millis(10));
    }
}

/// The fixture told `kernel`, on a short verification.
pub(crate) fn fixture(options: &[&str], kernel: &[&str]) -> Run {
    Marked::new().verify(options, kernel)
}

/// What Python's parser finds in a `JUnit` document: counts of the root and of elements, and all text.
pub(crate) fn junit(text: &str) -> Value {
    let code = "
import json, sys, xml.etree.ElementTree as tree
root = tree.fromstring(sys.stdin.buffer.read())
suite = root.find('testsuite')
keys = 'tests', 'failures', 'errors', 'skipped'
cases = suite.findall('testcase')
found = [len(cases)] + [sum(c.find(k) is not None for c in cases) for k in ('failure', 'error', 'skipped')]
says = {c.get('name'): ''.join(e.get('message', '') + (e.text or '') for e in c) for c in cases}
print(json.dumps({'root': [int(root.get(k)) for k in keys], 'suite': [int(suite.get(k)) for k in keys],
                  'found': found, 'says': says, 'name': suite.get('name')}))
";
    let mut python = Command::new("python3");
    python.args(["-c", code]).write_stdin(text.to_string());
    let output = python.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}\n{text}");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["root"], found["found"], "{text}");
    assert_eq!(found["suite"], found["found"], "{text}");
    found
}

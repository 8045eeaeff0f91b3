//! Whatever ends volver ends the kernel.

use super::run::{Marked, SHORT, eventually};
use assert_cmd::cargo::cargo_bin;
use rustix::process::{Pid, Signal, kill_process};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// volver with a kernel that hangs at 32 segments, in the middle of that request.
struct Hanging {
    marked: Marked,
    child: Child,
    _folder: TempDir,
}

impl Hanging {
    fn start(subcommand: &[&str], timeout: &str) -> Hanging {
        let folder = tempfile::tempdir().unwrap();
        let sign = folder.path().join("sign");
        let marked = Marked::new();
        let options = [
            "--trouble",
            "hangs",
            "--at",
            "32",
            "--sign",
            sign.to_str().unwrap(),
        ];
        let child = Command::new(cargo_bin!("volver"))
            .args(subcommand)
            .args(["--timeout", timeout])
            .args(marked.kernel(&options))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        eventually(|| Path::exists(&sign));
        assert!(marked.living() >= 2);
        Hanging {
            marked,
            child,
            _folder: folder,
        }
    }

    fn send(&self, signal: Signal) {
        let id = i32::try_from(self.child.id()).unwrap();
        kill_process(Pid::from_raw(id).unwrap(), signal).unwrap();
    }
}

fn verify() -> Vec<&'static str> {
    [&["verify"], &SHORT[..]].concat()
}

#[test]
fn signals_leave_no_process() {
    for signal in [Signal::INT, Signal::TERM, Signal::HUP] {
        let hanging = Hanging::start(&verify(), "600");
        let start = Instant::now();
        hanging.send(signal);
        let Hanging { marked, child, .. } = hanging;
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{signal:?}");
        assert!(start.elapsed() < Duration::from_secs(10));
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
        marked.assert_gone();
    }
}

#[test]
fn a_killed_volver_leaves_no_kernel_that_listens() {
    // Nobody can answer SIGKILL; the kernel reads the end of its requests, unless it hangs.
    let folder = tempfile::tempdir().unwrap();
    let sign = folder.path().join("sign");
    let marked = Marked::new();
    let options = ["--trouble", "prints", "--sign", sign.to_str().unwrap()];
    let mut child = Command::new(cargo_bin!("volver"))
        .args(["verify", "--quiet"])
        .args(marked.kernel(&options))
        .spawn()
        .unwrap();
    eventually(|| sign.exists());
    child.kill().unwrap();
    child.wait().unwrap();
    marked.assert_gone();
}

#[test]
fn a_closed_standard_output_leaves_no_process() {
    let mut hanging = Hanging::start(&verify(), "0.5");
    drop(hanging.child.stdout.take());
    let Hanging { marked, child, .. } = hanging;
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(141));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    marked.assert_gone();
}

#[test]
fn what_was_said_before_a_signal_is_in_the_log() {
    for signal in [Signal::INT, Signal::KILL] {
        let folder = tempfile::tempdir().unwrap();
        let log = folder.path().join("log");
        let options = ["--log", log.to_str().unwrap()];
        let hanging = Hanging::start(&[&verify()[..], &options].concat(), "600");
        hanging.send(signal);
        let Hanging { child, marked, .. } = hanging;
        child.wait_with_output().unwrap();
        let log = std::fs::read_to_string(log).unwrap();
        let last = log.lines().rfind(|line| line.starts_with("3 ")).unwrap();
        assert!(last.contains(r#""segments":32,"#), "{last}");
        assert!(last.ends_with("]}"), "{last}");
        // Of the levels of 8 and 16 segments, once more with another seed the first.
        let answers = log.lines().filter(|line| line.starts_with("4 ")).count();
        assert!(answers >= 3, "{log}");
        if signal == Signal::INT {
            marked.assert_gone();
        } else {
            marked.kill();
        }
    }
}

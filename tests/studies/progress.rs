//! Commands that take long say so, on a terminal.

use assert_cmd::cargo::cargo_bin;
use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};

/// Under `script`, which has a terminal for it; the table comes once the line is there.
#[test]
#[cfg(target_os = "linux")]
fn what_takes_longer_than_a_second_says_what_it_does() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("table");
    let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let program = cargo_bin!("volver");
    let command = format!("'{}' fit '{}'", program.display(), pipe.display());
    let mut child = Command::new("script")
        .args(["-qec", &command, "/dev/null"])
        .env("TERM", "xterm")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut terminal = child.stdout.take().unwrap();
    let mut shown = Vec::new();
    let mut byte = [0];
    while !String::from_utf8_lossy(&shown).contains("fitting, ") {
        assert_eq!(terminal.read(&mut byte).unwrap(), 1, "{shown:?}");
        shown.extend(byte);
    }
    fs::write(&pipe, "0.4,8e-2\n0.2,2e-2\n0.1,5e-3\n0.05,1.25e-3\n").unwrap();
    let mut rest = String::new();
    terminal.read_to_string(&mut rest).unwrap();
    assert!(child.wait().unwrap().success());
    // The line is gone before the report is there.
    let (_, report) = rest.split_once("order ").unwrap();
    assert!(
        report.contains("Fitted") && !report.contains("fitting"),
        "{rest}"
    );
}

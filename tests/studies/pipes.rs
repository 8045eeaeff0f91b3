//! Whoever reads may have enough: a pipe that is closed ends every command without a word.

use super::every::{Place, commands};
use assert_cmd::cargo::cargo_bin;
use std::io::Write;
use std::process::{Command, Stdio};

#[test]
fn a_closed_pipe_ends_every_command_silently() {
    let place = Place::new();
    let mut all = commands();
    for whole in ["--help", "--version", "help", "plan --help"] {
        all.push((whole, ""));
    }
    for (arguments, input) in all {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut child = Command::new(cargo_bin!("volver"))
            .args(arguments.split(' '))
            .current_dir(place.path())
            .stdin(Stdio::piped())
            .stdout(writer)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // What the command does not read it need not.
        let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            (output.status.code(), &*said),
            (Some(141), ""),
            "{arguments}"
        );
    }
}

/// A file that is a pipe is closed as well as standard output.
#[test]
#[cfg(unix)]
fn so_does_standard_output_by_its_name() {
    let place = Place::new();
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = Command::new(cargo_bin!("volver"))
        .args(["plan", "scene.toml", "--tolerance", "1e-3", "--quiet"])
        .args(["--json", "/dev/stdout"])
        .current_dir(place.path())
        .stdout(writer)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
        .wait_with_output()
        .unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(141));
}

/// A disk that is full is another matter.
#[test]
#[cfg(target_os = "linux")]
fn what_cannot_be_written_is_still_said() {
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let output = Command::new(cargo_bin!("volver"))
        .args(["cases", "vacuum"])
        .stdout(full)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
        .wait_with_output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.starts_with("volver: standard output: "), "{said}");
    assert_eq!((output.status.code(), said.lines().count()), (Some(2), 1));
}

//! `volver prove`: what it writes, what Coq says of it, bad input.

use super::proofs;
use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn prove(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command
        .current_dir(folder.path())
        .arg("prove")
        .args(arguments);
    command
}

fn files(folder: &Path) -> BTreeMap<String, String> {
    let files = fs::read_dir(folder).unwrap().map(|file| file.unwrap());
    files
        .map(|file| {
            let text = fs::read_to_string(file.path()).unwrap();
            (file.file_name().into_string().unwrap(), text)
        })
        .collect()
}

#[test]
fn the_files_are_what_the_program_writes() {
    let folder = TempDir::new().unwrap();
    prove(&folder, &["--all", "--no-check", "--write", "cases"])
        .assert()
        .code(0)
        .stdout(predicate::str::contains(
            "62 cases: 0 proved, 0 failed, 46 not checked, 16 not stated\n",
        ));
    let written = files(&folder.path().join("cases"));
    assert_eq!(written.len(), 46);
    assert_eq!(written, files(&proofs().join("cases")));
}

/// The first line has these words and no others, in whatever columns.
fn first_line(words: &'static str) -> impl Predicate<str> {
    predicate::function(move |text: &str| {
        let line = text.lines().next().unwrap_or_default();
        line.split_whitespace().eq(words.split_whitespace())
    })
}

#[test]
fn without_coq_nothing_is_proved() {
    let folder = TempDir::new().unwrap();
    prove(&folder, &["sine-squared", "--coqc", "./no-such-program"])
        .assert()
        .code(1)
        .stdout(first_line("sine-squared not checked ./sine_squared.v"))
        .stdout(predicate::str::contains(
            "./sine_squared.v\n    './no-such-program' does not run: ",
        ));
    assert!(folder.path().join("sine_squared.v").exists());
}

#[cfg(unix)]
#[test]
fn coqs_verdict_and_message_are_passed_on() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TempDir::new().unwrap();
    // A stand-in that compiles the theory and refuses the case.
    let coqc = folder.path().join("coqc");
    let script = "#!/bin/sh\nfor file; do :; done\ncase $file in\n*/theory/*) exit 0 ;;\n\
        *) echo \"File \\\"$file\\\", line 1: No applicable tactic.\" >&2; exit 1 ;;\nesac\n";
    fs::write(&coqc, script).unwrap();
    fs::set_permissions(&coqc, fs::Permissions::from_mode(0o755)).unwrap();
    prove(
        &folder,
        &["thick", "--coqc", "./coqc", "--json", "proof.json"],
    )
    .assert()
    .code(1)
    .stdout(predicate::str::contains(
        "failed       ./thick.v\n    File \"thick.v\", line 1: No applicable tactic.\n",
    ));
    let json = fs::read_to_string(folder.path().join("proof.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["proofs"][0]["outcome"], "failed");
    assert_eq!(json["proofs"][0]["theorems"][0], "thick");

    fs::write(&coqc, "#!/bin/sh\nexit 0\n").unwrap();
    prove(&folder, &["thick", "--coqc", "./coqc"])
        .assert()
        .code(0)
        .stdout(first_line("thick proved ./thick.v"));

    fs::write(
        &coqc,
        "#!/bin/sh\nfor file; do :; done\ncase $file in */theory/*) ;; *) exec sleep 60 ;; esac\n",
    )
    .unwrap();
    prove(&folder, &["thick", "--coqc", "./coqc", "--timeout", "1"])
        .assert()
        .code(1)
        .stdout(predicate::str::contains("no end within 1 s"));
}

#[test]
fn what_cannot_be_stated_is_refused_by_name() {
    let folder = TempDir::new().unwrap();
    let refused = |case: &str, said: &str| {
        prove(&folder, &[case])
            .assert()
            .code(2)
            .stdout("")
            .stderr(predicate::str::contains(said).and(predicate::str::contains("(allowed: ")));
    };
    refused("kink-off-node", "has branches");
    refused("square-root-edge", "fractional power");
    refused("no-such-case", "no case 'no-such-case'");
    prove(&folder, &[]).assert().code(2);
    prove(&folder, &["--all", "thick"]).assert().code(2);
    prove(&folder, &["thick", "--timeout", "0"])
        .assert()
        .code(2);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn files_of_others_are_left_alone() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("thick.v"), "Definition mine := 1.\n").unwrap();
    prove(&folder, &["thick", "--no-check"])
        .assert()
        .code(2)
        .stderr(predicate::str::contains("not written by volver"));
    let kept = fs::read_to_string(folder.path().join("thick.v")).unwrap();
    assert_eq!(kept, "Definition mine := 1.\n");
    // Its own it writes again.
    fs::remove_file(folder.path().join("thick.v")).unwrap();
    for _ in 0..2 {
        prove(&folder, &["thick", "--no-check"]).assert().code(0);
    }
}

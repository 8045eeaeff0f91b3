//! Whatever is handed in has an end, or is refused: files, devices, pipes, and what a file names in its turn.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin;
use predicates::prelude::*;
use predicates::str::contains;
use std::fs;
use std::path::Path;
use volver::input::{self, InputError};

/// The program with so little memory that an endless input soon fills it.
fn within_little_memory(arguments: &str, directory: &Path) -> Command {
    let mut command = Command::new("sh");
    let program = cargo_bin!("volver");
    command.args([
        "-c",
        &format!(
            "ulimit -v 1500000; exec '{}' {arguments}",
            program.display()
        ),
    ]);
    command.current_dir(directory);
    command
}

fn refused(arguments: &str, directory: &Path, place: &str, most: u64) {
    within_little_memory(arguments, directory)
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains(format!(
            "{place}: more than {most} bytes (allowed: at most {most} bytes)"
        )))
        .stderr(predicate::function(|text: &str| text.lines().count() == 1));
}

#[test]
#[cfg(unix)]
fn no_endless_file_is_read_to_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let directory = folder.path();
    let scene = "[[media]]\nfrom = 0\nto = 1\nkind = \"constant\"\nextinction = 1\n";
    fs::write(directory.join("scene.toml"), scene).unwrap();
    std::os::unix::fs::symlink("/dev/zero", directory.join("zero.toml")).unwrap();
    for (arguments, place, most) in [
        (
            "plan /dev/zero --tolerance 1e-3",
            "/dev/zero",
            input::WRITTEN,
        ),
        ("plan - --tolerance 1e-3 < /dev/zero", "-", input::WRITTEN),
        (
            "render /dev/zero --plan p.json",
            "/dev/zero",
            input::WRITTEN,
        ),
        (
            "render scene.toml --plan /dev/zero",
            "/dev/zero",
            input::COMPUTED,
        ),
        ("fit /dev/zero", "/dev/zero", input::COMPUTED),
        ("fit - < /dev/zero", "-", input::COMPUTED),
        (
            "check /dev/zero method:tree/middle/expm1",
            "/dev/zero",
            input::COMPUTED,
        ),
        (
            "check - method:tree/middle/expm1 < /dev/zero",
            "-",
            input::COMPUTED,
        ),
        ("study /dev/zero", "/dev/zero", input::WRITTEN),
        ("study --cases ./zero.toml", "./zero.toml", input::WRITTEN),
        (
            "tradeoff --cases ./zero.toml",
            "./zero.toml",
            input::WRITTEN,
        ),
        ("cases ./zero.toml", "./zero.toml", input::WRITTEN),
        ("manufacture zero.toml", "zero.toml", input::WRITTEN),
        ("manufacture - < /dev/zero", "-", input::WRITTEN),
        ("prove zero.toml --no-check", "zero.toml", input::WRITTEN),
        ("reference zero.toml", "zero.toml", input::WRITTEN),
        (
            "verify --cases ./zero.toml method:tree/middle/expm1",
            "./zero.toml",
            input::WRITTEN,
        ),
    ] {
        refused(arguments, directory, place, most);
    }
}

#[test]
#[cfg(unix)]
fn nor_what_a_scene_names() {
    let folder = tempfile::tempdir().unwrap();
    let directory = folder.path();
    std::os::unix::fs::symlink("/dev/zero", directory.join("zero.npy")).unwrap();
    let medium = "[[media]]\nfrom = 0\nto = 1\nkind = \"sampled\"\n";
    for (name, keys, place) in [
        (
            "samples",
            "samples = \"/dev/zero\"\nextinction = \"s\"",
            "/dev/zero",
        ),
        (
            "array",
            "samples = \"zero.npy\"\nextinction = \"s\"",
            "zero.npy",
        ),
        (
            "table",
            "samples = [0, 1]\ntable = \"/dev/zero\"",
            "/dev/zero",
        ),
    ] {
        let file = format!("{name}.toml");
        fs::write(directory.join(&file), format!("{medium}{keys}\n")).unwrap();
        let arguments = format!("plan {file} --tolerance 1e-3");
        refused(&arguments, directory, place, input::DATA);
    }
}

#[test]
#[cfg(unix)]
fn nor_what_stands_in_a_directory_of_reports() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let directory = folder.path();
    fs::create_dir(directory.join("out")).unwrap();
    symlink("/dev/zero", directory.join("out/index.html")).unwrap();
    refused("report out", directory, "'out/index.html'", input::COMPUTED);

    // A page of another program stays, and so does a file of Coq's.
    let study = "study --cases vacuum --levels 8,16 --quiet --out out";
    within_little_memory(study, directory).assert().code(0);
    assert!(directory.join("out/study.html").exists());
    symlink("/dev/zero", directory.join("sine_squared.v")).unwrap();
    within_little_memory("prove sine-squared --no-check", directory)
        .assert()
        .code(2)
        .stderr(contains("sine_squared.v: not written by volver"));

    fs::create_dir(directory.join("again")).unwrap();
    symlink("/dev/zero", directory.join("again/study.jsonl")).unwrap();
    within_little_memory("study --cases vacuum --resume --out again", directory)
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("again/study.jsonl, line 1: more than "));
}

#[test]
fn as_many_bytes_as_are_allowed_are_read() {
    assert_eq!(input::bytes(&b"four"[..], 4).unwrap(), b"four");
    assert_eq!(input::bytes(&b""[..], 0).unwrap(), b"");
    let error = input::bytes(&b"fives"[..], 4).unwrap_err();
    assert!(matches!(error, InputError::TooLong { most: 4 }));
    let endless = std::io::repeat(0);
    assert!(input::bytes(endless, 1 << 10).is_err());
}

#[test]
fn text_that_is_none_is_named_with_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, b"ab\xff").unwrap();
    assert_eq!(
        input::text(&file, 9).unwrap_err().to_string(),
        "byte 3 is not UTF-8 (allowed: a text in UTF-8, of at most 9 bytes)"
    );
    let folder = input::text(folder.path(), 9).unwrap_err().to_string();
    assert!(
        folder.ends_with("(allowed: a readable file of at most 9 bytes)"),
        "{folder}"
    );
}

/// A command that wants a medium is told where there is none, and takes nothing for checked; `manufacture` checks.
#[test]
fn what_is_no_medium_is_wrong_input() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let text = format!("name = 'a'\nlength = 1\n{text}\n");
        fs::write(folder.path().join(name), text).unwrap();
    };
    write("pole.toml", "extinction = '1/(s - 1/3)^2'\nemission = '1'");
    write("half.toml", "extinction = '1'\nemission = 'sqrt(s - 1/4)'");
    write("gain.toml", "extinction = '1/2 - s'\nemission = '1'");
    write("claim.toml", "depth = 'lambda'\nradiance = '1 + lambda'");
    let pole = "pole.toml: tau defined fails at lambda = 1/3 (allowed: an extinction with a finite \
        value everywhere on the ray)";
    let claim = "claim.toml: verification failed: I(0) = 0 fails at lambda = 0";
    for (arguments, code, said) in [
        ("reference pole.toml", 2, pole),
        ("study --cases pole.toml", 2, pole),
        ("tradeoff --cases pole.toml", 2, pole),
        ("verify --cases pole.toml method:tree/middle/expm1", 2, pole),
        (
            "reference half.toml",
            2,
            "half.toml: C defined fails at lambda = ",
        ),
        (
            "reference gain.toml",
            2,
            "gain.toml: tau >= 0 fails at lambda = ",
        ),
        ("reference claim.toml", 1, claim),
        (
            "manufacture pole.toml",
            1,
            "pole.toml: verification failed: tau defined fails",
        ),
    ] {
        assert_cmd::cargo::cargo_bin_cmd!("volver")
            .args(arguments.split(' '))
            .current_dir(folder.path())
            .assert()
            .code(code)
            .stdout("")
            .stderr(contains(said))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
}

//! What every subcommand keeps to: one-line errors, exit codes, closed pipes, examples that run.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use predicates::str::{contains, starts_with};
use std::io::Write;
use std::process::Stdio;

fn volver(arguments: &[&str], input: &str) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.args(arguments).write_stdin(input.to_string());
    command
}

#[test]
fn bad_usage_is_named_in_one_line() {
    for (arguments, message) in [
        (
            &[][..],
            "'volver' requires a subcommand but one was not provided (allowed: ",
        ),
        (&["fot"], "unrecognized subcommand 'fot' (allowed: "),
        (
            &["fit"],
            "the following required arguments were not provided: <FILE> (allowed: see --help)",
        ),
        (
            &["fit", "-", "--bogus"],
            "unexpected argument '--bogus' found (allowed: see --help)",
        ),
        (
            &["fit", "-", "--color", "red"],
            "invalid value 'red' for '--color <WHEN>' (allowed: auto, always, never)",
        ),
        (
            &["fit", "-", "--expect", "nan"],
            "invalid value 'nan' for '--expect <P>': no order (allowed: a finite number, or exact)",
        ),
        (
            &["fit", "-", "--exact", "x"],
            "invalid value 'x' for '--exact <X>': not a number (allowed: finite decimal numbers)",
        ),
        (
            &["fit", "-", "--floor", "-1"],
            "invalid value '-1' for '--floor <F>': negative (allowed: 0 or above)",
        ),
        (
            &["fit", "-", "--exact", "1", "--richardson"],
            "the argument '--exact <X>' cannot be used with '--richardson' (allowed: see --help)",
        ),
        (
            &["cases", "--plot", "x.svg"],
            "the following required arguments were not provided: <CASE> (allowed: see --help)",
        ),
        (
            &["cases", "vacuum", "--tag", "thin"],
            "the argument '[CASE]' cannot be used with '--tag <TAG>' (allowed: see --help)",
        ),
        (
            &["cases", "vacuum", "--plot", "-"],
            "invalid value '-' for '--plot <FILE>': no file (allowed: a file that can be written)",
        ),
        (
            &["manufacture", "vacuum", "--code", "cobol"],
            "invalid value 'cobol' for '--code <LANGUAGE>': unknown language 'cobol' (allowed: c, python, rust)",
        ),
        (
            &["manufacture", "vacuum", "--latex", "--code", "c"],
            "the argument '--latex' cannot be used with '--code <LANGUAGE>' (allowed: see --help)",
        ),
        (
            &["manufacture", "vacuum", "--latex", "--json", "-"],
            "'--json -' and '--latex' both go to standard output (allowed: --json with a file)",
        ),
        (
            &["reference", "vacuum", "--digits", "0"],
            "invalid value '0' for '--digits <N>': no number of digits (allowed: 1 to 10000)",
        ),
        (
            &["reference", "vacuum", "--digits", "10001"],
            "--digits 10001: the radiance takes about ",
        ),
        (
            &["completions", "cmd"],
            "invalid value 'cmd' for '<SHELL>' (allowed: bash, elvish, fish, powershell, zsh)",
        ),
    ] {
        volver(arguments, "")
            .assert()
            .code(2)
            .stdout("")
            .stderr(starts_with(format!("volver: {message}")))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
}

#[test]
fn a_closed_pipe_ends_silently() {
    // More than any pipe holds, so that the write must fail.
    let rows = (1..5000).map(|k| format!("{k},1\n"));
    let table: String = std::iter::once("h,e\n".to_string()).chain(rows).collect();
    for arguments in [
        &["fit", "-", "--json"][..],
        &["fit", "-", "--json", "--expect", "2"],
    ] {
        let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin!("volver"))
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        child
            .stdin
            .take()
            .unwrap()
            .write_all(table.as_bytes())
            .unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(141));
        assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    }
}

#[test]
fn completions_and_version_are_printed() {
    for (shell, text) in [
        ("bash", "complete -F _volver"),
        ("zsh", "#compdef volver"),
        ("fish", "complete -c volver"),
    ] {
        volver(&["completions", shell], "")
            .assert()
            .code(0)
            .stdout(contains(text));
    }
    volver(&["--version"], "")
        .assert()
        .code(0)
        .stdout(format!("volver {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
#[cfg(unix)]
fn the_examples_of_the_help_run() {
    let binary = assert_cmd::cargo::cargo_bin!("volver");
    let path = format!(
        "{}:{}",
        binary.parent().unwrap().display(),
        std::env::var("PATH").unwrap()
    );
    for (help, count) in [
        (&["--help"][..], 4),
        (&["fit", "--help"], 4),
        (&["cases", "--help"], 4),
        (&["manufacture", "--help"], 4),
        (&["reference", "--help"], 4),
        (&["stress", "--help"], 4),
        (&["plan", "--help"], 4),
        (&["render", "--help"], 2),
    ] {
        let output = volver(help, "").output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        let text = String::from_utf8(output.stdout).unwrap();
        let (_, examples) = text.split_once("Examples:\n").unwrap();
        let examples: Vec<&str> = examples
            .lines()
            .map_while(|line| line.strip_prefix("  "))
            .collect();
        assert!(examples.len() >= count, "{examples:?}");
        for example in examples {
            Command::new("sh")
                .args(["-c", example])
                .env("PATH", &path)
                .assert()
                .code(0)
                .stdout(predicate::str::is_empty().not())
                .stdout(contains("FloorLimited").not())
                .stderr("");
        }
    }
}

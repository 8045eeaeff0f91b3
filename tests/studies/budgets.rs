//! What commands take at most is said beforehand, and more is refused before anything is done.

use super::every::{Place, commands, names};
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use predicates::str::{contains, ends_with, starts_with};
use std::fs;

#[test]
fn every_command_says_what_it_takes_at_most() {
    let names = names();
    assert!(names.len() >= 16, "{names:?}");
    for name in &names {
        let used = commands();
        let mut used = used.iter().map(|(arguments, _)| *arguments);
        assert!(
            used.any(|arguments| arguments.starts_with(name.as_str())),
            "{name}"
        );
        let output = cargo_bin_cmd!("volver")
            .args([name.as_str(), "--help"])
            .output()
            .unwrap();
        let help = String::from_utf8(output.stdout).unwrap();
        assert!(help.contains("\nWork: "), "{name}:\n{help}");
    }
}

#[test]
fn what_takes_too_much_is_refused_with_what_it_takes_and_nothing_is_written() {
    let place = Place::new();
    let out = place.path().join("refused");
    for (arguments, what) in [
        (
            "study --cases vacuum --levels 8..281474976710656",
            "the study",
        ),
        (
            "tradeoff --cases vacuum --levels 1..281474976710656",
            "the comparison",
        ),
        (
            "tradeoff --cases vacuum --formats mpfr:1048576 --levels 1..65536",
            "the comparison",
        ),
        ("reproduce --format mpfr:1048576", "the reproduction"),
    ] {
        cargo_bin_cmd!("volver")
            .args(arguments.split(' '))
            .arg("--out")
            .arg(&out)
            .current_dir(place.path())
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(format!("volver: {what} takes about ")))
            .stderr(contains(" of memory and ").and(contains("1.0 h without --yes)")))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
        assert!(!out.exists(), "{arguments}");
    }
    for arguments in [
        "reference kink-moving --integrate --digits 10000",
        "reference oscillating-field --estimate --digits 10000",
    ] {
        cargo_bin_cmd!("volver")
            .args(arguments.split(' '))
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains("volver: the radiance takes about "))
            .stderr(contains("without --yes)"))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
    // What no --yes allows is told, too.
    for arguments in [
        "reference kink-moving --integrate --yes --digits 10000000",
        "reference oscillating-field --estimate --digits 10000000",
        "reference sine-squared --digits 10000000",
    ] {
        cargo_bin_cmd!("volver")
            .args(arguments.split(' '))
            .assert()
            .code(2)
            .stdout("")
            .stderr(starts_with(
                "volver: --digits 10000000: the radiance takes about ",
            ))
            .stderr(contains(" of memory and ").and(contains(" digits, which take ")))
            .stderr(contains(" growing as digits^").and(ends_with("(allowed: 1 to 10000)\n")))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
    // A closed form is evaluated, however many digits it has.
    cargo_bin_cmd!("volver")
        .args(["reference", "sine-squared", "--digits", "10000"])
        .assert()
        .code(0);
}

#[test]
fn input_that_is_refused_leaves_no_directory() {
    let place = Place::new();
    let bad = "[[media]]\nfrom = 0\nto = 0\nkind = \"vacuum\"\n";
    fs::write(place.path().join("bad.toml"), bad).unwrap();
    for arguments in [
        "plan bad.toml --tolerance 1e-3 --out refused",
        "study --cases nowhere --out refused",
        "tradeoff --cases nowhere --out refused",
        "verify --cases nowhere --out refused method:tree/middle/expm1",
        "verify --out refused no-such-program",
        "reproduce --levels 10 --out refused",
        "stress --scenarios none --out refused",
    ] {
        cargo_bin_cmd!("volver")
            .args(arguments.split(' '))
            .current_dir(place.path())
            .assert()
            .code(2)
            .stdout("")
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
        assert!(!place.path().join("refused").exists(), "{arguments}");
    }
}

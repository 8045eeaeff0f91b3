//! `volver reproduce` keeps its contract: JSON, reports, options, bad input.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn volver(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.arg("reproduce").args(arguments);
    command
}

fn json(arguments: &[&str]) -> Value {
    let output = volver(arguments)
        .args(["--json", "-"])
        .assert()
        .code(0)
        .stderr("")
        .get_output()
        .stdout
        .clone();
    serde_json::from_slice(&output).unwrap()
}

fn entries(document: &Value) -> &Vec<Value> {
    document["entries"].as_array().unwrap()
}

fn names<'a>(document: &'a Value, table: &str, axis: &str) -> BTreeSet<&'a str> {
    entries(document)
        .iter()
        .filter(|entry| entry["table"] == table)
        .map(|entry| entry[axis].as_str().unwrap())
        .collect()
}

#[test]
fn json_has_every_entry_with_every_field() {
    let document = json(&["--levels", "8..256"]);
    let outer = BTreeSet::from(["boole", "riemann", "simpson", "trapezoid"]);
    let inner = BTreeSet::from(["riemann", "trapezoid", "simpson", "gauss-3", "monte-carlo"]);
    let mut exact = inner.clone();
    exact.extend(["monte-carlo-independent", "monte-carlo-stratified"]);
    assert_eq!(names(&document, "1-exact", "inner"), exact);
    assert_eq!(names(&document, "1-exact", "outer"), outer);
    assert_eq!(names(&document, "1-linear", "inner"), inner);
    assert_eq!(names(&document, "1-linear", "outer"), outer);
    assert_eq!(
        names(&document, "1-cubic", "inner"),
        BTreeSet::from(["trapezoid"])
    );
    assert_eq!(
        names(&document, "2", "color"),
        BTreeSet::from(["linear", "quadratic-100", "quadratic-10", "no-attenuation"])
    );
    assert_eq!(
        names(&document, "2", "opacity"),
        BTreeSet::from(["linear", "quadratic"])
    );
    assert_eq!(entries(&document).len(), 7 * 4 + 5 * 4 + 1 + 8);
    for entry in entries(&document) {
        for number in [
            "protocol_order",
            "asymptotic_order",
            "asymptotic_half_width",
        ] {
            assert!(entry[number].is_f64(), "{number}: {entry}");
        }
        assert!(entry["paper"].is_null() || entry["paper"].is_f64());
        assert!(entry["note"].is_null() || entry["note"].is_string());
        assert!(entry["verdict"].is_string());
        let levels = entry["levels"].as_array().unwrap();
        let stochastic = entry["replicas"].is_u64();
        assert_eq!(levels.len(), if stochastic { 8 } else { 6 });
        for (k, level) in levels.iter().enumerate() {
            assert_eq!(level["n"], 8 << k);
            assert!(level["error"].is_f64());
        }
    }
}

#[test]
fn one_entry_is_right_in_every_figure() {
    let document = json(&[
        "--inner",
        "trapezoid",
        "--outer",
        "trapezoid",
        "--levels",
        "8..2048",
    ]);
    let tables: Vec<_> = entries(&document).iter().map(|e| &e["table"]).collect();
    assert_eq!(tables, ["1-exact", "1-linear", "1-cubic"]);
    let entry = &entries(&document)[0];
    assert_eq!(entry["paper"], 2.0);
    assert_eq!(entry["verdict"], "Confirmed");
    assert_eq!(entry["expected_order"], 2.0);
    assert_eq!(entry["format"], "mpfr:128");
    // By mpmath with 40 digits: nested trapezoids on 8 segments less the closed form.
    let error = entry["levels"][0]["error"].as_f64().unwrap();
    assert!(
        (error + 0.000_362_110_451_224_930_88).abs() < 1e-18,
        "{error}"
    );
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_one_other_samples() {
    let run = |seed| {
        let arguments = ["--inner", "monte-carlo-stratified", "--seed", seed];
        json(&arguments).to_string()
    };
    let first = run("7");
    assert_eq!(first, run("7"));
    assert_ne!(first, run("8"));
}

#[test]
fn coarse_formats_never_confirm_a_wrong_order() {
    let document = json(&["--format", "f16", "--format", "bf16", "--format", "f32"]);
    let mut seen = BTreeSet::new();
    for entry in entries(&document) {
        if entry["replicas"].is_u64() {
            continue;
        }
        seen.insert(entry["format"].as_str().unwrap());
        let verdict = entry["verdict"].as_str().unwrap();
        assert!(
            ["FloorLimited", "Confirmed", "PreAsymptotic", "Blind"].contains(&verdict),
            "{entry}"
        );
        if verdict == "Confirmed" {
            let distance = entry["asymptotic_order"].as_f64().unwrap()
                - entry["expected_order"].as_f64().unwrap();
            assert!(distance.abs() <= 0.25, "{entry}");
            assert!(entry["window"].is_array(), "{entry}");
        }
    }
    assert_eq!(seen, BTreeSet::from(["bf16", "f16", "f32"]));
}

#[test]
fn a_report_is_a_directory_of_whole_files() {
    let parent = tempfile::tempdir().unwrap();
    let directory = parent.path().join("new/report");
    volver(&["--table", "2", "--levels", "8..256", "--out"])
        .arg(&directory)
        .assert()
        .code(0)
        .stdout(predicate::str::contains("quadratic-100"))
        .stderr("");
    let mut files: Vec<String> = fs::read_dir(&directory)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    assert_eq!(
        files,
        ["index.html", "report.json", "report.md", "table-2.svg"]
    );
    let report = fs::read_to_string(directory.join("report.md")).unwrap();
    assert!(report.contains("](table-2.svg)"), "{report}");
}

#[test]
fn bad_input_is_named_in_one_line_and_leaves_no_file() {
    let parent = tempfile::tempdir().unwrap();
    let file = parent.path().join("file");
    fs::write(&file, "mine").unwrap();
    let below = file.join("below");
    let below = below.to_str().unwrap();
    let out = parent.path().join("out");
    let out = out.to_str().unwrap();
    for (arguments, message) in [
        (vec!["--table", "3"], "unknown table '3' (allowed: 1, 2)"),
        (
            vec!["--inner", "simspon"],
            "unknown rule 'simspon' (allowed: riemann, trapezoid, simpson, gauss-3, monte-carlo, ",
        ),
        (
            vec!["--outer", "gauss-3"],
            "unknown rule 'gauss-3' (allowed: riemann, trapezoid, simpson, boole)",
        ),
        (
            vec!["--table", "2", "--inner", "simpson"],
            "--inner and --outer choose rules of Table 1",
        ),
        (
            vec!["--format", "f128"],
            "unknown format 'f128' (allowed: f16, bf16, f32, f64, f32-lanes, f64-lanes, tf32, fp8-e4m3, fp8-e5m2, ieee:BITS,EMIN,EMAX, fixed:FRACTION, fixed:INTEGER.FRACTION, mpfr:BITS)",
        ),
        (
            vec!["--format", "mpfr:1"],
            "'mpfr:1' is out of range (allowed: mpfr:2 … mpfr:1048576)",
        ),
        (
            vec!["--format", "mpfr:99999999999"],
            "'mpfr:99999999999' is out of range (allowed: ",
        ),
        (
            vec!["--levels", "10,20,40"],
            "n = 10 segments do not suit boole (allowed: positive multiples of 4)",
        ),
        (
            vec!["--outer", "simpson", "--levels", "9,18"],
            "n = 9 segments do not suit simpson (allowed: positive multiples of 2)",
        ),
        (
            vec!["--levels", "0"],
            "0 segments are not allowed (allowed: 1 to 281474976710656)",
        ),
        (
            vec!["--levels", "many"],
            "ladder 'many' has no known form (allowed: ",
        ),
        (
            vec!["--levels", "d=0.1"],
            "'d=0.1' is a ladder of steps (allowed: numbers of segments)",
        ),
        (
            vec!["--seed", "one"],
            "invalid value 'one' for '--seed <SEED>'",
        ),
        (vec!["--table", "2", "--out", below], below),
        (vec!["--table", "2", "--json", below], below),
        // What is wrong is said before a directory is made.
        (vec!["--levels", "10,20", "--out", out], "n = 10 segments"),
    ] {
        volver(&arguments)
            .assert()
            .code(2)
            .stdout("")
            .stderr(predicate::str::starts_with("volver: "))
            .stderr(predicate::str::contains(message))
            .stderr(predicate::str::contains("(allowed: "))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
    let left: Vec<_> = fs::read_dir(parent.path()).unwrap().collect();
    assert_eq!(left.len(), 1);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    assert!(!Path::new(out).exists());
}

#[test]
fn lines_fit_a_terminal_and_colours_show_on_request_only() {
    let run = |color| {
        let arguments = ["--table", "2", "--levels", "8..256", "--color", color];
        let output = volver(&arguments)
            .assert()
            .code(0)
            .get_output()
            .stdout
            .clone();
        String::from_utf8(output).unwrap()
    };
    let plain = run("auto");
    assert!(
        plain.lines().all(|line| line.chars().count() <= 80),
        "{plain}"
    );
    assert!(!plain.contains('\x1b'));
    assert!(run("always").contains("\x1b["));
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
    let output = volver(&["--help"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let (_, examples) = text.split_once("Examples:\n").unwrap();
    let examples: Vec<&str> = examples
        .lines()
        .map_while(|line| line.strip_prefix("  "))
        .collect();
    assert!(examples.len() >= 4, "{examples:?}");
    for example in examples {
        if example == "volver reproduce --nonsmooth" {
            // Its other test runs it, with the same exit code and as little on standard error.
            assert!(!super::nonsmooth::TOLD.text.is_empty());
            continue;
        }
        Command::new("sh")
            .args(["-c", example])
            .env("PATH", &path)
            .assert()
            .code(0)
            .stdout(predicate::str::is_empty().not())
            .stderr("");
    }
}

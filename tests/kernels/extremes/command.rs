//! `volver verify --extremes`.

use crate::verify::run::{Marked, Run, volver};
use serde_json::Value;
use std::fs;

fn of_method(name: &str) -> Run {
    volver(&["verify", "--extremes", &format!("method:{name}")])
}

/// The fixture, which composites by 1 − e^(−x).
fn fixture(kernel: &[&str]) -> Run {
    let marked = Marked::new();
    let kernel = marked.kernel(kernel);
    let kernel: Vec<&str> = kernel.iter().map(String::as_str).collect();
    let run = volver(&[&["verify", "--extremes"][..], &kernel].concat());
    marked.assert_gone();
    run
}

#[test]
fn the_exit_code_says_whether_promises_are_kept() {
    let run = of_method("front-to-back/middle/subtraction@f32").with_code(0);
    run.shows("16 answers: all have the digits that format and method promise");
    run.shows("0 0, where the truth is not");
    fixture(&[]).with_code(0);
    let run = fixture(&["--declare", r#"{"order":2}"#]).with_code(1);
    run.shows("expm1 keeps them");
    run.shows("have fewer digits than format and method promise, or none");
    let wide = run.out.lines().find(|line| line.chars().count() > 80);
    assert_eq!(wide, None);
}

/// A kernel that dies in vacuum answers the rest.
#[test]
fn no_answer_is_a_word_of_its_own() {
    let run = fixture(&["--trouble", "dies", "--case", "vacuum/all"]).with_code(1);
    run.shows("vacuum/all none!");
    run.shows("was killed by signal 11");
    run.shows("16 answers: 1 have fewer digits");
    let run = fixture(&["--trouble", "nan", "--case", "depth/1e2"]).with_code(1);
    run.shows("depth/1e2: NaN, where the truth is 1.00e0");
}

#[test]
fn json_and_files_have_every_cell() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let method = "method:front-to-back/middle/expm1";
    let out = out.to_str().unwrap();
    let run = volver(&["verify", "--extremes", "--json", "-", "--out", out, method]).with_code(0);
    let json = run.json();
    assert_eq!(json["wrong"], 0);
    let cells = json["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 16);
    let of = |name: &str| {
        let mut cells = cells.iter();
        cells.find(|cell| cell["scenario"] == name).unwrap().clone()
    };
    assert_eq!(of("vacuum/all")["digits"], "exact");
    assert_eq!(of("fault/negative-tau")["answer"], "amplified");
    assert!(of("depth/1e-12")["digits"]["of"].as_f64() > Some(14.0));
    assert_eq!(of("depth/1e0")["answer"], Value::Null);
    let read = |name: &str| fs::read_to_string(format!("{out}/{name}")).unwrap();
    assert_eq!(read("extremes.json"), run.out);
    assert!(read("extremes.md").contains("depth/1e-12"));
    assert!(read("index.html").contains("fault/negative-tau"));
}

#[test]
fn other_questions_are_asked_without_it() {
    for option in [
        &["--cases", "thick"][..],
        &["--ladder", "8..64"],
        &["--divide"],
        &["--expect", "2"],
        &["--save", "base.json"],
        &["--junit", "-"],
    ] {
        let arguments = [&["verify", "--extremes"][..], option, &["method:x"]].concat();
        let run = volver(&arguments).with_code(2);
        assert!(run.err.contains("--extremes"), "{}", run.err);
        assert!(run.err.contains(option[0]), "{}", run.err);
    }
}

#[test]
fn a_kernel_that_does_not_run_is_said_in_one_line() {
    let run = volver(&["verify", "--extremes", "./no-such-kernel"]).with_code(2);
    assert!(run.err.contains("does not start"), "{}", run.err);
    let run = fixture(&["--trouble", "refuses"]).with_code(2);
    assert!(run.err.contains("refuses"), "{}", run.err);
}

//! `volver tradeoff`: deterministic without times, complete in every form, and clear about what is wrong.

mod costs;
mod counting;
mod fronts;
mod remainder;

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::fs;

fn volver(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.arg("tradeoff").args(arguments);
    command
}

fn output(arguments: &[&str]) -> String {
    let output = volver(arguments).assert().success().get_output().clone();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    String::from_utf8(output.stdout).unwrap()
}

/// Two cases, few methods, nothing timed.
const SMALL: [&str; 10] = [
    "--cases",
    "sine-squared,vacuum",
    "--methods",
    "trapezoid/trapezoid,simpson/boole,gauss-4/gauss-4,front-to-back/middle/expm1",
    "--formats",
    "f32,f64,mpfr:160",
    "--levels",
    "1..256",
    "--cost",
    "evaluations",
];

fn small(more: &[&'static str]) -> Vec<&'static str> {
    [&SMALL[..], more].concat()
}

#[test]
fn counted_costs_give_the_same_bytes_again_on_any_number_of_threads() {
    let one = output(&small(&["--json", "-", "--threads", "1"]));
    let many = output(&small(&["--json", "-", "--threads", "4"]));
    assert_eq!(one, many);
    assert_eq!(output(&small(&[])), output(&small(&[])));
}

#[test]
fn the_table_has_the_cheapest_way_and_the_usual_one() {
    let text = output(&small(&[]));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("tradeoff_by_evaluations", text));
}

#[test]
fn every_goal_of_the_document_is_reached_at_the_least_cost() {
    let document: Value = serde_json::from_str(&output(&small(&["--json", "-"]))).unwrap();
    assert_eq!(document["timing"], Value::Null);
    let case = &document["cases"][0];
    let error = |point: &Value| match &point["outcome"]["error"] {
        Value::String(text) => text.parse().unwrap(),
        number => number.as_f64().unwrap_or(f64::NAN),
    };
    let mut reached = 0;
    for goal in case["cheapest"].as_array().unwrap() {
        let wanted: f64 = goal["error"].as_str().unwrap().parse().unwrap();
        let evaluations = |point: &Value| {
            let counts = &point["counts"];
            counts["transfer"].as_u64().unwrap_or(0) + counts["extinction"].as_u64().unwrap_or(0)
        };
        let units = case["units"].as_array().unwrap();
        let points = units
            .iter()
            .flat_map(|unit| unit["points"].as_array().unwrap());
        let good = points.filter(|p| p["only_usual"] == false && error(p) <= wanted);
        let least = good.map(evaluations).min();
        assert_eq!(goal["best"]["evaluations"].as_u64(), least, "{wanted}");
        reached += usize::from(least.is_some());
    }
    assert!(reached > 20, "{reached}");
    // Binary32 ends where its digits do, whatever n.
    let usual = |k: usize| &case["cheapest"][k]["usual"];
    assert!(usual(0).is_object());
    assert!(usual(8).is_null());
}

#[test]
fn a_directory_gets_every_report_and_a_journal() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out");
    let path = out.to_str().unwrap();
    let arguments = [&SMALL[..], &["--out", path, "--quiet"]].concat();
    assert_eq!(output(&arguments), "");
    let mut names: Vec<String> = fs::read_dir(&out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "index.html",
            "tradeoff-sine-squared.svg",
            "tradeoff-vacuum.svg",
            "tradeoff.csv",
            "tradeoff.json",
            "tradeoff.jsonl",
            "tradeoff.md",
            "tradeoff.tex",
        ]
    );
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    // A header, and a unit for each case and format.
    assert_eq!(read("tradeoff.jsonl").lines().count(), 1 + 2 * 3);
    for line in read("tradeoff.jsonl").lines() {
        serde_json::from_str::<Value>(line).unwrap();
    }
    // Four methods and the usual one, which is there in binary32 alone, at nine levels.
    assert_eq!(
        read("tradeoff.csv").lines().count(),
        1 + 2 * 9 * (3 * 4 + 1)
    );
    assert!(read("tradeoff-vacuum.svg").contains(": nothing to draw ("));
    assert!(read("tradeoff-sine-squared.svg").contains("gauss-4/gauss-4"));
    assert!(read("tradeoff.md").contains("(tradeoff-sine-squared.svg)"));
    assert!(read("tradeoff.tex").contains("\\toprule"));
    let before = read("tradeoff.json");
    output(&arguments);
    assert_eq!(read("tradeoff.json"), before);
}

/// s ln s has no bound near 0 in the complex plane: errors are against an estimate.
#[test]
fn a_radiance_that_is_an_estimate_is_named_as_one() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("open.toml");
    let text = "name = \"open\"\nlength = 1\nextinction = \"1\"\n\
        emission = \"1 + s*ln(s + piecewise(s <= 0, 1, 0))\"\n";
    fs::write(&file, text).unwrap();
    let run = |more: &[&str]| {
        let mut command = volver(&["--cost", "evaluations", "--formats", "f64"]);
        command
            .args(["--methods", "trapezoid/trapezoid", "--levels", "8..64"])
            .arg("--cases")
            .arg(&file)
            .args(more);
        String::from_utf8(command.output().unwrap().stdout).unwrap()
    };
    let text = run(&[]);
    assert!(text.contains("open, I(D): an estimate: no bound"), "{text}");
    let document: Value = serde_json::from_str(&run(&["--json", "-"])).unwrap();
    let unproved = document["cases"][0]["unproved"].as_array().unwrap();
    assert!(unproved.iter().any(|open| open["claim"] == "I(D)"));
    let proved: Value = serde_json::from_str(&output(&small(&["--json", "-"]))).unwrap();
    assert!(proved["cases"][0].get("unproved").is_none());
}

#[test]
fn times_are_there_where_they_are_asked_for() {
    let text = output(&[
        "--cases",
        "homogeneous",
        "--methods",
        "trapezoid/trapezoid",
        "--formats",
        "f64",
        "--levels",
        "1,16",
        "--cost",
        "measured",
        "--json",
        "-",
    ]);
    let document: Value = serde_json::from_str(&text).unwrap();
    let point = &document["cases"][0]["units"][0]["points"][1];
    assert!(
        point["measured"]["median"].as_f64().unwrap() > 0.0,
        "{point}"
    );
    assert!(point["modelled"].as_f64().unwrap() > 0.0, "{point}");
    assert!(document["timing"]["within_1_5"].is_array());
}

#[test]
fn bad_input_is_named_in_one_line() {
    for (arguments, message) in [
        (
            &[][..],
            "the following required arguments were not provided: --cases <CASES> (allowed: see --help)",
        ),
        (&["--cases", "bogus"][..], "'bogus'"),
        (
            &["--cases", "@bogus"],
            "no case has the tag 'bogus' (allowed: ",
        ),
        (
            &["--cases", "vacuum", "--methods", "bogus/boole"],
            "--methods: method 'bogus/boole'",
        ),
        (&["--cases", "vacuum", "--formats", "f33"], "--formats: "),
        (&["--cases", "vacuum", "--levels", "0..8"], "--levels: "),
        (
            &["--cases", "vacuum", "--levels", "d=0.1,0.05"],
            "--levels: 'd=0.1,0.05' is a ladder of steps",
        ),
        (
            &["--cases", "vacuum", "--cost", "money"],
            "invalid value 'money' for '--cost <COST>' (allowed: evaluations, operations, modelled, measured)",
        ),
        (
            &["--cases", "vacuum", "--json", "-", "--csv", "-"],
            "'--json -' and '--csv -' both go to standard output (allowed: one of them with a file)",
        ),
        (
            &["--cases", "vacuum", "--latex", "-", "--csv", "-"],
            "'--csv -' and '--latex -' both go to standard output (allowed: one of them with a file)",
        ),
        (
            &["--cases", "vacuum", "--out", "/dev/null/x"],
            "/dev/null/x",
        ),
    ] {
        let output = volver(arguments).assert().code(2).get_output().clone();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.contains(message), "{said}");
    }
}

//! `volver study` keeps its contract: outputs, resuming, threads, bad input.

use assert_cmd::Command;
use assert_cmd::cargo::{cargo_bin, cargo_bin_cmd};
use predicates::prelude::*;
use predicates::str::{contains, starts_with};
use rug::Float;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;
use volver::case::{catalogue, manufacture::manufacture};
use volver::study::sweep::{Errors, Estimate, Sweep};

fn volver(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.arg("study").args(arguments);
    command
}

/// Two cases, three methods, three formats, six levels, and a map.
const STUDY: [&str; 10] = [
    "--cases",
    "sine-squared,rgb-transfer/red",
    "--methods",
    "trapezoid/trapezoid,simpson/boole,gauss-2/simpson",
    "--formats",
    "f32,ieee:11,-14,15,mpfr:70",
    "--levels",
    "8..256",
    "--sweep-bits",
    "6..9",
];

fn study(directory: &Path, more: &[&str]) -> Command {
    let mut command = volver(&STUDY);
    command.arg("--out").arg(directory).args(more);
    command
}

/// Every file by name, except the page, and without the line of `study.md` with the command.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(directory).unwrap();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().unwrap();
        let mut contents = fs::read(entry.path()).unwrap();
        if name == "study.md" {
            let text = String::from_utf8(contents).unwrap();
            let (before, rest) = text.split_once("- **command**: ").unwrap();
            let (_, after) = rest.split_once('\n').unwrap();
            contents = [before, after].concat().into_bytes();
        }
        (name, contents)
    };
    let all = entries.map(|entry| file(entry.unwrap()));
    all.filter(|(name, _)| name != "index.html").collect()
}

fn assert_same(found: &BTreeMap<String, Vec<u8>>, wanted: &BTreeMap<String, Vec<u8>>) {
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(found), names(wanted));
    for (name, bytes) in found {
        assert!(*bytes == wanted[name], "{name} differs");
    }
}

#[test]
fn a_study_has_all_outputs_whatever_the_number_of_threads() {
    let parent = tempfile::tempdir().unwrap();
    let (one, two) = (parent.path().join("one"), parent.path().join("two"));
    study(&one, &["--threads", "1"])
        .assert()
        .code(0)
        .stderr("")
        .stdout(contains("sine-squared, trapezoid/trapezoid: theory 2\n"))
        .stdout(contains("18 lines, discretization: "))
        .stdout(contains(" files in "));
    study(&two, &["--threads", "2", "--quiet"])
        .assert()
        .code(0)
        .stdout("")
        .stderr("");
    let found = files(&one);
    assert_same(&files(&two), &found);
    assert!(one.join("index.html").exists());
    for name in [
        "study.jsonl",
        "study.csv",
        "study.json",
        "study.tex",
        "study.md",
    ] {
        assert!(found.contains_key(name), "{name}");
    }
    // A plot and a map for each of 2 cases × 3 methods; the document shows all.
    let plots: Vec<&String> = found
        .keys()
        .filter(|name| Path::new(name).extension().is_some_and(|e| e == "svg"))
        .collect();
    assert_eq!(plots.len(), 12);
    let document = String::from_utf8(found["study.md"].clone()).unwrap();
    for plot in plots {
        assert!(document.contains(&format!("({plot})")), "{plot}");
    }
    parts_add_up(&found["study.csv"]);
    summaries(&serde_json::from_slice(&found["study.json"]).unwrap());
}

fn parts_add_up(csv: &[u8]) {
    let mut reader = csv::Reader::from_reader(csv);
    let head = reader.headers().unwrap().clone();
    let mut rows = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let text = |name: &str| &record[head.iter().position(|column| column == name).unwrap()];
        let number = |name: &str| Float::with_val(200, Float::parse(text(name)).unwrap());
        assert_eq!(text("state"), "split", "{record:?}");
        let total = number("total");
        let parts = [
            "discretization",
            "truncation",
            "input_rounding",
            "arithmetic_rounding",
        ]
        .map(number);
        let largest = parts
            .iter()
            .map(|part| part.clone().abs())
            .fold(Float::new(200), |a, b| a.max(&b));
        let sum = parts.iter().fold(Float::new(200), |sum, part| sum + part);
        let off = Float::with_val(200, sum - &total).abs();
        assert!(off <= Float::with_val(200, &largest * 1e-17), "{record:?}");
        rows += 1;
    }
    assert_eq!(rows, 2 * 3 * (3 + 4) * 6);
}

fn summaries(document: &Value) {
    assert_eq!(document["volver"], env!("CARGO_PKG_VERSION"));
    let settings = &document["settings"];
    assert_eq!(
        settings["cases"],
        serde_json::json!(["sine-squared", "rgb-transfer/red"])
    );
    assert_eq!(
        settings["levels"],
        serde_json::json!([8, 16, 32, 64, 128, 256])
    );
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2 * 3 * 7);
    let first = &rows[0];
    assert_eq!(
        (&first["method"], &first["format"]),
        (&"trapezoid/trapezoid".into(), &"f32".into())
    );
    assert_eq!(first["discretization"]["verdict"], "Confirmed");
    assert!((first["discretization"]["order"].as_f64().unwrap() - 2.0).abs() < 0.02);
    // 3.6e-4 at n = 8 by mpmath, order 2 and roundoff of about 2⁻²⁴ of I: some thousand segments.
    let crossing = first["crossing"].as_f64().unwrap();
    assert!((100.0..1e5).contains(&crossing), "{crossing}");
    for row in rows {
        assert_eq!(row["states"]["split"], 6, "{row}");
        assert_eq!(row["contradicts_theory"], false, "{row}");
        assert_eq!(row["bits_needed"].as_array().unwrap().len(), 4);
    }
}

#[test]
fn a_study_that_was_killed_goes_on_to_the_same_bytes() {
    let parent = tempfile::tempdir().unwrap();
    let whole = parent.path().join("whole");
    study(&whole, &["--quiet"]).assert().code(0);
    let wanted = files(&whole);

    let killed = parent.path().join("killed");
    let mut child = std::process::Command::new(cargo_bin!("volver"))
        .arg("study")
        .args(STUDY)
        .args(["--quiet", "--threads", "1", "--out"])
        .arg(&killed)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let journal = killed.join("study.jsonl");
    let lines = || {
        fs::read_to_string(&journal)
            .unwrap_or_default()
            .lines()
            .count()
    };
    for _ in 0..60_000 {
        if lines() >= 2 || child.try_wait().unwrap().is_some() {
            break;
        }
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = lines();
    assert!(
        (2..=14).contains(&left),
        "{left} lines: killed in the middle"
    );
    assert!(!killed.join("study.md").exists());

    study(&killed, &["--quiet"])
        .assert()
        .code(2)
        .stderr(contains(
            "holds results already (allowed: --resume to go on, or another directory)",
        ));
    study(&killed, &["--quiet", "--resume"]).assert().code(0);
    assert_same(&files(&killed), &wanted);

    // In the middle of a line.
    let half = parent.path().join("half");
    fs::create_dir(&half).unwrap();
    let text = &wanted["study.jsonl"];
    let ends: Vec<usize> = (0..text.len()).filter(|at| text[*at] == b'\n').collect();
    fs::write(
        half.join("study.jsonl"),
        &text[..usize::midpoint(ends[4], ends[5])],
    )
    .unwrap();
    study(&half, &["--quiet", "--resume"]).assert().code(0);
    assert_same(&files(&half), &wanted);

    // Nothing left to do.
    study(&half, &["--quiet", "--resume"]).assert().code(0);
    assert_same(&files(&half), &wanted);

    refused_journals(&half);
}

#[test]
fn a_resumed_study_has_the_page_of_one_that_was_not() {
    let parent = tempfile::tempdir().unwrap();
    let run = |place: &str, more: &[&str]| {
        let directory = parent.path().join(place);
        let arguments = ["--cases", "vacuum,homogeneous", "--levels", "8..64"];
        let mut command = volver(&arguments);
        command.args(["--quiet", "--out", "kept"]).args(more);
        command.current_dir(&directory).assert().code(0);
        directory.join("kept")
    };
    for place in ["whole", "resumed"] {
        fs::create_dir(parent.path().join(place)).unwrap();
    }
    let whole = run("whole", &[]);
    let resumed = parent.path().join("resumed/kept");
    fs::create_dir(&resumed).unwrap();
    let journal = fs::read_to_string(whole.join("study.jsonl")).unwrap();
    let begun: Vec<&str> = journal.split_inclusive('\n').take(3).collect();
    fs::write(resumed.join("study.jsonl"), begun.concat()).unwrap();
    run("resumed", &["--resume"]);
    for entry in fs::read_dir(&whole).unwrap() {
        let name = entry.unwrap().file_name();
        let read = |directory: &Path| fs::read(directory.join(&name)).unwrap();
        assert!(read(&whole) == read(&resumed), "{name:?} differs");
    }
}

/// Journals of something else, which stay as they are.
fn refused_journals(directory: &Path) {
    let journal = directory.join("study.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let mut other = volver(&[
        "--cases",
        "sine-squared",
        "--levels",
        "8..64",
        "--resume",
        "--out",
    ]);
    other
        .arg(directory)
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains(
            "holds another study: its cases are sine-squared 1 ",
        ))
        .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    assert_eq!(fs::read_to_string(&journal).unwrap(), text);

    let mut lines: Vec<&str> = text.lines().collect();
    lines[2] = "{\"case\":";
    let broken = lines.join("\n") + "\n";
    fs::write(&journal, &broken).unwrap();
    study(directory, &["--resume"])
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("study.jsonl, line 3: "))
        .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    assert_eq!(fs::read_to_string(&journal).unwrap(), broken);
}

#[test]
fn a_file_says_what_options_do_and_options_go_before_it() {
    let parent = tempfile::tempdir().unwrap();
    fs::create_dir(parent.path().join("mine")).unwrap();
    let case = "name = \"own\"\nlength = 1\ndepth = \"lambda\"\nradiance = \"1 - exp(-lambda)\"\n";
    fs::write(parent.path().join("mine/own.toml"), case).unwrap();
    let file = parent.path().join("study.toml");
    let text = "cases = [\"mine/own.toml\", \"rgb-transfer\"]\nmethods = [\"midpoint/midpoint\"]\n\
                formats = [\"ieee:11,-14,15\"]\nlevels = [8, 16, 32, 64]\nsweep-bits = \"8..8\"\n";
    fs::write(&file, text).unwrap();
    let run = |more: &[&str]| -> Value {
        let mut command = volver(&[file.to_str().unwrap(), "--json", "-"]);
        let output = command
            .args(more)
            .assert()
            .code(0)
            .stderr("")
            .get_output()
            .stdout
            .clone();
        serde_json::from_slice(&output).unwrap()
    };
    let settings = run(&[])["settings"].clone();
    let channels = [
        "own",
        "rgb-transfer/red",
        "rgb-transfer/green",
        "rgb-transfer/blue",
    ];
    let mut cases: Vec<&str> = settings["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| c.as_str().unwrap())
        .collect();
    cases.sort_unstable();
    let mut wanted = channels;
    wanted.sort_unstable();
    assert_eq!(cases, wanted);
    assert_eq!(
        settings["methods"],
        serde_json::json!(["midpoint/midpoint"])
    );
    assert_eq!(
        settings["formats"],
        serde_json::json!(["ieee:11,-14,15", "mpfr:8"])
    );
    assert_eq!(settings["levels"], serde_json::json!([8, 16, 32, 64]));
    let settings = run(&[
        "--cases",
        "homogeneous",
        "--levels",
        "4..8",
        "--formats",
        "f16 bf16",
    ])["settings"]
        .clone();
    assert_eq!(settings["cases"], serde_json::json!(["homogeneous"]));
    assert_eq!(
        settings["formats"],
        serde_json::json!(["f16", "bf16", "mpfr:8"])
    );
    assert_eq!(settings["levels"], serde_json::json!([4, 8]));
    // A number behind a comma belongs to the format before it.
    let settings = run(&["--formats", "ieee:8,-126,127;mpfr:53 f16"])["settings"].clone();
    assert_eq!(
        settings["formats"],
        serde_json::json!(["ieee:8,-126,127", "mpfr:53", "f16", "mpfr:8"])
    );
}

#[test]
fn bad_input_is_named_in_one_line() {
    let cases = ["--cases", "homogeneous"];
    for (more, message) in [
        (
            &["--methods", "trapezoid/simpsn"][..],
            "--methods: method 'trapezoid/simpsn': unknown outer rule 'simpsn' (allowed: ",
        ),
        (
            &["--methods", "trapezoid"],
            "--methods: method 'trapezoid': outer rule missing at the end (allowed: ",
        ),
        (
            &["--methods", " ,"],
            "--methods: no methods (allowed: one or more)",
        ),
        (
            &["--methods", "boole/boole,boole/boole"],
            "--methods: 'boole/boole' a second time (allowed: each method once)",
        ),
        (
            &["--formats", "f31"],
            "--formats: unknown format 'f31' (allowed: f16, ",
        ),
        (
            &["--formats", "ieee:11,-14"],
            "--formats: '11,-14' of format 'ieee:11,-14' are no three",
        ),
        (
            &["--formats", "f32", "--formats", "f32"],
            "--formats: 'f32' a second time (allowed: each format once)",
        ),
        (
            &["--formats", ""],
            "--formats: no formats (allowed: one or more)",
        ),
        (
            &["--formats", " ,; "],
            "--formats: no formats (allowed: one or more)",
        ),
        (
            &["--levels", "ten"],
            "--levels: ladder 'ten' has no known form (allowed: ",
        ),
        (
            &["--levels", "d=0.1"],
            "--levels: 'd=0.1' is a ladder of steps (allowed: numbers of segments)",
        ),
        (
            &["--sweep-bits", "9..4"],
            "--sweep-bits: '9..4' is no range of bits (allowed: A..B with 2 ≤ A ≤ B ≤ 256)",
        ),
        (
            &["--sweep-bits", "1..9"],
            "--sweep-bits: '1..9' is no range of bits",
        ),
        (
            &["--errors", "totl"],
            "--errors: unknown errors 'totl' (allowed: split, total)",
        ),
        (
            &["--resume"],
            "the following required arguments were not provided: --out <DIR>",
        ),
        (
            &["--threads", "0"],
            "invalid value '0' for '--threads <N>': 0 is not in 1..=1024",
        ),
        (
            &["--json", "-", "--csv", "-"],
            "'--json -' and '--csv -' both go to standard output",
        ),
        (
            &["--cases", "homogeneous"],
            "--cases: a case 'homogeneous' a second time (allowed: each name once)",
        ),
        (&["--cases", "nowhere"], "--cases: no case 'nowhere' ("),
        (
            &["--cases", "rgb-transfer/pink"],
            "--cases: no channel 'pink' in rgb-transfer (allowed: ",
        ),
        (
            &["--cases", "@nothing"],
            "--cases: no case has the tag 'nothing' (allowed: ",
        ),
        (&["--cases", "no/where.toml"], "no/where.toml: "),
    ] {
        refused(&[&cases, more].concat(), &format!("volver: {message}"));
    }
    refused(&[], "volver: no cases (allowed: --cases with names");
    refused(&["no-such-study.toml"], "volver: no-such-study.toml: ");
}

fn refused(arguments: &[&str], message: &str) {
    volver(arguments)
        .assert()
        .code(2)
        .stdout("")
        .stderr(starts_with(message.to_string()))
        .stderr(contains("(allowed: "))
        .stderr(predicate::function(|text: &str| text.lines().count() == 1));
}

#[test]
fn bad_files_are_named_with_their_line() {
    let parent = tempfile::tempdir().unwrap();
    let file = parent.path().join("study.toml");
    for (text, message) in [
        (
            "cases = [\"homogeneous\"]\nlevel = 3",
            "line 2: unknown field 'level' (allowed: 'cases', ",
        ),
        ("cases = []", "line 1: no cases (allowed: one or more)"),
        (
            "\ncases = [\"homogeneous\",\n  \"homogeneus\"]",
            "line 3: no case 'homogeneus' (nearest: homogeneous",
        ),
        (
            "cases = [\"vacuum\"]\nmethods = [\"a/b\"]",
            "line 2: method 'a/b': unknown inner rule or kind of method 'a' (allowed: ",
        ),
        (
            "cases = [\"vacuum\"]\nformats = [\"f32\",\n\"f32\"]",
            "line 3: 'f32' a second time",
        ),
        (
            "cases = [\"vacuum\"]\nlevels = [8, 8]",
            "line 2: 8 segments after 8 are not allowed",
        ),
        (
            "cases = [\"vacuum\"]\nsweep-bits = \"x\"",
            "line 2: 'x' is no range of bits",
        ),
        (
            "cases = \"vacuum\"",
            "line 1: invalid type: string \"vacuum\" (allowed: a sequence)",
        ),
        ("cases = [", "line 1: "),
    ] {
        fs::write(&file, text).unwrap();
        let said = volver(&[file.to_str().unwrap()])
            .assert()
            .code(2)
            .stdout("")
            .get_output()
            .stderr
            .clone();
        let said = String::from_utf8(said).unwrap();
        assert!(
            said.contains(&format!("study.toml, {message}"))
                || said.contains(&format!("study.toml: {message}")),
            "{said}"
        );
        assert!(
            said.lines().count() == 1 && said.contains("allowed: "),
            "{said}"
        );
    }
}

#[test]
fn levels_that_do_not_fit_are_refused_with_what_they_take() {
    let levels = ["--cases", "homogeneous", "--levels", "8..1099511627776"];
    for more in [&[][..], &["--yes"]] {
        volver(&[&levels, more].concat())
            .assert()
            .code(2)
            .stdout("")
            .stderr(starts_with("volver: the study takes about "))
            .stderr(contains(" of memory and ").and(contains(" (allowed: up to ")))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
    // It is about --yes where a machine could hold it.
    volver(&["--cases", "homogeneous", "--levels", "8..4194304"])
        .assert()
        .code(2)
        .stderr(contains("GiB and 1.0 h without --yes)"));
}

/// A number of a unit, in the unit below it.
fn magnitude(told: &str, units: &[(&str, f64)]) -> (f64, f64) {
    let (number, unit) = told.split_once(' ').unwrap();
    let index = units.iter().position(|(name, _)| *name == unit).unwrap();
    let factor: f64 = units[..=index].iter().map(|(_, factor)| factor).product();
    let number: f64 = number.parse().unwrap();
    // The unit fits, and a number below 10 has a decimal.
    let next = units.get(index + 1).map_or(f64::INFINITY, |(_, f)| *f);
    assert!((index == 0 || number >= 1.0) && number <= next, "{told}");
    assert_eq!(told.contains('.'), number < 10.0 && index > 0, "{told}");
    let digit = if told.contains('.') { 0.1 } else { 1.0 };
    (number * factor, 0.501 * digit * factor)
}

#[test]
fn what_a_study_takes_is_told_in_fitting_units() {
    let description = catalogue::find("homogeneous").unwrap().unwrap();
    let case = manufacture(&description).unwrap().remove(0).case;
    for exponent in [23, 30, 40, 48] {
        let sweep = Sweep {
            cases: vec![("homogeneous".into(), case.clone())],
            methods: vec!["trapezoid/trapezoid".parse().unwrap()],
            formats: vec!["f64".parse().unwrap()],
            levels: (3..=exponent).map(|k| 1 << k).collect(),
            errors: Errors::Split,
        };
        let estimate = Estimate::new(&sweep, 2);
        let levels = format!("8..{}", 1_u64 << exponent);
        let said = volver(&["--cases", "homogeneous", "--threads", "2"])
            .args(["--methods", "trapezoid/trapezoid", "--formats", "f64"])
            .args(["--levels", &levels])
            .assert()
            .code(2)
            .get_output()
            .stderr
            .clone();
        let said = String::from_utf8(said).unwrap();
        let told = said.strip_prefix("volver: the study takes about ").unwrap();
        let (told, _) = told.split_once(" (allowed: ").unwrap();
        let (memory, time) = told.split_once(" of memory and ").unwrap();
        let binary = ["bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"];
        let binary = binary.map(|name| (name, if name == "bytes" { 1.0 } else { 1024.0 }));
        let times = [
            ("s", 1.0),
            ("min", 60.0),
            ("h", 60.0),
            ("days", 24.0),
            ("years", 365.0),
        ];
        for ((told, off), exact) in [
            (magnitude(memory, &binary), estimate.bytes),
            (magnitude(time, &times), estimate.seconds(2)),
        ] {
            assert!((told - exact).abs() <= off, "{said}: {exact}");
        }
    }
}

#[test]
fn a_contradiction_of_theory_is_told_by_the_exit_code() {
    // Off the nodes a jump's error alternates in sign over doublings: no order shows.
    let jump = [
        "--cases",
        "jump-off-node",
        "--methods",
        "trapezoid/trapezoid",
        "--formats",
        "f32",
    ];
    volver(&[&jump[..], &["--levels", "8..512"]].concat())
        .assert()
        .code(1)
        .stdout(contains("Oscillatory where theory says 1\n"));
}

#[test]
fn csv_goes_to_standard_output_alone() {
    volver(&[
        "--cases",
        "homogeneous",
        "--methods",
        "boole/trapezoid",
        "--levels",
        "8,16",
        "--csv",
        "-",
    ])
    .assert()
    .code(0)
    .stdout(starts_with("case,method,format,bits,n,state,total,"))
    .stdout(predicate::function(|text: &str| text.lines().count() == 5));
}

#[test]
fn the_schema_is_published_and_the_documented_example_keeps_to_it() {
    let mut command = cargo_bin_cmd!("volver");
    command
        .arg("schema")
        .assert()
        .code(0)
        .stdout(starts_with("study "));
    let mut command = cargo_bin_cmd!("volver");
    let output = command
        .args(["schema", "study"])
        .assert()
        .code(0)
        .get_output()
        .stdout
        .clone();
    let schema: Value = serde_json::from_slice(&output).unwrap();
    let document =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/study.md")).unwrap();
    let (_, rest) = document.split_once("```toml\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    let example: toml::Table = toml::from_str(example).unwrap();
    let properties = schema["properties"].as_object().unwrap();
    // It shows every key, each of the type that the schema has.
    assert_eq!(example.len(), properties.len());
    for (key, value) in &example {
        let property = &properties[key];
        match value {
            toml::Value::Array(list) => {
                assert_eq!(property["type"], "array", "{key}");
                assert!(
                    list.iter().all(toml::Value::is_str) && property["items"]["type"] == "string",
                    "{key}"
                );
            }
            toml::Value::String(_) => {
                assert!(
                    property["type"] == "string"
                        || property["$ref"] == "#/$defs/FileLevels"
                        || property["$ref"] == "#/$defs/Errors",
                    "{key}"
                );
            }
            other => panic!("{key} is {other:?}"),
        }
    }
}

#[test]
fn the_examples_of_the_help_run() {
    let help = volver(&["--help"])
        .assert()
        .code(0)
        .get_output()
        .stdout
        .clone();
    let help = String::from_utf8(help).unwrap();
    let (_, examples) = help.split_once("Examples:\n").unwrap();
    let mut count = 0;
    for line in examples
        .lines()
        .filter_map(|line| line.trim().strip_prefix("volver study "))
    {
        let arguments: Vec<&str> = line.split_whitespace().collect();
        volver(&arguments).assert().code(0).stderr("");
        count += 1;
    }
    assert_eq!(count, 5);
}

/// C is 0/0 at 0, so that nothing says that it has a value there.
#[test]
fn what_is_not_proved_of_a_case_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("open.toml");
    let text =
        "name = \"open\"\nlength = 1\ndepth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\"\n";
    fs::write(&file, text).unwrap();
    let run = |more: &[&str]| {
        let mut command = volver(&["--cases"]);
        command
            .arg(&file)
            .args(["--methods", "trapezoid/trapezoid"]);
        command
            .args(["--formats", "f64", "--levels", "8..64"])
            .args(more);
        String::from_utf8(command.output().unwrap().stdout).unwrap()
    };
    let text = run(&[]);
    assert!(
        text.contains("not proved: open, C defined: undecided near lambda = 0"),
        "{text}"
    );
    let document: Value = serde_json::from_str(&run(&["--json", "-"])).unwrap();
    assert_eq!(document["unproved"][0]["case"], "open");
    assert_eq!(document["unproved"][0]["claim"], "C defined");
}

/// s ln s has no bound near 0 in the complex plane: the integral is no ball, and the run says so, also where it goes on.
#[test]
fn a_radiance_that_is_an_estimate_is_named_as_one() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("open.toml");
    let text = "name = \"open\"\nlength = 1\nextinction = \"1\"\n\
        emission = \"1 + s*ln(s + piecewise(s <= 0, 1, 0))\"\n";
    fs::write(&file, text).unwrap();
    let out = directory.path().join("out");
    let run = |more: &[&str]| {
        let mut command = volver(&["--cases"]);
        command
            .arg(&file)
            .args(["--methods", "trapezoid/trapezoid", "--formats", "f32,f64"])
            .args(["--levels", "8..64", "--json", "-", "--out"])
            .arg(&out)
            .args(more);
        let text = String::from_utf8(command.output().unwrap().stdout).unwrap();
        serde_json::from_str::<Value>(&text).unwrap()
    };
    let first = run(&[]);
    let unproved = first["unproved"].as_array().unwrap();
    let estimates: Vec<&Value> = unproved.iter().filter(|o| o["claim"] == "I(D)").collect();
    assert_eq!(estimates.len(), 1, "{unproved:?}");
    let reason = estimates[0]["reason"].as_str().unwrap();
    assert!(reason.starts_with("an estimate: no bound"), "{reason}");
    let page = fs::read_to_string(out.join("study.md")).unwrap();
    assert!(page.contains("I(D): an estimate: no bound"), "{page}");
    assert_eq!(run(&["--resume"])["unproved"], first["unproved"]);
}

/// Errors as a whole: every output has them, and none has anything of their parts.
#[test]
fn a_study_of_total_errors_has_orders_and_nothing_of_parts() {
    let parent = tempfile::tempdir().unwrap();
    let (one, two) = (parent.path().join("one"), parent.path().join("two"));
    let errors = ["--errors", "total"];
    study(&one, &[&errors[..], &["--threads", "1"]].concat())
        .assert()
        .code(0)
        .stderr("")
        .stdout(contains("sine-squared, trapezoid/trapezoid: theory 2\n"))
        .stdout(contains("18 lines, total: "))
        .stdout(contains("n*").not());
    // Begun, and gone on with.
    fs::create_dir(&two).unwrap();
    let journal = fs::read_to_string(one.join("study.jsonl")).unwrap();
    let begun: Vec<&str> = journal.split_inclusive('\n').take(4).collect();
    fs::write(two.join("study.jsonl"), begun.concat()).unwrap();
    study(&two, &[&errors[..], &["--quiet", "--resume"]].concat())
        .assert()
        .code(0);
    let found = files(&one);
    assert_same(&files(&two), &found);
    let text = |name: &str| String::from_utf8(found[name].clone()).unwrap();
    let csv = text("study.csv");
    assert!(csv.starts_with("case,method,format,bits,n,state,total,floor,reason\n"));
    assert_eq!(csv.lines().count(), 1 + 2 * 3 * (3 + 4) * 6);
    for name in ["study.csv", "study.json", "study.tex", "study.jsonl"] {
        for part in ["discretization", "arithmetic", "input", "crossing", "best"] {
            assert!(!text(name).contains(part), "{part} in {name}");
        }
    }
    assert!(text("study.md").contains("need --errors split and are left out"));
    assert_eq!(
        found
            .keys()
            .filter(|name| name.starts_with("errors-"))
            .count(),
        6
    );
    let document: Value = serde_json::from_slice(&found["study.json"]).unwrap();
    assert_eq!(document["settings"]["errors"], "total");
    let first = &document["rows"][0];
    assert_eq!(first["states"]["total"], 6);
    let order = document["rows"]
        .as_array()
        .unwrap()
        .iter()
        .find(|row| row["format"] == "mpfr:70");
    let order = &order.unwrap()["total"];
    assert_eq!(order["verdict"], "Confirmed");
    assert!((order["order"].as_f64().unwrap() - 2.0).abs() < 0.02);
    // The other kind does not go on with it.
    study(&one, &["--quiet", "--resume"])
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains(
            "another study: its errors are total, not split (allowed: ",
        ))
        .stderr(predicate::function(|text: &str| text.lines().count() == 1));
}

#[test]
fn a_file_asks_for_total_errors_too_and_wrong_words_have_their_line() {
    let parent = tempfile::tempdir().unwrap();
    let file = parent.path().join("study.toml");
    let run = |errors: &str| {
        let text = format!("cases = [\"homogeneous\"]\nlevels = \"8..64\"\nerrors = {errors}\n");
        fs::write(&file, text).unwrap();
        volver(&[file.to_str().unwrap(), "--csv", "-"])
    };
    run("\"total\"")
        .assert()
        .code(0)
        .stdout(starts_with("case,method,format,bits,n,state,total,floor,"));
    run("\"all\"").assert().code(2).stdout("").stderr(contains(
        "study.toml, line 3: unknown errors 'all' (allowed: split, total)\n",
    ));
    // The option goes before it.
    let mut command = run("\"total\"");
    command.args(["--errors", "split"]);
    command
        .assert()
        .code(0)
        .stdout(contains(",discretization,"));
}

/// Errors that stay where a ray ends early are no wrong order.
#[test]
fn light_behind_the_end_of_a_ray_is_no_contradiction() {
    volver(&[
        "--cases",
        "homogeneous",
        "--errors",
        "total",
        "--formats",
        "f64",
    ])
    .args(["--methods", "front-to-back/middle/expm1/stop=1:3"])
    .args(["--levels", "8..4096"])
    .assert()
    .code(0);
}

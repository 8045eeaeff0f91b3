//! What goes to files, and what to standard output.

use super::run::{METHOD, Run, SHORT, command, fixture, junit, verify, volver};
use assert_cmd::cargo::cargo_bin;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn json_alone_is_on_standard_output() {
    let document = verify(&["--json", "-"], &[METHOD]).with_code(0).json();
    assert_eq!(document["volver"], env!("CARGO_PKG_VERSION"));
    assert_eq!(document["conclusion"], "confirmed");
    assert_eq!(document["kernel"]["name"], format!("{METHOD}@f64"));
    assert_eq!(document["kernel"]["method"], "front-to-back/middle/expm1");
    assert_eq!(
        document["ladder"],
        serde_json::json!([8, 16, 32, 64, 128, 256])
    );
    assert_eq!(document["counts"]["confirmed"], 3);
    assert_eq!(document["identification"]["named"], true);
    assert_eq!(
        document["identification"]["deviations"],
        serde_json::json!([])
    );
    let lines = document["lines"].as_array().unwrap();
    assert_eq!(lines.len(), 3);
    for line in lines {
        let order = line["order"].as_f64().unwrap();
        assert!((order - 2.0).abs() < 0.1, "{line}");
        assert_eq!(line["samples"].as_array().unwrap().len(), 6);
    }
}

#[test]
fn junit_and_a_baseline_alone_are_on_standard_output_too() {
    let run = verify(&["--junit", "-"], &[METHOD]).with_code(0);
    let found = junit(&run.out);
    assert_eq!(found["found"], serde_json::json!([4, 0, 0, 0]));
    assert_eq!(found["name"], format!("{METHOD}@f64"));
    let run = verify(&["--save", "-"], &[METHOD]).with_code(0);
    assert_eq!(run.json()["volver_baseline"], 2);
}

#[test]
fn junit_counts_what_is_in_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.xml");
    let option = ["--junit", file.to_str().unwrap()];
    let text = || fs::read_to_string(&file).unwrap();
    // Tests, failures, errors, skipped: one test a channel and one of the values.
    for (kernel, counts) in [
        (&["--sampling", "front"][..], [4, 2, 0, 0]),
        (&["--trouble", "dies", "--at", "64"], [4, 0, 3, 0]),
        (&["--trouble", "escapes", "--case", "thick"], [4, 0, 1, 0]),
        (&["--trouble", "nan"], [4, 3, 0, 0]),
        // And one more, which says that nothing is confirmed.
        (&["--declare", "{}"], [5, 1, 0, 3]),
    ] {
        fixture(&option, kernel);
        assert_eq!(
            junit(&text())["found"],
            serde_json::json!(counts),
            "{kernel:?}"
        );
    }
    fixture(
        &option,
        &["--declare", r#"{"name":"<\"a\"> & 'b' ]]> \u000b"}"#],
    )
    .with_code(2);
    let name = r#"<"a"> & 'b' ]]>"#;
    let declared = serde_json::json!({ "name": name }).to_string();
    fixture(&option, &["--declare", &declared]).with_code(1);
    assert_eq!(junit(&text())["name"], name);
}

/// The targets of the links in a Markdown document.
fn links(markdown: &str) -> BTreeSet<String> {
    let behind = markdown.split("](").skip(1);
    let target = |text: &str| text.split(')').next().unwrap().to_string();
    behind.map(target).collect()
}

fn names(directory: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(directory).unwrap();
    let name = |entry: fs::DirEntry| entry.file_name().into_string().unwrap();
    entries.map(|entry| name(entry.unwrap())).collect()
}

#[test]
fn a_directory_holds_documents_and_a_plot_a_channel() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("not/there/yet");
    let options = [
        "--quiet",
        "--ladder",
        "8..64",
        "--out",
        out.to_str().unwrap(),
    ];
    // Vacuum has no errors to draw.
    let run = volver(
        &[
            &["verify", "--cases", "rgb-transfer,vacuum"],
            &options[..],
            &[METHOD],
        ]
        .concat(),
    );
    assert_eq!(run.with_code(0).out, "");
    let plots = ["blue", "green", "red"].map(|channel| format!("rgb-transfer-{channel}.svg"));
    let documents = ["index.html", "verify.json", "verify.md", "verify.xml"].map(String::from);
    // Of the rule.
    let pictures = ["opacity.svg", "weights.svg"].map(String::from);
    let wanted: BTreeSet<String> = plots
        .iter()
        .chain(&documents)
        .chain(&pictures)
        .cloned()
        .collect();
    assert_eq!(names(&out), wanted);
    let markdown = fs::read_to_string(out.join("verify.md")).unwrap();
    assert_eq!(
        links(&markdown),
        plots.iter().chain(&pictures).cloned().collect()
    );
    assert!(markdown.contains("\n| vacuum | exact | "), "{markdown}");
    for plot in plots {
        let plot = fs::read_to_string(out.join(plot)).unwrap();
        assert!(plot.starts_with("<svg") && plot.trim_end().ends_with("</svg>"));
    }
    let json = fs::read_to_string(out.join("verify.json")).unwrap();
    let document: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(document["counts"]["confirmed"], 4);
    junit(&fs::read_to_string(out.join("verify.xml")).unwrap());
}

#[test]
fn quiet_is_silent_and_pipes_have_no_colours() {
    assert_eq!(verify(&["--quiet"], &[METHOD]).with_code(0).out, "");
    let plain = verify(&[], &[METHOD]).with_code(0).out;
    assert!(!plain.contains('\u{1b}'), "{plain}");
    let mut painted = verify(&["--color", "always"], &[METHOD]).with_code(0).out;
    assert!(painted.contains("\u{1b}[32m✓\u{1b}[0m"), "{painted}");
    for code in [0, 1, 2, 31, 32, 33] {
        painted = painted.replace(&format!("\u{1b}[{code}m"), "");
    }
    assert_eq!(painted, plain);
}

fn assert_fits(run: &Run) {
    for line in run.out.lines() {
        let columns = line.chars().count();
        assert!(columns <= 80, "{columns} columns: {line}");
    }
}

#[test]
fn everything_fits_80_columns() {
    let all = volver(&["verify", METHOD]).with_code(0);
    // The longest name. A row a channel, but for those that nothing resolves: they are named below.
    all.shows("✓ oscillating-extinction 2 ");
    let rows = all.out.lines().take_while(|line| !line.is_empty()).count() - 1;
    all.shows(&format!(" {} not resolved, ", 97 - rows));
    all.shows("* not resolved: balanced-jump, deep-rise/even, ");
    assert_fits(&all);
    let ladder: Vec<String> = (4..=33).map(|n| (8 * n).to_string()).collect();
    let thirty = ["--ladder", &ladder.join(",")];
    let options = [&["verify", "--cases", "paper"], &thirty[..], &[METHOD]].concat();
    assert_fits(&volver(&options));
    for trouble in ["hangs", "dies", "garbage", "escapes"] {
        let failed = fixture(&["--timeout", "0.3"], &["--trouble", trouble, "--at", "64"]);
        assert_fits(&failed.with_code(1));
    }
    let uneven = fixture(&["--uneven"], &[]);
    for case in ["thick", "cloud"] {
        let columns: Vec<char> = uneven.row(case).chars().collect();
        let verdict = (columns[66], columns[67].is_uppercase());
        assert_eq!(verdict, (' ', true), "{}", uneven.out);
    }
    assert_fits(&uneven);
    assert_fits(&fixture(&[], &["--unsteady"]));
    assert_fits(&fixture(&[], &["--drop-last"]));
}

/// Runs it with nobody to read its standard output.
fn unread(arguments: &[&str]) -> Run {
    let mut child = Command::new(cargo_bin!("volver"))
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    Run {
        code: output.status.code(),
        out: String::new(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

#[test]
fn a_closed_pipe_ends_silently_and_files_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.json");
    let base = folder.path().join("base.json");
    let paths = [&file, &base].map(|path| path.to_str().unwrap());
    let files = ["--json", paths[0], "--save", paths[1]];
    let closed = |arguments: &[&str]| {
        let run = unread(arguments).with_code(141);
        assert_eq!(run.err, "");
    };
    closed(&[&["verify"], &SHORT[..], &files, &[METHOD]].concat());
    let json = fs::read_to_string(&file).unwrap();
    assert_eq!(
        serde_json::from_str::<Value>(&json).unwrap()["conclusion"],
        "confirmed"
    );
    for option in ["--json", "--junit", "--save"] {
        closed(&[&["verify"], &SHORT[..], &[option, "-", METHOD]].concat());
    }
    closed(&["check", paths[1], METHOD]);
    closed(&["check", "--quiet", paths[1], METHOD]);
}

#[test]
fn places_that_cannot_be_written_are_named_before_the_kernel_starts() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let below = file.join("report");
    for option in ["--json", "--junit", "--save", "--out"] {
        let arguments = ["verify", option, below.to_str().unwrap(), "no-such-program"];
        let run = Run::of(command(&arguments)).with_code(2);
        assert!(run.err.contains("file"), "{}", run.err);
        assert!(!run.err.contains("no-such-program"), "{}", run.err);
        assert_eq!(run.out, "");
    }
}

/// C is 0/0 at 0, so that nothing says that it has a value there.
#[test]
fn what_is_not_proved_of_a_case_is_named_beside_what_leans_on_it() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("open.toml");
    let text =
        "name = \"open\"\nlength = 1\ndepth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\"\n";
    fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let run = |more: &[&str]| {
        let given = ["verify", "--cases", file, "--ladder", "8..256"];
        volver(&[&given, more].concat())
    };
    let text = run(&[METHOD]);
    text.shows("not proved: open, C defined: undecided near lambda = 0");
    let document = run(&["--json", "-", METHOD]).json();
    let unproved = &document["lines"][0]["unproved"];
    assert_eq!(unproved[0]["claim"], "C defined");
    assert_eq!(unproved[0]["reason"], "undecided near lambda = 0");
    // Nothing is said of what is proved.
    let proved = verify(&["--json", "-"], &[METHOD]).json();
    assert!(proved["lines"][0].get("unproved").is_none());
}

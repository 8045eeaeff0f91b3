//! Baselines: what has moved, and files that are none.

use super::run::{METHOD, Marked, Run, command, verify, volver};
use serde_json::{Value, json};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A baseline in a folder of its own.
struct Saved {
    folder: TempDir,
}

impl Saved {
    /// What the kernel shows on a short verification.
    fn of(kernel: &str) -> Self {
        let saved = Saved {
            folder: tempfile::tempdir().unwrap(),
        };
        let file = saved.file();
        let save = ["--quiet", "--save", file.to_str().unwrap()];
        verify(&save, &[kernel]).with_code(0);
        saved
    }

    fn file(&self) -> PathBuf {
        self.folder.path().join("base.json")
    }

    fn check(&self, kernel: &str) -> Run {
        volver(&["check", "--quiet", self.file().to_str().unwrap(), kernel])
    }

    fn value(&self) -> Value {
        serde_json::from_str(&fs::read_to_string(self.file()).unwrap()).unwrap()
    }

    /// With that text in its place.
    fn check_text(&self, text: &str) -> Run {
        let file = self.folder.path().join("edited.json");
        fs::write(&file, text).unwrap();
        volver(&["check", "--quiet", file.to_str().unwrap(), METHOD])
    }

    /// With one key set.
    fn check_with(&self, key: &str, value: Value) -> Run {
        let mut edited = self.value();
        edited[key] = value;
        self.check_text(&edited.to_string())
    }
}

#[test]
fn what_has_not_moved_is_said_to_have_not() {
    let saved = Saved::of(METHOD);
    for kernel in [
        METHOD,
        // The same in another order of operations, or by another formula.
        "method:tree/middle/expm1",
        "method:back-to-front/middle/expm1",
        "method:front-to-back/middle/subtraction",
    ] {
        let run = saved.check(kernel).with_code(0);
        assert_eq!(run.out, "nothing has moved\n", "{kernel}");
    }
    let file = saved.file();
    let table = volver(&["check", file.to_str().unwrap(), METHOD]).with_code(0);
    table.shows("confirmed: 3 confirmed, 0 contradicted");
    assert!(table.out.ends_with("nothing has moved\n"), "{}", table.out);
    let mut piped = command(&["check", "--quiet", "-", METHOD]);
    piped.write_stdin(fs::read(&file).unwrap());
    assert_eq!(Run::of(piped).with_code(0).out, "nothing has moved\n");
}

#[test]
fn what_has_moved_is_named() {
    let run = Saved::of(METHOD).check("method:front-to-back/front/expm1");
    let run = run.with_code(1);
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(
        lines[0],
        "moved: kernel: samples lie in the middle of segments → samples lie at the front of segments"
    );
    let order = |line: &str| line.split("order ").nth(1).unwrap()[..3].to_string();
    assert!(
        lines[1].starts_with("moved: sine-squared: confirmed (Confirmed, order "),
        "{}",
        run.out
    );
    let (before, now) = lines[1].split_once('→').unwrap();
    assert_eq!([order(before), order(now)], ["2.0", "1.0"]);
    assert_eq!(*lines.last().unwrap(), format!("{} moved", lines.len() - 1));
}

#[test]
fn settings_are_those_of_the_baseline() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("base.json");
    let path = file.to_str().unwrap();
    let options = ["--uneven", "--expect", "3/2", "--replicas", "17", "--save"];
    let cases = [
        "verify",
        "--quiet",
        "--cases",
        "emission-bump",
        "--ladder",
        "9,18,36,72",
    ];
    volver(&[&cases[..], &options, &[path, METHOD]].concat());
    let saved: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(saved["ladder"], json!([9, 18, 36, 72]));
    assert_eq!(saved["uneven"], true);
    assert_eq!(saved["expect"], "3/2");
    assert_eq!(saved["replicas"], 17);
    let run = volver(&["check", path, METHOD]).with_code(0);
    assert!(run.row("emission-bump").contains(" 1.5 "), "{}", run.out);
}

#[test]
fn better_alone_is_good() {
    let saved = Saved::of(METHOD);
    let mut lines = saved.value()["lines"].clone();
    lines[1]["standing"] = "inconclusive".into();
    let run = saved.check_with("lines", lines).with_code(0);
    assert!(
        run.out.starts_with("better: thick: inconclusive ("),
        "{}",
        run.out
    );
    assert!(
        run.out
            .ends_with("\n1 for the better: save the baseline anew\n"),
        "{}",
        run.out
    );
    let mut fewer = saved.value()["lines"].clone();
    let mut gone = fewer[0].clone();
    gone["name"] = "gone".into();
    fewer.as_array_mut().unwrap().push(gone);
    let run = saved.check_with("lines", fewer).with_code(1);
    assert!(
        run.out.starts_with("moved: gone: confirmed ("),
        "{}",
        run.out
    );
}

#[test]
fn a_kernel_that_cannot_run_is_no_comparison() {
    let saved = Saved::of(METHOD);
    let run = saved.check("no-such-program").with_code(2);
    assert_eq!(run.out, "");
    let file = saved.file();
    let check = ["check", "--quiet", "--timeout", "5", file.to_str().unwrap()];
    let marked = Marked::new();
    let with = |options: &[&str]| {
        let kernel = marked.kernel(options);
        let kernel: Vec<&str> = kernel.iter().map(String::as_str).collect();
        let run = volver(&[&check[..], &kernel].concat());
        marked.assert_gone();
        run
    };
    let run = with(&["--trouble", "dies"]).with_code(2);
    assert_eq!(run.out, "");
    assert!(
        run.err
            .starts_with("volver: python3: the kernel was killed by signal 11")
    );
    // One case that fails has moved.
    let run = with(&["--trouble", "dies", "--case", "thick"]).with_code(1);
    assert!(
        run.out.starts_with("moved: thick: confirmed ("),
        "{}",
        run.out
    );
    assert!(
        run.out.ends_with(" → failed (TooFewLevels)\n1 moved\n"),
        "{}",
        run.out
    );
    assert_eq!(with(&[]).with_code(0).out, "nothing has moved\n");
}

/// One line on standard error, nothing on standard output.
fn refused(run: Run, message: &str) {
    let run = run.with_code(2);
    assert_eq!(run.out, "");
    let message = format!("edited.json: {message}");
    assert!(
        run.err.contains(&message),
        "{message}\nis not in\n{}",
        run.err
    );
    assert!(run.err.contains("(allowed: "), "{}", run.err);
}

#[test]
fn damaged_files_are_refused_in_one_line() {
    let saved = Saved::of(METHOD);
    let whole = fs::read_to_string(saved.file()).unwrap();
    for text in [
        "",
        "{",
        "[]",
        "null",
        "\u{0}",
        &whole[..whole.len() / 2],
        &"[".repeat(100_000),
    ] {
        refused(saved.check_text(text), "no baseline: ");
    }
    refused(
        saved.check_text(r#"{"volver_baseline":3,"new":"key"}"#),
        "a baseline of version 3 (allowed: 1, 2)",
    );
    refused(
        saved.check_with("volver_baseline", json!("1")),
        "no baseline: invalid type: string",
    );
    refused(
        saved.check_with("a\nb", json!(1)),
        "no baseline: unknown field `a\\nb`, expected one of ",
    );
    refused(
        saved.check_with("identify", json!("x\ny")),
        "'identify': 'x\\ny' (allowed: auto, full, off)",
    );
    refused(
        saved.check_with("fingerprint", json!("x\ny")),
        "no baseline: a control character in ",
    );
}

#[test]
fn settings_that_cannot_be_are_refused_in_one_line() {
    let saved = Saved::of(METHOD);
    for (ladder, message) in [
        (json!([]), "'ladder': 0 levels are not allowed"),
        (
            json!([16, 8]),
            "'ladder': 8 segments after 16 are not allowed",
        ),
        (
            json!([8, 8]),
            "'ladder': 8 segments after 8 are not allowed",
        ),
        (json!([0, 8]), "'ladder': 0 segments are not allowed"),
        (
            json!([8, 524_289]),
            "'ladder': 524289 segments (allowed: 1 to 524288)",
        ),
        (
            json!([8, u64::MAX]),
            "'ladder': 18446744073709551615 segments are not allowed",
        ),
        (
            json!((1..=65).collect::<Vec<u64>>()),
            "'ladder': 65 levels are not allowed",
        ),
        (json!([-8]), "no baseline: invalid value: integer `-8`"),
        (json!([8.5]), "no baseline: invalid type: floating point"),
    ] {
        refused(saved.check_with("ladder", ladder), message);
    }
    for expect in ["x", "", "0", "-1", "1/0", "1e-400", "1e400", "101", "nan"] {
        refused(
            saved.check_with("expect", json!(expect)),
            "'expect': no order (allowed: ",
        );
    }
    for replicas in [0, 7, 10_001] {
        refused(
            saved.check_with("replicas", json!(replicas)),
            "'replicas': no number of seeds (",
        );
    }
    refused(
        saved.check_with("cases", json!(["nowhere"])),
        "no case 'nowhere' (",
    );
    refused(
        saved.check_with("cases", json!(["a\nb"])),
        "no case 'a\\nb' (",
    );
}

#[test]
fn channels_that_cannot_be_are_refused_in_one_line() {
    let saved = Saved::of(METHOD);
    let line = &saved.value()["lines"][0];
    let with = |key: &str, value: Value| {
        let mut line = line.clone();
        line[key] = value;
        saved.check_with("lines", json!([line]))
    };
    refused(
        with("standing", json!("good")),
        "'lines', 'sine-squared': unknown standing (allowed: confirmed, ",
    );
    refused(
        with("name", json!("a\nb")),
        "'lines', 'a\\nb': a control character ",
    );
    refused(
        with("verdict", json!("\u{1b}[31m")),
        "'lines', 'sine-squared': a control character ",
    );
    refused(
        with("half_width", json!(-1)),
        "'lines', 'sine-squared': half_width below 0 ",
    );
    refused(
        saved.check_with("lines", json!([line, line])),
        "'lines', 'sine-squared': a second time ",
    );
}

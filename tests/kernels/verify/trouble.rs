//! Kernels that misbehave: rows say what happened, the other cases go on, and nothing is left.

use super::run::{Marked, Run, fixture, in_repository, junit, volver};
use serde_json::Value;
use std::fs;

/// Short times, which only kernels that hang use up.
const HASTY: [&str; 4] = ["--timeout", "0.5", "--start-timeout", "5"];
const LAST_WORDS: &str = "; its standard error ends: loading scene | first sign | out of memory";

/// Runs it with a JSON document beside the table.
fn run(kernel: &[&str]) -> (Run, Value) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.json");
    let options = [&HASTY[..], &["--json", file.to_str().unwrap()]].concat();
    let run = fixture(&options, kernel);
    let document = fs::read_to_string(&file).unwrap();
    (run, serde_json::from_str(&document).unwrap())
}

/// Nothing of it says that it is confirmed.
fn assert_not_confirmed(run: &Run, document: &Value, conclusion: &str) {
    assert_eq!(document["conclusion"], conclusion);
    assert!(
        !run.out.lines().any(|line| line.starts_with("confirmed: ")),
        "{}",
        run.out
    );
    let last = format!("\n{conclusion}: ");
    assert!(run.out.contains(&last), "{}", run.out);
}

#[test]
fn what_never_answers_could_not_run_and_says_why() {
    for (trouble, why) in [
        ("hangs", "no answer in 0.5 s (allowed: up to --timeout)"),
        (
            "garbage",
            "no JSON object: expected value in the answer 'Traceback (most recent call last):' (allowed: see docs/protocol.md)",
        ),
        ("half-line", "half a line in the answer '{"),
        (
            "wrong-id",
            "an answer to request 2 (allowed: to 1, the one asked)",
        ),
        (
            "noise",
            "a line too long (allowed: up to 1048576 bytes) in the answer 'xxx",
        ),
        ("noise-stderr", "the kernel exited with code 5"),
        ("dies", "the kernel was killed by signal 11"),
        (
            "escapes",
            "the kernel exited with code 7; its standard error ends: [31mred ]0;title ]]> <b>&amp; | *x*",
        ),
        ("refuses", "the kernel refuses: not [31m this one"),
        ("closes-requests", "the kernel closed its request pipe"),
        ("closes-answers", "the kernel closed its answer pipe"),
    ] {
        let (run, document) = run(&["--trouble", trouble]);
        let run = run.with_code(2);
        assert_not_confirmed(&run, &document, "could not run");
        run.shows("could not run: no level of any case was answered; 0 confirmed, ");
        let first = format!("volver: python3: {why}");
        assert!(run.err.starts_with(&first), "{trouble}: {}", run.err);
        for text in [&run.out, &run.err] {
            assert!(!text.contains('\u{1b}'), "{text}");
        }
        run.shows(why);
        if ["hangs", "noise-stderr", "dies"].contains(&trouble) {
            run.shows(LAST_WORDS);
        }
        for line in document["lines"].as_array().unwrap() {
            assert_eq!(line["standing"], "failed");
            // Six levels, and two numbers of segments beside them.
            assert_eq!(line["failures"].as_array().unwrap().len(), 8);
        }
    }
}

#[test]
fn what_does_not_start_is_named_in_one_line() {
    for (trouble, why) in [
        (
            "start-exits",
            "the kernel exited with code 3; its standard error ends: loading scene | first sign | out of memory",
        ),
        (
            "start-garbage",
            "no JSON object in the answer 'hello!' (allowed: see docs/protocol.md)",
        ),
        (
            "start-hangs",
            "no greeting in 0.5 s (allowed: up to --start-timeout)",
        ),
    ] {
        let time = if trouble == "start-hangs" {
            "0.5"
        } else {
            "20"
        };
        let run = fixture(&["--start-timeout", time], &["--trouble", trouble]).with_code(2);
        assert_eq!(run.out, "");
        assert_eq!(run.err, format!("volver: python3: {why}\n"));
    }
    let script = in_repository("tests/kernels/verify/kernel.py");
    for (kernel, why) in [
        ("no-such-program", "No such file or directory"),
        (&script[..], "Permission denied"),
        ("", "does not start"),
        ("./missing.so", "./missing.so: "),
        (&script.replace(".py", ".so"), "No such file"),
    ] {
        let run = volver(&["verify", kernel]).with_code(2);
        assert_eq!(run.out, "");
        assert!(
            run.err.contains(why) && run.err.contains("(allowed: "),
            "{}",
            run.err
        );
    }
}

#[test]
fn one_level_that_kills_it_costs_that_level_alone() {
    let (run, document) = run(&["--trouble", "dies", "--at", "128"]);
    let run = run.with_code(1);
    assert_not_confirmed(&run, &document, "not confirmed");
    run.shows("not confirmed: 0 confirmed, 0 contradicted, 0 inconclusive, 0 blind, 3 failed of 3 channels");
    let why = format!("n = 128: the kernel was killed by signal 11{LAST_WORDS}");
    run.shows(&why);
    run.hides("given up");
    for (line, case) in
        document["lines"]
            .as_array()
            .unwrap()
            .iter()
            .zip(["sine-squared", "thick", "cloud"])
    {
        assert!(
            run.row(case).starts_with("! ") && run.row(case).ends_with(" failed"),
            "{}",
            run.out
        );
        assert_eq!(line["failures"].as_array().unwrap().len(), 1);
        assert_eq!(line["samples"].as_array().unwrap().len(), 5);
    }
}

#[test]
fn one_case_that_kills_it_costs_that_case_alone() {
    for trouble in ["dies", "hangs", "garbage", "half-line"] {
        for at in [&[][..], &["--at", "256"]] {
            let kernel = [&["--trouble", trouble, "--case", "thick"], at].concat();
            let (run, document) = run(&kernel);
            let run = run.with_code(1);
            assert_not_confirmed(&run, &document, "not confirmed");
            for (case, row) in [("sine-squared", "✓ "), ("thick", "! "), ("cloud", "✓ ")] {
                assert!(run.row(case).starts_with(row), "{kernel:?}\n{}", run.out);
            }
            run.shows("not confirmed: 2 confirmed, 0 contradicted, 0 inconclusive, 0 blind, 1 failed of 3 channels");
        }
    }
}

#[test]
fn a_kernel_of_random_numbers_that_one_level_kills_goes_on_with_the_next_case() {
    let declared = r#"{"method":"front-to-back/middle/subtraction","stochastic":true}"#;
    let options = [
        "--declare",
        declared,
        "--trouble",
        "dies",
        "--at",
        "128",
        "--case",
        "thick",
    ];
    let (run, document) = run(&options);
    run.with_code(1);
    let failures = |index: usize| {
        document["lines"][index]["failures"]
            .as_array()
            .unwrap()
            .len()
    };
    assert_eq!((failures(0), failures(2)), (0, 0));
    assert!(failures(1) >= 1);
}

#[test]
fn a_kernel_that_answers_nothing_is_given_up_in_the_end() {
    let (run, document) = run(&["--trouble", "garbage", "--sampling", "front"]);
    run.with_code(2);
    let given_up = |line: &Value| {
        let failures = line["failures"].as_array().unwrap();
        let is = |f: &&Value| {
            f["error"]
                .as_str()
                .unwrap()
                .starts_with("given up after 3 failures")
        };
        failures.iter().filter(is).count()
    };
    let lines = document["lines"].as_array().unwrap();
    // The coarsest level is asked twice.
    assert!(lines.iter().all(|line| given_up(line) >= 3), "{document}");
    let four = [
        "--cases",
        "vacuum,faint,tent,cloud",
        "--ladder",
        "8..64",
        "--json",
        "-",
    ];
    let marked = Marked::new();
    let kernel = marked.kernel(&["--trouble", "garbage"]);
    let kernel: Vec<&str> = kernel.iter().map(String::as_str).collect();
    let fourth = volver(&[&["verify"], &four[..], &kernel].concat()).with_code(2);
    // Four levels, and one number of segments beside them.
    assert_eq!(given_up(&fourth.json()["lines"][3]), 5);
}

#[test]
fn what_is_not_finite_contradicts() {
    let (run, document) = run(&["--trouble", "nan"]);
    assert_not_confirmed(&run.with_code(1), &document, "not confirmed");
    let (run, document) = self::run(&["--trouble", "nan", "--at", "64", "--case", "thick"]);
    let run = run.with_code(1);
    assert!(run.row("thick").ends_with("NotFinite"), "{}", run.out);
    assert!(run.row("cloud").ends_with("Confirmed"), "{}", run.out);
    assert_not_confirmed(&run, &document, "not confirmed");
}

#[test]
fn an_answer_nobody_asked_for_costs_no_other_case() {
    let (run, document) = run(&["--trouble", "twice", "--at", "64"]);
    let run = run.with_code(1);
    assert_not_confirmed(&run, &document, "not confirmed");
    run.shows("(allowed: to ");
}

#[test]
fn what_it_prints_does_no_harm() {
    let (run, document) = run(&["--trouble", "prints"]);
    let run = run.with_code(0);
    assert_eq!(document["conclusion"], "confirmed");
    run.hides("\"radiance\"");
}

#[test]
fn what_it_says_stays_text_in_every_report() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    fixture(&["--out", out], &["--trouble", "escapes", "--at", "64"]).with_code(1);
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let said = "[31mred ]0;title ]]> <b>&amp; | *x*";
    let found = junit(&read("verify.xml"));
    assert!(
        found["says"]["thick"].as_str().unwrap().ends_with(said),
        "{found}"
    );
    let markdown = read("verify.md");
    assert!(
        markdown.contains(r"\[31mred \]0;title \]\]\> \<b\>\&amp; \| \*x\*"),
        "{markdown}"
    );
    assert!(!markdown.contains('\u{1b}'));
}

#[test]
fn what_it_claims_to_have_used_is_believed_where_it_can_be() {
    for (claim, words) in [
        (
            r#"{"segments":1048577}"#,
            "a number of segments of 1048577 really used (allowed: ",
        ),
        (
            r#"{"step":1e-9}"#,
            "a step of 0.000000001 really used (allowed: ",
        ),
        (r#"{"step":1e-300}"#, " really used (allowed: "),
    ] {
        let (run, document) = run(&["--claim", claim, "--case", "thick"]);
        let run = run.with_code(1);
        assert_not_confirmed(&run, &document, "not confirmed");
        run.shows(words);
        for (case, row) in [("sine-squared", "✓ "), ("thick", "! "), ("cloud", "✓ ")] {
            assert!(run.row(case).starts_with(row), "{claim}\n{}", run.out);
        }
    }
    // The same number at every level: nothing was refined.
    let (run, _) = run(&["--claim", r#"{"segments":32}"#, "--case", "thick"]);
    assert!(run.row("thick").ends_with("TooFewLevels"), "{}", run.out);
}

//! Kernels that are what they say, and kernels that are not.

use super::run::{Run, fixture, in_repository, junit, verify, volver};
use serde_json::{Value, json};
use std::fs;
use std::process::Command;

const MIDDLE: &str =
    "αⱼ = 1 − exp(−τⱼ dⱼ) samples in the middle of segments It holds on rays that are";

/// Good, with that rule, and nothing else answered.
fn assert_confirmed(run: Run, rule: &str) {
    assert_confirmed_beside(run, rule, "");
}

/// Good, with that rule, and what is said of other answers.
fn assert_confirmed_beside(run: Run, rule: &str, others: &str) {
    let run = run.with_code(0);
    run.shows(rule);
    run.shows("On the ladder it agrees in 3 of 3 channels.");
    assert_eq!(
        run.out[run.out.rfind("confirmed: ").unwrap()..]
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" "),
        format!(
            "confirmed: 3 confirmed, 0 contradicted, 0 inconclusive, 0 blind of 3 channels{others}"
        )
    );
    run.hides("wrong:");
    run.hides("How it deviates");
    run.hides("that is not what it declares");
    for case in ["sine-squared", "thick", "cloud"] {
        assert!(run.row(case).starts_with("✓ "), "{}", run.out);
    }
}

#[test]
fn methods_of_volver_are_what_they_say() {
    for format in ["", "@f32", "@mpfr:100"] {
        let kernel = format!("method:front-to-back/middle/expm1{format}");
        assert_confirmed(verify(&[], &[&kernel]), MIDDLE);
    }
    assert_confirmed(
        verify(&[], &["method:trapezoid/trapezoid"]),
        "Lⱼ = dⱼ (1/2 τ_f C_f + 1/2 τ_b C_b exp(−xⱼ))",
    );
}

#[test]
fn a_seed_behind_an_at_is_no_format() {
    for (kernel, format) in [
        ("method:monte-carlo@7/trapezoid", "f64"),
        ("method:monte-carlo@7/trapezoid@f32", "f32"),
    ] {
        let options = ["--replicas", "8", "--ladder", "8..64", "--json", "-"];
        let cases = ["verify", "--cases", "sine-squared"];
        let run = volver(&[&cases[..], &options, &[kernel]].concat());
        assert_eq!(run.err, "", "{kernel}");
        let declared = &run.json()["kernel"];
        assert_eq!(declared["method"], "monte-carlo@7/trapezoid");
        assert_eq!(declared["format"], format);
    }
}

#[test]
fn nerf_is_what_it_says_from_python() {
    let script = in_repository("examples/kernels/nerf.py");
    let middle = ["python3", &script, "--sampling", "middle"];
    assert_confirmed(verify(&[], &middle), MIDDLE);
    let front = verify(&[], &["python3", &script]).with_code(0);
    front.shows("αⱼ = 1 − exp(−τⱼ dⱼ) samples at the front of segments It holds on rays");
    assert!(front.row("cloud").starts_with("· "), "{}", front.out);
    front.shows("blind: the case hides the leading error of what was declared");
}

#[test]
fn the_example_in_c_is_what_it_says_as_a_library_and_as_a_program() {
    let folder = tempfile::tempdir().unwrap();
    let source = in_repository("examples/kernels/front_to_back.c");
    for (file, options) in [
        ("kernel.so", &["-shared", "-fPIC"][..]),
        ("kernel", &["-DVOLVER_PROCESS"]),
    ] {
        let path = folder.path().join(file);
        let compiler = Command::new("cc")
            .args(["-std=c99", "-O2", "-I", &in_repository("include")])
            .args(options)
            .arg(&source)
            .arg("-o")
            .arg(&path)
            .arg("-lm")
            .status();
        let Ok(status) = compiler else {
            eprintln!("skipped: there is no compiler cc on the PATH");
            return;
        };
        assert!(status.success());
        let run = verify(&[], &[path.to_str().unwrap()]);
        // Where a cloud fades out its opacity has a higher order.
        let others = "; opacity 2 confirmed, 0 contradicted of 3 cases";
        assert_confirmed_beside(run, MIDDLE, others);
    }
}

#[test]
fn what_stands_behind_a_program_is_the_programs() {
    // The fixture has no option --quiet and ends with code 2, the usage on its standard error.
    let run = fixture(&[], &["--quiet"]).with_code(2);
    assert!(
        run.err.contains("unrecognized arguments: --quiet"),
        "{}",
        run.err
    );
}

/// A report of every kind says each of `words`, and that nothing is confirmed.
fn assert_named(kernel: &[&str], words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    let run = fixture(&["--out", out.to_str().unwrap()], kernel).with_code(1);
    assert!(run.out.contains("\nnot confirmed: "), "{}", run.out);
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    let document: Value = serde_json::from_str(&read("verify.json")).unwrap();
    assert_eq!(document["conclusion"], "not confirmed");
    let json = document.to_string();
    // Signs that are Markdown's stand behind a backslash.
    let markdown = read("verify.md").replace('\\', "");
    assert!(markdown.contains("**not confirmed: "), "{markdown}");
    let found = junit(&read("verify.xml"));
    assert!(found["found"][1].as_u64().unwrap() > 0, "{found}");
    for words in words {
        run.shows(words);
        for text in [&json, &markdown, &found["says"].to_string()] {
            assert!(text.contains(words), "{words}\nis not in\n{text}");
        }
    }
}

#[test]
fn samples_at_the_front_declared_as_middles_are_named_everywhere() {
    let words =
        "samples lie at the front of segments, in place of: samples lie in the middle of segments";
    assert_named(
        &["--sampling", "front"],
        &["samples lie at the front of segments"],
    );
    let run = fixture(&["--json", "-"], &["--sampling", "front"]).with_code(1);
    let document = run.json();
    assert_eq!(document["as_declared"], json!({"agree": 0, "of": 3}));
    let found = &document["identification"];
    assert_eq!(
        found["channels"],
        json!({"compared": 3, "agree": 3, "differ": []})
    );
    assert_eq!(found["deviations"][0]["name"], "place");
    fixture(&[], &["--sampling", "front"]).shows(words);
    // What is accepted by name has still another order.
    let run = fixture(&["--accept", "place"], &["--sampling", "front"]).with_code(1);
    run.shows("this is accepted");
}

#[test]
fn a_last_sample_that_is_dropped_is_named_everywhere() {
    assert_named(&["--drop-last"], &["last-sample"]);
}

#[test]
fn answers_that_differ_from_run_to_run_are_named_everywhere() {
    let words = "answers differ from run to run, and the kernel is said to be deterministic";
    assert_named(&["--unsteady"], &[words]);
}

/// Rays without absorption, over the wire: a line of their own in JSON, in `JUnit` and in a baseline.
#[test]
fn a_projector_is_asked_rays_that_do_not_absorb() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (json_file, junit_file, base) = (at("all.json"), at("all.xml"), at("base.json"));
    let script = in_repository("examples/kernels/emission.py");
    let kernel = ["python3", script.as_str()];
    let files = [
        "--json",
        &json_file,
        "--junit",
        &junit_file,
        "--save",
        &base,
    ];
    let run = verify(&files, &kernel).with_code(0);
    run.shows("emission 2 confirmed, 0 contradicted");
    run.shows(MIDDLE);
    let all: Value = serde_json::from_str(&fs::read_to_string(&json_file).unwrap()).unwrap();
    assert_eq!(all["kernel"]["source"], "length");
    let lines = all["lines"].as_array().unwrap();
    let of = lines.iter().filter(|line| line["quantity"] == "emission");
    assert_eq!(of.count(), 3);
    let name = "sine-squared:emission";
    let xml = fs::read_to_string(&junit_file).unwrap();
    assert!(
        xml.contains(&format!("name=\"{name}\"></testcase>")),
        "{xml}"
    );
    assert!(fs::read_to_string(&base).unwrap().contains(name));
    volver(&[&["check", &base][..], &kernel].concat()).with_code(0);
    // What has no value there is not answered there, and radiances are.
    let divided = [&kernel[..], &["--by-division"]].concat();
    let options = ["--identify", "off", "--json", "-"];
    let all = verify(&options, &divided).with_code(1).json();
    for line in all["lines"].as_array().unwrap() {
        let failed = line["standing"] == "failed";
        assert_eq!(failed, line["quantity"] == "emission", "{line}");
    }
}

#[test]
fn all_that_an_example_answers_is_measured() {
    let script = in_repository("examples/kernels/depths.py");
    let kernel = ["python3", script.as_str()];
    let run = verify(&["--identify", "off"], &kernel).with_code(0);
    // On so short a ladder the mean depth of the cloud is not told, and that of the thick slab is down to rounding.
    run.shows("opacity 2 confirmed, 0 contradicted");
    run.shows("expected depth 1 confirmed, 0 contradicted of 3 cases");
    // Rows are those of the radiance.
    run.hides("sine-squared:opacity");
    let divided = [&kernel[..], &["--by-opacity"]].concat();
    verify(&["--identify", "off"], &divided).with_code(0);
    let behind = [&kernel[..], &["--background"]].concat();
    verify(&[], &behind).with_code(0).shows(MIDDLE);
    // A case's own background, in place of volver's: clear air before a surface of 1/4, and what glows a little.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("air.toml");
    let air = "name = 'air'\nlength = 2\ndepth = 'lambda^2/8'\nemission_of_depth = '1/10'\nbackground = '1/4'\n";
    fs::write(&file, air).unwrap();
    let options = [
        "verify",
        "--identify",
        "off",
        "--json",
        "-",
        "--cases",
        file.to_str().unwrap(),
    ];
    let radiance = |more: &[&str]| {
        let run = volver(&[&options[..], &kernel, more].concat()).with_code(0);
        run.json()["lines"][0]["exact"].as_f64().unwrap()
    };
    let passes = (-0.5_f64).exp();
    assert!((radiance(&["--background"]) - (0.1 * (1.0 - passes) + 0.25 * passes)).abs() < 1e-15);
    assert!((radiance(&[]) - 0.1 * (1.0 - passes)).abs() < 1e-15);
    let depth = [&kernel[..], &["--only", "optical_depth"]].concat();
    let run = verify(&[], &depth).with_code(0);
    assert!(
        run.row("sine-squared").ends_with("Confirmed"),
        "{}",
        run.out
    );
    run.hides("What it computes");
    run.shows("confirmed: optical depth 2 confirmed, 0 contradicted");
}

#[test]
fn an_opacity_that_is_none_fails_in_either_version() {
    let wrong = r#"{"opacity":12345}"#;
    let run = fixture(&["--identify", "off"], &["--claim", wrong]).with_code(1);
    run.shows("wrong: an opacity of 12345 (allowed: 0 to 1)");
    assert!(run.row("cloud:opacity").starts_with("✗ "), "{}", run.out);
    assert!(run.row("cloud").starts_with("✓ "), "{}", run.out);
    let second = r#"{"protocol":2,"answers":["radiance","opacity"],"order":2}"#;
    let options = ["--declare", second, "--claim", wrong];
    fixture(&["--identify", "off"], &options).with_code(1);
    let nan = ["--declare", second, "--claim", r#"{"opacity":"nan"}"#];
    let run = fixture(&["--identify", "off"], &nan).with_code(1);
    assert!(
        run.row("cloud:opacity").ends_with("NotFinite"),
        "{}",
        run.out
    );
}

#[test]
fn quantities_stand_in_json_junit_and_baseline() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (json_file, junit_file, base) = (at("all.json"), at("all.xml"), at("base.json"));
    let script = in_repository("examples/kernels/depths.py");
    let files = [
        "--json",
        &json_file,
        "--junit",
        &junit_file,
        "--save",
        &base,
    ];
    let options = [&files[..], &["--identify", "off"]].concat();
    verify(&options, &["python3", &script]).with_code(0);
    let all: Value = serde_json::from_str(&fs::read_to_string(&json_file).unwrap()).unwrap();
    let answers = ["radiance", "opacity", "optical_depth", "expected_depth"];
    assert_eq!(all["kernel"]["answers"], json!(answers));
    assert_eq!(all["kernel"]["expected_depth"], "plain");
    let lines = all["lines"].as_array().unwrap();
    for quantity in answers {
        let of = lines.iter().filter(|line| line["quantity"] == quantity);
        assert_eq!(of.count(), 3, "{quantity}");
    }
    assert_eq!(all["answers"][1]["quantity"], "optical_depth");
    assert_eq!(all["answers"][1]["shown"], true);
    let xml = fs::read_to_string(&junit_file).unwrap();
    assert!(
        xml.contains("name=\"sine-squared:expected_depth\"></testcase>"),
        "{xml}"
    );
    assert!(xml.contains("tests=\"13\""), "{xml}");
    // A baseline from before opacities were measured has not moved; what contradicts is told.
    let mut kept: Value = serde_json::from_str(&fs::read_to_string(&base).unwrap()).unwrap();
    let lines = kept["lines"].as_array_mut().unwrap();
    lines.retain(|line| !line["name"].as_str().unwrap().contains(':'));
    let older = at("older.json");
    fs::write(&older, kept.to_string()).unwrap();
    let check_older = |kernel: &[&str]| {
        let command = ["check", "--quiet", &older];
        volver(&[&command[..], kernel].concat()).with_code(0)
    };
    assert_eq!(
        check_older(&["python3", &script]).out,
        "nothing has moved\n"
    );
    let fixture = in_repository("tests/kernels/verify/kernel.py");
    let wrong = ["python3", "-S", &fixture, "--claim", r#"{"opacity":0.5}"#];
    let run = check_older(&wrong);
    run.shows(
        "found: cloud:opacity: contradicted (the baseline has no such quantity: save it anew)",
    );
    run.shows("nothing has moved");
    // Another depth than was kept has moved, and nothing else.
    let check = |more: &[&str]| {
        let kernel = [&["check", "--quiet", &base, "python3", &script], more].concat();
        volver(&kernel)
    };
    assert_eq!(check(&[]).with_code(0).out, "nothing has moved\n");
    let moved = check(&["--only", "radiance", "--only", "opacity"]).with_code(1);
    moved.shows("moved: sine-squared:expected_depth: confirmed");
    moved.shows("→ not there");
    moved.hides("moved: sine-squared:opacity");
}

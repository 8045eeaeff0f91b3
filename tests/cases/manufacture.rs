//! `volver manufacture`, driven for real.

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use std::fs;

const FOG: &str = "name = \"fog\"\nlength = 2\ndepth = \"lambda^2\"\nemission_of_depth = \"t\"\n";

fn manufacture(arguments: &[&str], input: &str) -> Assert {
    let mut command = cargo_bin_cmd!("volver");
    command.arg("manufacture").args(arguments);
    command.write_stdin(input.to_string()).assert()
}

fn text(arguments: &[&str], input: &str) -> String {
    let output = manufacture(arguments, input).code(0).stderr("");
    String::from_utf8(output.get_output().stdout.clone()).unwrap()
}

#[test]
fn a_case_is_derived_from_standard_input_and_files_alike() {
    let derived = text(&["-"], FOG);
    assert!(derived.starts_with("fog\nD          2\n"), "{derived}");
    assert!(derived.contains("\ntau(s)     2*s\n"), "{derived}");
    assert!(derived.contains("\nC(s)       s^2\n"), "{derived}");
    assert!(!derived.contains("derivation"));
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fog.toml");
    fs::write(&path, FOG).unwrap();
    assert_eq!(text(&[path.to_str().unwrap()], ""), derived);
}

#[test]
fn what_is_wrong_with_a_file_is_shown_in_place() {
    let bad = FOG.replace("lambda^2", "2*x");
    manufacture(&["-"], &bad).code(2).stdout("").stderr(
        "volver: -: line 3, column 12: symbol 'x' in 'depth' (allowed: lambda)\n\
         depth = \"2*x\"\n           ^\n",
    );
    let bad = FOG.replace("length = 2", "length = 0");
    manufacture(&["-"], &bad).code(2).stdout("").stderr(
        "volver: -: line 2, column 10: a length of '0' (allowed: above 0)\nlength = 0\n         ^\n",
    );
    let long = "#".repeat(2_000_000);
    manufacture(&["-"], &long).code(2).stderr(contains(
        "-: more than 1048576 bytes (allowed: at most 1048576 bytes)",
    ));
    let binary = cargo_bin_cmd!("volver")
        .args(["manufacture", "-"])
        .write_stdin(vec![0xff, 0xfe])
        .assert();
    binary.code(2).stderr(contains("not UTF-8"));
}

#[test]
fn a_refuted_statement_is_a_failed_check() {
    let wrong = "name = \"wrong\"\nlength = 1\ndepth = \"1 + lambda\"\nradiance = \"lambda\"\n";
    manufacture(&["-"], wrong)
        .code(1)
        .stdout("")
        .stderr(
            "volver: -: verification failed: t(0) = 0 fails at lambda = 0, where the value or the difference of both sides is 1.00000 (allowed: a depth that begins at 0)\n",
        );
    // Nothing is refuted where nothing can be derived: that is wrong input.
    let nothing = "name = \"nothing\"\nlength = 1\ndepth = \"0\"\nradiance = \"0\"\n";
    manufacture(&["-"], nothing)
        .code(2)
        .stderr(contains("the extinction is 0 from lambda = 0 on"));
}

#[test]
fn negative_emission_is_a_warning() {
    let dark = "name = \"dark\"\nlength = 1\ndepth = \"lambda\"\nradiance = \"-lambda\"\n";
    let text = text(&["-"], dark);
    let warning = "\n! warning: C >= 0 fails at lambda = 0: an analytic case may, a kernel test will\n  refuse it\n";
    assert!(text.contains(warning), "{text}");
    let json = json(&["-"], dark);
    assert_eq!(json["proved"], true);
    assert_eq!(json["suits_kernels"], false);
    let checks = json["checks"].as_array().unwrap();
    let refuted = checks.iter().find(|check| check["outcome"] == "refuted");
    assert_eq!(refuted.unwrap()["claim"], "C >= 0");
    assert_eq!(refuted.unwrap()["at"], "0");
    assert_eq!(refuted.unwrap()["value"][0], "-1.0000000000000000");
}

fn json(arguments: &[&str], input: &str) -> Value {
    let text = text(&[arguments, &["--json", "-"]].concat(), input);
    let mut document: Value = serde_json::from_str(&text).unwrap();
    document["cases"][0].take()
}

/// C is 0/0 at 0, so that nothing says that it is smooth there.
#[test]
fn what_is_not_proved_stands_beside_the_value() {
    let open =
        "name = \"open\"\nlength = 1\ndepth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\"\n";
    let case = json(&["-"], open);
    let orders = case["orders"].as_array().unwrap();
    assert!(orders.iter().all(|order| order["theorem"].is_null()));
    let smooth = json(&["sine-squared"], "");
    let orders = smooth["orders"].as_array().unwrap();
    assert!(orders.iter().any(|order| order["theorem"].is_string()));
    let reference = |arguments: &[&str]| {
        let mut command = cargo_bin_cmd!("volver");
        command.arg("reference").args(arguments).write_stdin(open);
        let output = command.assert().code(0).stderr("");
        String::from_utf8(output.get_output().stdout.clone()).unwrap()
    };
    let text = reference(&["-"]);
    assert!(
        text.contains("not proved  C defined: undecided near lambda = 0\n"),
        "{text}"
    );
    let document: Value = serde_json::from_str(&reference(&["-", "--json"])).unwrap();
    let unproved = &document["references"][0]["unproved"];
    assert_eq!(unproved[1]["claim"], "C >= 0");
    assert_eq!(unproved[1]["reason"], "undecided near lambda = 0");
}

#[test]
fn latex_has_every_formula() {
    let latex = text(&["sine-squared", "--latex"], "");
    assert!(
        latex.contains("\\begin{align*}\n  D &= 1 \\\\\n"),
        "{latex}"
    );
    assert!(latex.contains("t(\\lambda) &= \\frac{\\sin\\left(\\lambda^{2}\\right)}{2}"));
    assert!(latex.ends_with("\n\\end{align*}\n"));
    let channels = text(&["rgb-transfer", "--latex"], "");
    assert!(channels.contains("\n  C_{\\text{green}}(s) &= "));
    assert_eq!(channels.matches("&=").count(), 10);
}

#[test]
fn code_has_length_and_functions() {
    for (language, parts) in [
        ("c", ["LENGTH", "double radiance(double lambda)"]),
        ("rust", ["LENGTH: f64", "fn emission(s: f64)"]),
        (
            "python",
            ["LENGTH = 1.0", "def optical_depth(lambda_: float)"],
        ),
    ] {
        let code = text(&["sine-squared", "--code", language], "");
        for part in parts {
            assert!(code.contains(part), "{part}: {code}");
        }
    }
    let code = text(&["rgb-transfer", "--code", "python"], "");
    for name in ["emission_red", "radiance_green", "field", "extinction"] {
        assert_eq!(code.matches(&format!("def {name}(")).count(), 1, "{name}");
    }
    // A chosen channel is a case by itself.
    let code = text(&["rgb-transfer/red", "--code", "python"], "");
    assert!(code.contains("def radiance("));
}

#[test]
fn generated_python_computes_the_radiance() {
    let code = text(&["sine-squared", "--code", "python"], "");
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("medium.py"), code).unwrap();
    let check = "import math, medium\n\
        exact = 2 - (math.sin(1) + 2)*math.exp(-math.sin(1)/2)\n\
        assert abs(medium.radiance(1.0) - exact) < 1e-15\n\
        assert abs(medium.extinction(1.0) - math.cos(1)) < 1e-15\n\
        assert medium.LENGTH == 1.0\n";
    Command::new("python3")
        .args(["-c", check])
        .current_dir(directory.path())
        .assert()
        .code(0)
        .stderr("");
}

#[test]
fn files_are_written_beside_the_text() {
    let directory = tempfile::tempdir().unwrap();
    let (figure, document) = (
        directory.path().join("fog.svg"),
        directory.path().join("fog.json"),
    );
    let shown = text(
        &[
            "-",
            "--plot",
            figure.to_str().unwrap(),
            "--json",
            document.to_str().unwrap(),
        ],
        FOG,
    );
    assert_eq!(shown, text(&["-"], FOG));
    assert!(
        fs::read_to_string(figure)
            .unwrap()
            .contains("<title>fog</title>")
    );
    let document: Value = serde_json::from_str(&fs::read_to_string(document).unwrap()).unwrap();
    assert_eq!(document["cases"][0]["formulas"]["extinction"], "2*s");
    manufacture(&["-", "--json", "/no/such/place.json"], FOG)
        .code(2)
        .stdout("")
        .stderr(contains("/no/such/place.json").and(contains("allowed")));
}

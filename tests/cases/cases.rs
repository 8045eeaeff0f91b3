//! `volver cases`, driven for real.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use predicates::str::{contains, starts_with};
use serde_json::Value;
use std::fs;
use volver::case::catalogue;

fn cases(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.arg("cases").args(arguments);
    command
}

fn text(arguments: &[&str]) -> String {
    let output = cases(arguments).assert().code(0).stderr("");
    String::from_utf8(output.get_output().stdout.clone()).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let text = text(&[arguments, &["--json", "-"]].concat());
    serde_json::from_str(&text).unwrap()
}

fn names(document: &Value) -> Vec<&str> {
    let cases = document["cases"].as_array().unwrap();
    let names = cases.iter().map(|case| case["name"].as_str().unwrap());
    names.collect()
}

#[test]
fn the_list_has_every_case_in_lines_that_fit() {
    let text = text(&[]);
    let lines = || text.lines().filter_map(|line| line.strip_prefix("  "));
    let first: Vec<&str> = lines()
        .filter_map(|line| line.split([' ', '/']).next())
        .collect();
    for name in catalogue::names() {
        assert!(first.contains(&name), "{name}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let paper = lines().find(|line| line.starts_with("sine-squared "));
    let paper: Vec<&str> = paper.unwrap().split_whitespace().collect();
    assert_eq!(paper[1..4], ["1", "0.420735", "0.134393"]);
    assert!(text.contains("\n62 cases, 97 channels; "));
}

#[test]
fn tags_filter_and_all_have_to_fit() {
    let one = json(&["--tag", "jump"]);
    let both = json(&["--tag", "jump", "--tag", "off-node"]);
    assert!(names(&one).contains(&"jump-moving") && names(&one).contains(&"jump-off-node"));
    assert!(!names(&both).contains(&"jump-moving") && names(&both).contains(&"jump-off-node"));
    cases(&["--tag", "vacuum", "--tag", "paper"])
        .assert()
        .code(0)
        .stdout("no case has all of these tags: vacuum, paper\n");
    cases(&["--tag", "jumps"])
        .assert()
        .code(2)
        .stdout("")
        .stderr(starts_with(
            "volver: no case has the tag 'jumps' (allowed: absorption-only, ",
        ))
        .stderr(contains(", jump, "));
}

#[test]
fn a_case_is_shown_in_full() {
    let text = text(&["sine-squared"]);
    for part in [
        "sine-squared: The medium of the paper's Table 1\n",
        "\ntau(s)     cos(s^2)*s\n",
        "\nC(s)       sin(s^2)\n",
        "\nI(D)       0.134393\n",
        "\nchecks\n",
        "\n  t(0) = 0            proved\n",
        "\norders\n",
        "\n  simpson/simpson             4      nested_simpson_fourth_order\n",
        "\nderivation\n  Field s = lambda, ",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    // Where the field is lambda there is nothing new along the ray.
    assert!(!text.contains("tau(lambda)"));
}

#[test]
fn notes_and_breaks_are_said() {
    for (name, part) in [
        ("vacuum", "C tau is 0: the radiance is 0, by every method"),
        (
            "homogeneous",
            "degenerate for pre-integration: C tau is constant",
        ),
        ("cloud", "tau is a polynomial of degree "),
        (
            "jump-off-node",
            "break      lambda = 1/3: tau jumps, C tau jumps\n",
        ),
        (
            "jump-moving",
            "break      lambda near 0.577350: tau jumps, C tau jumps\n",
        ),
        ("kink-on-node", "tau has a kink"),
    ] {
        cases(&[name]).assert().code(0).stdout(contains(part));
    }
}

#[test]
fn channels_are_shown_together_or_alone() {
    let all = text(&["rgb-transfer"]);
    for channel in ["red", "green", "blue"] {
        assert!(all.contains(&format!("\nchannel {channel}\n")));
    }
    assert!(all.contains("\ntau(lambda)  1 + 4*lambda*(1 - lambda)\n"));
    let one = text(&["rgb-transfer/green"]);
    assert!(one.starts_with("rgb-transfer/green: "));
    assert!(!one.contains("channel "));
    assert_eq!(
        names(&json(&["rgb-transfer/green"])),
        ["rgb-transfer/green"]
    );
    cases(&["rgb-transfer/grey"]).assert().code(2).stderr(
        "volver: no channel 'grey' in rgb-transfer (allowed: rgb-transfer/red, rgb-transfer/green, rgb-transfer/blue)\n",
    );
}

#[test]
fn names_that_are_none_bring_up_the_nearest() {
    cases(&["sine-sqared"]).assert().code(2).stdout("").stderr(
        "volver: no case 'sine-sqared' (nearest: sine-squared; allowed: see volver cases, or a path with / or ending in .toml)\n",
    );
    let far = "x".repeat(1000);
    for (name, near) in [
        // A letter too few; a part, the nearest first.
        ("thik", "nearest: thick; "),
        ("back", "nearest: thick-back, emission-back; "),
        // A third of the letters may be wrong, missing or too many, and no more.
        ("kimkk-movin", "nearest: kink-moving; "),
        ("kimkk-mowin", ""),
        ("zzzzzz", ""),
        (&far, ""),
    ] {
        cases(&[name]).assert().code(2).stderr(starts_with(format!(
            "volver: no case '{name}' ({near}allowed: "
        )));
    }
    cases(&["a\nb"])
        .assert()
        .code(2)
        .stderr(starts_with("volver: no case 'a\\nb' (allowed: "));
    for path in ["./no-such", "no-such.toml"] {
        cases(&[path])
            .assert()
            .code(2)
            .stderr(starts_with(format!("volver: {path}: ")));
    }
}

#[test]
fn a_file_is_a_case_too() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("sine-squared.toml");
    fs::write(&path, catalogue::text("sine-squared").unwrap()).unwrap();
    assert_eq!(text(&[path.to_str().unwrap()]), text(&["sine-squared"]));
}

#[test]
fn what_a_file_says_does_not_steer_the_terminal() {
    let file = "name = \"a\"\nlength = 1\ndepth = \"lambda\"\nradiance = \"0\"\nderivation = \"x\\u001b[31my\"";
    cases(&["-"])
        .write_stdin(file)
        .assert()
        .code(0)
        .stdout(contains("\nderivation\n  x [31my\n"));
}

#[test]
fn json_has_exact_numbers_and_what_is_proved() {
    let document = json(&["sine-squared"]);
    assert_eq!(document["volver"], env!("CARGO_PKG_VERSION"));
    let case = &document["cases"][0];
    assert_eq!(case["channel"], Value::Null);
    assert_eq!(case["length"], "1");
    assert_eq!(case["formulas"]["emission"], "sin(s^2)");
    assert_eq!(case["proved"], true);
    assert_eq!(case["suits_kernels"], true);
    assert_eq!(case["degenerate"], false);
    assert_eq!(case["breaks"].as_array().unwrap().len(), 0);
    let radiance = case["radiance"].as_f64().unwrap();
    assert!((radiance - 0.134_393_170_210_156_48).abs() < 1e-16);
    let checks = case["checks"].as_array().unwrap();
    assert!(checks.iter().all(|check| check["outcome"] == "proved"));
    assert_eq!(
        json(&["jump-off-node"])["cases"][0]["breaks"][0]["part"],
        "1/3"
    );
}

#[test]
fn a_figure_has_title_panels_and_channels() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("case.svg");
    let plot = |name: &str| {
        cases(&[name, "--plot", path.to_str().unwrap()])
            .assert()
            .code(0)
            .stderr("");
        fs::read_to_string(&path).unwrap()
    };
    let figure = plot("rgb-transfer");
    assert!(figure.starts_with("<svg ") && figure.ends_with("</svg>\n"));
    assert_eq!(figure.matches('<').count(), figure.matches('>').count());
    for label in [
        "<title>Colour transfer functions",
        "field s",
        "emission C",
        "extinction τ",
        "transmittance T = exp(−t)",
        "radiance I of the ray up to λ",
        "λ along the ray",
        "red",
        "green",
        "blue",
    ] {
        assert!(figure.contains(label), "{label}");
    }
    assert!(plot("thick-back").contains("transmittance T = exp(−t), logarithmic"));
    // The same case gives the same bytes.
    assert_eq!(plot("rgb-transfer"), figure);
    let missing = directory.path().join("no/case.svg");
    cases(&["vacuum", "--plot", missing.to_str().unwrap()])
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("cannot write").and(contains("no/case.svg")));
}

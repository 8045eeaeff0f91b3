//! `volver plan` and `volver render` on the command line: what they print and write, and what they refuse.

use assert_cmd::Command;
use predicates::prelude::*;
use predicates::str::contains;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn volver() -> Command {
    Command::cargo_bin("volver").unwrap()
}

const SMOKE: &str = "examples/scenes/smoke.toml";

/// One line on standard error, nothing on standard output, exit code 2.
fn refused(arguments: &[&str], said: &str) {
    let line = contains(said).and(contains("(allowed: "));
    volver()
        .args(arguments)
        .assert()
        .code(2)
        .stdout("")
        .stderr(line.and(predicate::function(|text: &str| text.lines().count() == 1)));
}

#[test]
fn a_plan_is_bounded_run_and_compared() {
    let run = volver()
        .args(["plan", SMOKE, "--tolerance", "1e-4", "--explain"])
        .assert()
        .success();
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    assert!(text.contains("smoke: tolerance 1e-4"), "{text}");
    assert!(
        text.contains("\n    what lies between the points\n"),
        "{text}"
    );
    assert!(text.contains("<= 0.0001"), "{text}");
    for channel in ["red", "green", "blue"] {
        let line = text
            .lines()
            .find(|line| line.starts_with(&format!("* {channel}: within the tolerance")));
        assert!(line.is_some(), "{text}");
    }
    assert_eq!(text.matches("within the tolerance").count(), 3, "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn a_stored_plan_renders_the_same_without_planning() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("plan.json");
    let file = file.to_str().unwrap();
    volver()
        .args([
            "plan",
            SMOKE,
            "--tolerance",
            "1e-5",
            "--json",
            file,
            "--quiet",
        ])
        .assert()
        .success()
        .stdout("");
    let plan: serde_json::Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    let run = volver()
        .args(["render", SMOKE, "--plan", file, "--json"])
        .assert()
        .success();
    let rendered: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert_eq!(rendered["evaluations"], plan["evaluations"]);
    assert_eq!(rendered["format"], plan["format"]);
    for (channel, checked) in rendered["channels"]
        .as_array()
        .unwrap()
        .iter()
        .zip(plan["checked"]["channels"].as_array().unwrap())
    {
        assert_eq!(channel["radiance"], checked["radiance"]);
    }
    // In another format the last digits differ, and no more.
    let run = volver()
        .args([
            "render", SMOKE, "--plan", file, "--format", "mpfr:120", "--json",
        ])
        .assert()
        .success();
    let wide: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let number = |value: &serde_json::Value| -> f64 {
        value["channels"][0]["radiance"]
            .as_str()
            .unwrap()
            .parse()
            .unwrap()
    };
    assert!((number(&wide) - number(&rendered)).abs() < 1e-5);
    assert_ne!(
        wide["channels"][0]["radiance"],
        rendered["channels"][0]["radiance"]
    );
}

#[test]
fn a_directory_gets_the_plan_as_json_markdown_and_page() {
    let directory = TempDir::new().unwrap();
    let out = directory.path().join("out");
    volver()
        .args(["plan", SMOKE, "--tolerance", "1e-3", "--quiet", "--out"])
        .arg(&out)
        .assert()
        .success();
    for name in ["plan.json", "plan.md", "index.html"] {
        assert!(out.join(name).is_file(), "{name}");
    }
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert!(page.contains("How the bounds add up along the ray"));
}

#[test]
fn a_stored_plan_belongs_to_its_scene_and_hangs_together() {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_string();
    let (plan, other) = (path("plan.json"), path("other.toml"));
    volver()
        .args([
            "plan",
            SMOKE,
            "--tolerance",
            "1e-3",
            "--quiet",
            "--json",
            &plan,
        ])
        .assert()
        .success();
    let scene = fs::read_to_string(SMOKE).unwrap();
    fs::write(
        &other,
        scene.replace("extinction = 0.01", "extinction = 0.02"),
    )
    .unwrap();
    refused(
        &["render", &other, "--plan", &plan],
        "the plan is for scene",
    );
    let good: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(&plan).unwrap()).unwrap();
    let damaged = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut value = good.clone();
        change(&mut value);
        fs::write(&plan, value.to_string()).unwrap();
    };
    damaged(&|v| v["steps"][1]["from"] = "1/2".into());
    refused(&["render", SMOKE, "--plan", &plan], "step 2: ");
    damaged(&|v| v["steps"][0]["medium"] = 99.into());
    refused(
        &["render", SMOKE, "--plan", &plan],
        "step 1: there is no medium 99",
    );
    damaged(&|v| v["steps"][0]["model"] = "linear".into());
    refused(
        &["render", SMOKE, "--plan", &plan],
        "does not fit the medium",
    );
    damaged(&|v| v["plan"] = 7.into());
    refused(&["render", SMOKE, "--plan", &plan], "version 7");
    damaged(&|v| v["steps"] = serde_json::json!([]));
    refused(
        &["render", SMOKE, "--plan", &plan],
        "the steps end before the ray does",
    );
    fs::write(&plan, "{").unwrap();
    refused(&["render", SMOKE, "--plan", &plan], "EOF");
    refused(
        &["render", "-", "--plan", "-"],
        "both come from standard input",
    );
}

#[test]
fn a_tolerance_that_no_allowed_format_reaches_says_which_bits_would() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("plan.json");
    let arguments = [
        "plan",
        SMOKE,
        "--tolerance",
        "1e-12",
        "--format",
        "f16,f32",
        "--json",
    ];
    let run = volver().args(arguments).arg(&file).assert().code(2);
    let said = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    let bits: u32 = said
        .split("about ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next())
        .and_then(|bits| bits.parse().ok())
        .unwrap_or_else(|| panic!("{said}"));
    assert!(!file.exists(), "a plan was written");
    // As many bits do it, and binary32's 24 did not.
    assert!((38..60).contains(&bits), "{said}");
    volver()
        .args([
            "plan",
            SMOKE,
            "--tolerance",
            "1e-12",
            "--format",
            &format!("mpfr:{bits}"),
        ])
        .assert()
        .success();
}

#[test]
fn more_digits_than_binary64_has_are_planned_too() {
    volver()
        .args(["plan", SMOKE, "--tolerance", "1e-25"])
        .assert()
        .success()
        .stdout(contains("in mpfr:").and(contains("within the tolerance")));
}

#[test]
fn scenes_that_are_wrong_are_refused_with_place_and_remedy() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("scene.toml");
    let write = |text: &str| fs::write(&file, text).unwrap();
    let plan = directory.path().join("plan.json");
    let arguments = || {
        let (scene, plan) = (file.to_str().unwrap(), plan.to_str().unwrap());
        ["plan", scene, "--tolerance", "1e-3", "--json", plan].map(String::from)
    };
    for (text, said) in [
        (
            "[[media]]\nfrom = 0\nto = 1\nkind = 'vacuum'\n[[media]]\nfrom = 2\nto = 3\nkind = 'vacuum'",
            "line 6: a gap from 1 to 2",
        ),
        (
            "[[media]]\nfrom = 0\nto = 2\nkind = 'vacuum'\n[[media]]\nfrom = 1\nto = 3\nkind = 'vacuum'",
            "line 6: it begins at 1",
        ),
        (
            "[[media]]\nfrom = 0\nto = 2\nkind = 'constant'\nextinction = -1",
            "line 5: extinction is -1",
        ),
        (
            "[[media]]\nfrom = 0\nto = 2\nkind = 'constant'\nextinction = nan",
            "line 5: 'NaN' is no finite number",
        ),
        (
            "features = ['scattering']\n[[media]]\nfrom = 0\nto = 2\nkind = 'vacuum'",
            "line 1: 'scattering' is not in the model",
        ),
        ("[[media]\n", "line 1: "),
        (
            "[[media]]\nfrom = 0\nto = 2\nkind = 'vacuum'\ncolour = 1",
            "unknown field 'colour'",
        ),
        (
            "[[media]]\nfrom = 0\nto = 1\nkind = 'sampled'\nsamples = 'gone.npy'\nextinction = 's'",
            "gone.npy",
        ),
    ] {
        write(text);
        let arguments = arguments();
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        if said == "gone.npy" {
            volver()
                .args(&arguments)
                .assert()
                .code(2)
                .stderr(contains(said));
        } else {
            refused(&arguments, said);
        }
        assert!(!plan.exists(), "a plan was written for {text}");
    }
}

#[test]
fn contradictory_or_meaningless_options_are_refused() {
    for tolerance in ["0", "-1", "nan", "much"] {
        refused(
            &["plan", SMOKE, &format!("--tolerance={tolerance}")],
            "no tolerance",
        );
    }
    refused(
        &["plan", SMOKE, "--tolerance", "1e-3", "--format", "f32,f32"],
        "a second time",
    );
    refused(
        &["plan", SMOKE, "--tolerance", "1e-3", "--format", "fixed:15"],
        "holds no optical depths",
    );
    refused(
        &["plan", SMOKE, "--tolerance", "1e-3", "--format", "f33"],
        "f33",
    );
    refused(&["plan", SMOKE], "--tolerance");
    refused(&["plan", "gone.toml", "--tolerance", "1e-3"], "gone.toml");
    refused(
        &[
            "plan",
            SMOKE,
            "--tolerance",
            "1e-3",
            "--quiet",
            "--json",
            "gone/plan.json",
        ],
        "gone",
    );
}

#[test]
fn the_example_of_sampled_data_is_planned() {
    assert!(Path::new("examples/scenes/chest.toml").is_file());
    volver()
        .args(["plan", "examples/scenes/chest.toml", "--tolerance", "1e-3"])
        .assert()
        .success()
        .stdout(contains("within the tolerance").count(3));
}

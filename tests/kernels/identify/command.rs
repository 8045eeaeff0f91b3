//! `volver identify` keeps its contract.

use crate::verify::run::{Run, command};
use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin;
use serde_json::Value;
use std::fs;

const KERNEL: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/kernels/identify/kernel.py"
);

fn identify(arguments: &[&str], fault: &str) -> Run {
    let mut all = vec!["identify"];
    all.extend(arguments);
    all.extend(["python3", KERNEL, fault]);
    Run::of(command(&all))
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.out).unwrap()
}

#[test]
fn a_right_kernel_is_good() {
    let run = identify(&[], "none").with_code(0);
    run.shows("The rule is identified, and does not deviate");
    run.hides("The smallest ray");
}

#[test]
fn a_deviation_is_named_with_value_bracket_and_witness() {
    let run = identify(&["--json", "-"], "early-end").with_code(1);
    let found = json(&run);
    assert_eq!(found["verdict"], "deviates");
    let all = found["deviations"].as_array().unwrap();
    assert_eq!(all.len(), 1, "{all:?}");
    assert_eq!(
        (&all[0]["name"], &all[0]["value"]),
        (&"early-end".into(), &0.0039.into())
    );
    let [low, high] = [0, 1].map(|i| all[0]["bracket"][i].as_f64().unwrap());
    assert!(
        low <= 0.0039 && 0.0039 <= high && high - low < 1e-5,
        "{low} {high}"
    );
    let witness = &found["witness"];
    assert!(
        witness["task"]["segments"].as_u64().unwrap() <= 2,
        "{witness}"
    );
    let text = identify(&[], "early-end").with_code(1);
    text.shows("deviates: early-end 0.0039");
    assert_eq!(all[0]["exact"], false);
    assert!(!all[0]["probe"].as_str().unwrap().is_empty());
    assert!(all[0]["validated"].as_array().unwrap().len() > 10);
    assert_eq!(found["rule"]["formula"]["stop"]["under"], 0.0039);
    assert!(found["rule"]["latex"].as_str().unwrap().contains("\\prod"));
    text.shows(witness["text"].as_str().unwrap());
}

#[test]
fn what_cannot_be_named_is_no_name_and_has_a_witness() {
    let run = identify(&["--json", "-", "--budget", "400"], "smoothed").with_code(1);
    let found = json(&run);
    assert_eq!(found["verdict"], "not-identified");
    assert_eq!(found["rule"], Value::Null);
    assert_eq!(found["deviations"], Value::Array(Vec::new()));
    assert!(!found["not_identified"].as_array().unwrap().is_empty());
    assert!(found["witness"]["task"]["segments"].as_u64().unwrap() <= 4);
}

#[test]
fn a_witness_is_asked_again_of_any_kernel() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("identify.json");
    let file = file.to_str().unwrap();
    identify(&["--quiet", "--json", file], "early-end").with_code(1);
    let again = identify(&["--replay", file], "early-end").with_code(1);
    again.shows("where the rule gives");
    identify(&["--replay", file], "none")
        .with_code(0)
        .shows("as the rule gives");
    fs::write(file, "{\"witness\": 1}").unwrap();
    identify(&["--replay", file], "none").with_code(2);
}

#[test]
fn two_kernels_are_compared_part_by_part() {
    let other = format!("python3 {KERNEL} early-end");
    let run = identify(&["--json", "-", "--against", &other], "none").with_code(1);
    let against = &json(&run)["against"];
    assert_eq!(against["agree"], false);
    assert!(against["differ"].as_u64().unwrap() > 0);
    let all = against["differences"].as_array().unwrap();
    assert_eq!(all.len(), 1, "{all:?}");
    assert_eq!(
        (&all[0]["part"], &all[0]["one"]),
        (&"early-end".into(), &Value::Null)
    );
    assert!(against["witness"]["task"]["segments"].as_u64().unwrap() <= 2);
    let other = format!("python3 {KERNEL} none");
    let run = identify(&["--json", "-", "--against", &other], "none").with_code(0);
    let against = &json(&run)["against"];
    assert_eq!(
        (&against["agree"], &against["differ"]),
        (&true.into(), &0.into())
    );
    assert_eq!(against["rays"], against["same_bits"]);
}

#[test]
fn a_directory_has_page_pictures_and_the_task() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    identify(&["--out", out.to_str().unwrap()], "early-end").with_code(1);
    for name in [
        "index.html",
        "identify.md",
        "identify.json",
        "weights.svg",
        "opacity.svg",
    ] {
        let written = fs::read_to_string(out.join(name)).unwrap();
        assert!(written.len() > 200, "{name}");
    }
    let page = fs::read_to_string(out.join("identify.md")).unwrap();
    assert!(page.contains("\"segments\":2"), "{page}");
}

#[test]
fn what_cannot_run_is_said_in_one_line() {
    for run in [
        identify(&[], "refuses"),
        identify(&["--budget", "0"], "none"),
        identify(&["--replay", "/nowhere"], "none"),
        identify(&["--test", "fortran"], "none"),
        identify(&["--function", "1; drop"], "none"),
        Run::of(command(&["identify", "nowhere-at-all"])),
    ] {
        run.with_code(2);
    }
}

#[test]
fn a_rule_is_printed_as_code_that_computes_what_the_kernel_does() {
    let run = identify(&["--code", "python"], "early-end").with_code(1);
    let script = format!(
        "{}\nedge = dict(extinction=[0] * 3, emission=[[0] * 3])\nedge['lambda'] = [0, 1, 2]\n\
         middle = dict(extinction=[9, 1], emission=[[0, 1]])\nmiddle['lambda'] = [0.5, 1.5]\n\
         print(render(dict(segments=2, step=1, length=2, data=dict(edges=edge, middles=middle)))[0])",
        run.out
    );
    let mut python = Command::new("python3");
    python.args(["-c", &script]);
    // Behind a depth of 9 the ray has ended.
    assert_eq!(Run::of(python).with_code(0).out.trim(), "0.0");
    let c = identify(&["--code", "c"], "none").with_code(0);
    c.shows("double radiance(");
    c.hides("What it computes");
    identify(&["--code", "c"], "smoothed")
        .with_code(1)
        .shows("The rule is not identified");
    identify(&["--code", "rust"], "none").with_code(2);
}

#[test]
fn a_method_states_its_rule_and_is_not_probed() {
    let of = |arguments: &[&str]| Run::of(command(arguments));
    let run = of(&["identify", "method:front-to-back/back/expm1/stop=1:3"]).with_code(0);
    run.shows("stated, and was not probed");
    run.shows("samples at the back of segments");
    let name = "method:trapezoid/trapezoid";
    let found = json(&of(&["identify", "--json", "-", name]).with_code(0));
    assert_eq!(found["verdict"], "stated");
    assert!(
        found["rule"]["c"]
            .as_str()
            .unwrap()
            .contains("double radiance(")
    );
    of(&["identify", "--code", "python", name])
        .with_code(0)
        .shows("def radiance(");
    of(&["identify", "method:gauss-3/boole"]).with_code(2);
    of(&["identify", "--test", "c", name]).with_code(2);
    identify(&["--against", name], "none").with_code(2);
}

#[test]
fn kernels_that_misbehave_have_a_report_and_no_false_name() {
    for fault in [
        "nan",
        "garbage",
        "only-eight",
        "three-channels",
        "no-single",
        "dies",
    ] {
        let run = identify(&["--json", "-", "--budget", "300"], fault);
        assert!(matches!(run.code, Some(0..=2)), "{fault}: {}", run.err);
        if run.code == Some(2) {
            continue;
        }
        let found = json(&run);
        let all = found["deviations"].as_array().unwrap();
        let of_state = [
            "noise",
            "previous-answer",
            "first-answer",
            "vacuum-ray",
            "vacuum-segment",
        ];
        for deviation in all {
            let name = deviation["name"].as_str().unwrap();
            assert!(of_state.contains(&name), "{fault}: {name}");
        }
    }
    identify(&["--timeout", "0.5", "--seconds", "5"], "hangs").with_code(2);
}

#[test]
fn the_examples_of_the_help_run() {
    let binary = cargo_bin!("volver");
    let folder = binary.parent().unwrap().display();
    let path = format!("{folder}:{}", std::env::var("PATH").unwrap());
    let help = Run::of(command(&["identify", "--help"])).with_code(0).out;
    assert!(
        help.lines().all(|line| line.chars().count() <= 100),
        "{help}"
    );
    let (_, examples) = help.split_once("Examples:\n").unwrap();
    let examples: Vec<&str> = examples
        .lines()
        .map_while(|line| line.strip_prefix("  "))
        .collect();
    assert!(examples.len() >= 3, "{examples:?}");
    for example in examples {
        let mut command = Command::new("sh");
        command
            .args(["-c", example])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .env("PATH", &path);
        assert!(!Run::of(command).with_code(0).out.is_empty(), "{example}");
    }
}

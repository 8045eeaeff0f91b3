//! What a kernel is asked is printed as it gets it, with what a method answers.

use super::run::{Marked, Run, volver};
use serde_json::Value;

fn ask(arguments: &[&str]) -> Run {
    volver(&[&["ask"], arguments].concat())
}

fn lines(arguments: &[&str]) -> Vec<Value> {
    let run = ask(arguments).with_code(0);
    run.out
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// The first messages over a descriptor while the fixture is put to the test.
fn logged(declare: &str, mark: &str) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log");
    let marked = Marked::new();
    let kernel = marked.kernel(&["--declare", declare]);
    let kernel: Vec<&str> = kernel.iter().map(String::as_str).collect();
    let options = [
        "verify",
        "--cases",
        "sine-squared",
        "--log",
        log.to_str().unwrap(),
    ];
    volver(&[&options[..], &kernel].concat());
    marked.assert_gone();
    let log = std::fs::read_to_string(log).unwrap();
    let lines = log
        .lines()
        .filter_map(|line| line.strip_prefix(mark)?.strip_prefix(' '));
    lines
        .take(4)
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

#[test]
fn the_request_is_what_a_kernel_gets() {
    let method = r#"{"method": "front-to-back/middle/subtraction"}"#;
    for (form, declare) in [("segments", method), ("volume", r#"{"form": "volume"}"#)] {
        // The fixture knows segments alone: it is asked a volume all the same.
        let asked = logged(declare, "3");
        let task = &asked[1]["tasks"][0];
        let step = task["step"].to_string();
        let own = lines(&[
            "sine-squared",
            "--form",
            form,
            "--step",
            &step,
            "--greeting",
        ]);
        assert_eq!(own[0], asked[0]);
        assert_eq!(own[1]["tasks"][0], *task);
        assert_eq!(task["data"]["form"], form);
        assert_eq!(task["segments"], 9);
    }
}

#[test]
fn a_method_answers_as_a_kernel_that_is_it() {
    let method = r#"{"method": "front-to-back/middle/subtraction"}"#;
    let asked = &logged(method, "3")[1];
    let answered = &logged(method, "4")[1];
    // The method divides rays alone: nine segments of a step that does.
    let own = lines(&[
        "sine-squared",
        "-n",
        "9",
        "--by",
        "front-to-back/middle/subtraction",
    ]);
    assert_eq!(own[1]["type"], "radiance");
    assert_eq!(own[1]["id"], own[0]["id"]);
    let of = |answer: &Value| answer["results"][0]["radiance"][0].as_f64().unwrap();
    // By hand, as the fixture does it.
    let data = &own[0]["tasks"][0]["data"];
    let rows = |row: &Value| -> Vec<f64> {
        row.as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect()
    };
    let ends = rows(&data["edges"]["lambda"]);
    let (extinction, emission) = (
        rows(&data["middles"]["extinction"]),
        rows(&data["middles"]["emission"][0]),
    );
    let (mut radiance, mut passes) = (0.0, 1.0);
    for i in 0..9 {
        let alpha = 1.0 - (-extinction[i] * (ends[i + 1] - ends[i])).exp();
        radiance += passes * alpha * emission[i];
        passes *= 1.0 - alpha;
    }
    assert!((of(&own[1]) - radiance).abs() < 1e-15);
    // The last segment of the fixture's ray is shorter.
    assert_ne!(asked["tasks"][0]["step"], own[0]["tasks"][0]["step"]);
    assert!((of(answered) - radiance).abs() < 1e-2);
}

#[test]
fn of_a_volume_a_method_sees_what_the_volume_shows() {
    // Between its two ends all is linear: half of tau(1) and C(1) in the middle.
    let volume = ["--form", "volume", "--cells", "1", "--entries", "2"];
    let by = ["--by", "front-to-back/middle/expm1", "-n", "1"];
    let own = lines(&[&["sine-squared"], &volume[..], &by].concat());
    let radiance = own[1]["results"][0]["radiance"][0].as_f64().unwrap();
    let (sine, cosine) = 1_f64.sin_cos();
    assert!((radiance + (-cosine / 2.0).exp_m1() * sine / 2.0).abs() < 1e-15);
}

#[test]
fn many_digits_are_written_and_numbers_as_asked_for() {
    let by = "trapezoid/trapezoid@mpfr:200";
    let own = lines(&[
        "sine-squared",
        "-n",
        "4",
        "--numbers",
        "hexadecimal",
        "--by",
        by,
    ]);
    assert_eq!(own[0]["tasks"][0]["step"], "0x1p-2");
    let radiance = own[1]["results"][0]["radiance"][0].as_str().unwrap();
    assert!(radiance.len() > 55, "{radiance}");
    // Boole's rule takes four at once, and says so.
    let own = lines(&["sine-squared", "-n", "3", "--by", "trapezoid/boole"]);
    assert_eq!(own[1]["results"][0]["step"], 0.25);
}

#[test]
fn a_formula_is_code() {
    let own = lines(&["cloud", "--form", "formula", "--language", "python"]);
    let code = own[0]["tasks"][0]["data"]["code"].as_str().unwrap();
    assert!(code.contains("def extinction("), "{code}");
}

#[test]
fn what_cannot_be_asked_is_named() {
    for (arguments, message) in [
        (
            "sine-square",
            "no case 'sine-square' (nearest: sine-squared; allowed: ",
        ),
        (
            "sine-squared/red",
            "no channel 'red' in sine-squared (allowed: ",
        ),
        (
            "sine-squared -n 0",
            "invalid value '0' for '--segments <N>': no number of segments (allowed: 1 to 1048576)",
        ),
        (
            "sine-squared -n -1",
            "invalid value '-1' for '--segments <N>': no number of segments (allowed: ",
        ),
        (
            "sine-squared --step 0",
            "sine-squared: a step of 0 (allowed: ",
        ),
        (
            "sine-squared --step 1e-9",
            "sine-squared: 1000000000 segments (allowed: ",
        ),
        (
            "sine-squared --form grid",
            "invalid value 'grid' for '--form <FORM>' (allowed: segments, volume, formula)",
        ),
        (
            "sine-squared --form formula",
            "--form formula without --language (allowed: ",
        ),
        (
            "sine-squared --language c",
            "--language without need (allowed: ",
        ),
        ("sine-squared --cells 4", "--cells without need (allowed: "),
        (
            "sine-squared --form volume --entries 1",
            "invalid value '1' for '--entries <K>': no number of entries (allowed: ",
        ),
        (
            "sine-squared --by nerf",
            "method 'nerf': unknown inner rule or kind of method 'nerf' (allowed: ",
        ),
    ] {
        let words: Vec<&str> = arguments.split(' ').collect();
        let run = ask(&words).with_code(2);
        assert_eq!(run.out, "");
        assert!(
            run.err.starts_with(&format!("volver: {message}")),
            "{}",
            run.err
        );
        assert_eq!(run.err.matches("allowed: ").count(), 1, "{}", run.err);
    }
}

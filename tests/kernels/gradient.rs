//! `volver gradient`: derivatives beside theory.

mod inside;

use crate::verify::run::{Run, in_repository, volver};
use serde_json::Value;

fn gradient(options: &[&str], kernel: &[&str]) -> Run {
    let program = in_repository("examples/kernels/gradient.py");
    let words = [&["gradient"], options, &["python3", &program], kernel].concat();
    volver(&words)
}

/// Every line as (case, derivative, norm, line).
fn lines(document: &Value) -> Vec<(String, String, Value)> {
    let cases = document["cases"].as_array().unwrap();
    let of = |case: &Value| {
        let name = case["name"].as_str().unwrap().to_string();
        let lines = case["lines"].as_array().unwrap().clone();
        let named = |line: Value| {
            (
                name.clone(),
                line["derivative"].as_str().unwrap().into(),
                line,
            )
        };
        lines.into_iter().map(named).collect::<Vec<_>>()
    };
    cases.iter().flat_map(of).collect()
}

const TWO: [&str; 4] = ["--cases", "sine-squared,rgb-transfer", "--json", "-"];

#[test]
fn both_derivatives_have_the_order_of_the_samples() {
    for (sampling, order) in [("middle", 2.0), ("front", 1.0)] {
        let run = gradient(&TWO, &["--sampling", sampling]).with_code(0);
        let document = run.json();
        assert_eq!(document["conclusion"], "confirmed");
        assert_eq!(document["sampling"], sampling);
        assert_eq!(document["sampling_declared"], true);
        let lines = lines(&document);
        assert_eq!(lines.len(), 8);
        for (case, derivative, line) in lines {
            // One sample at the front of a ray that begins in a vacuum: only there it errs in the first order.
            let is_better = sampling == "front"
                && (&*case, &*derivative, &line["norm"])
                    == ("sine-squared", "emission", &"mean-square".into());
            let order = if is_better { 1.5 } else { order };
            let found = line["order"].as_f64().unwrap();
            assert!((found - order).abs() <= 0.05, "{case} {line}");
            assert!(
                line["half_width"].as_f64().unwrap() <= 0.05,
                "{case} {line}"
            );
            let standing = if is_better {
                "inconclusive"
            } else {
                "confirmed"
            };
            assert_eq!(line["standing"], standing);
        }
    }
}

#[test]
fn the_standard_cases_confirm_a_right_gradient() {
    let document = gradient(&["--json", "-"], &[]).with_code(0).json();
    assert_eq!(document["cases"].as_array().unwrap().len(), 7);
    assert_eq!(document["counts"]["contradicted"], 0);
    assert!(document["counts"]["confirmed"].as_u64().unwrap() >= 27);
    // Of channels, others each.
    let channels = document["cases"].as_array().unwrap().iter();
    let most = channels.map(|case| case["cotangents"].as_array().unwrap().len());
    assert_eq!(most.max(), Some(3));
}

#[test]
fn faults_are_contradicted() {
    for (fault, by_c, verdict) in [
        ("transmittance", "confirmed", "Stalled"),
        ("factor", "confirmed", "Stalled"),
        ("sign", "confirmed", "Stalled"),
        ("own-light", "confirmed", "TooLow"),
        ("detached", "confirmed", "Stalled"),
        ("channels", "contradicted", "Stalled"),
        ("length", "confirmed", "Diverged"),
        ("nan", "confirmed", "NotFinite"),
    ] {
        let run = gradient(
            &["--cases", "rgb-transfer", "--json", "-"],
            &["--fault", fault],
        );
        let document = run.with_code(1).json();
        assert_eq!(document["conclusion"], "not confirmed");
        for (_, derivative, line) in lines(&document) {
            if derivative == "emission" {
                assert_eq!(line["standing"], by_c, "{fault} {line}");
            } else {
                assert_eq!(line["standing"], "contradicted", "{fault} {line}");
                assert_eq!(line["verdict"], verdict, "{fault} {line}");
            }
        }
        let troubles = match fault {
            "nan" => serde_json::json!(["not-finite"]),
            "detached" => serde_json::json!(["zero"]),
            _ => serde_json::json!([]),
        };
        assert_eq!(document["cases"][0]["troubles"], troubles, "{fault}");
    }
}

#[test]
fn theory_of_one_channel_does_not_show_that_cotangents_are_mixed_up_and_values_of_two_do() {
    let options = ["--cases", "sine-squared", "--json", "-"];
    let document = gradient(&options, &["--fault", "channels"])
        .with_code(1)
        .json();
    assert_eq!(document["counts"]["contradicted"], 0);
    let own = &document["own_values"];
    assert!(own["agree"].as_u64() < own["compared"].as_u64(), "{own}");
}

#[test]
fn what_stands_at_the_end_is_part_of_what_comes_from_behind() {
    let document = gradient(&TWO, &["--background"]).with_code(0).json();
    assert_eq!(document["counts"]["confirmed"], 8);
    let document = gradient(&TWO, &["--far-wall"]).with_code(0).json();
    assert_eq!(document["counts"]["confirmed"], 8);
    // One sample stands for the wall, up to a step in front of it.
    let orders = serde_json::json!({"extinction": 1.0, "emission": 2.0});
    assert_eq!(document["orders"], orders);
    for case in document["cases"].as_array().unwrap() {
        // One a level.
        assert_eq!(case["left_out"]["wall"], 8, "{case}");
    }
}

#[test]
fn kinks_are_left_out_and_counted() {
    let options = ["--cases", "vacuum,sine-squared", "--json", "-"];
    let document = gradient(&options, &["--sampling", "front"])
        .with_code(1)
        .json();
    let case = |name: &str| {
        let cases = document["cases"].as_array().unwrap().iter();
        cases
            .clone()
            .find(|case| case["name"] == name)
            .unwrap()
            .clone()
    };
    let (vacuum, sine) = (case("vacuum"), case("sine-squared"));
    assert_eq!(vacuum["left_out"]["kinks"], vacuum["samples"]);
    // Its first sample, at every level.
    assert_eq!(sine["left_out"]["kinks"], 8);
    assert_eq!(sine["left_out"]["flat"], 0);
    for line in vacuum["lines"].as_array().unwrap() {
        // By C all of them are looked at, and are 0 as they should be.
        let (count, verdict) = match line["derivative"].as_str() {
            Some("extinction") => (0, "TooFewLevels"),
            _ => (8, "Exact"),
        };
        assert_eq!(line["samples"].as_array().unwrap().len(), count, "{line}");
        if count > 0 {
            assert_eq!(line["verdict"], verdict, "{line}");
        }
    }
}

#[test]
fn a_vacuum_without_a_slope_is_legal_and_said() {
    let kernel = ["--sampling", "front", "--rectifier"];
    let options = ["--cases", "sine-squared", "--json", "-"];
    // Not for that: one line of this case alone is better than its order, with a slope and without.
    let document = gradient(&options, &kernel).with_code(1).json();
    assert_eq!(document["counts"]["contradicted"], 0);
    // Its first sample, at every level.
    let left_out = &document["cases"][0]["left_out"];
    assert_eq!(
        (&left_out["kinks"], &left_out["flat"]),
        (&8.into(), &8.into())
    );
    let text = gradient(&["--cases", "sine-squared"], &kernel).with_code(1);
    let words: Vec<&str> = text.out.split_whitespace().collect();
    let said = "a vacuum without a slope: 8 of them are 0, as behind a rectifier";
    assert!(words.join(" ").contains(said), "{}", text.out);
}

#[test]
fn a_medium_without_closed_forms_has_the_same_theory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.toml");
    let medium =
        "name = \"plain\"\nlength = 1\nextinction = \"s*cos(s^2)\"\nemission = \"sin(s^2)\"\n";
    std::fs::write(&path, medium).unwrap();
    let of = |case: &str| {
        let options = ["--cases", case, "--json", "-"];
        gradient(&options, &[]).with_code(0).json()["cases"][0].clone()
    };
    let (plain, known) = (of(path.to_str().unwrap()), of("sine-squared"));
    assert!(known["integrated"].is_null());
    assert!(plain["integrated"].as_f64().unwrap() < 1e-30, "{plain}");
    for (a, b) in plain["lines"]
        .as_array()
        .unwrap()
        .iter()
        .zip(known["lines"].as_array().unwrap())
    {
        let errors = |line: &Value| -> Vec<f64> {
            let samples = line["samples"].as_array().unwrap().iter();
            samples
                .map(|sample| sample["error"].as_f64().unwrap())
                .collect()
        };
        for (a, b) in errors(a).into_iter().zip(errors(b)) {
            // What rounding leaves of values that are given by two formulas.
            assert!((a - b).abs() <= 1e-13, "{a} {b}");
        }
    }
}

#[test]
fn the_own_values_name_the_wrong_term() {
    for (fault, name) in [
        ("own-light", "gradient-own-light"),
        ("sign", "gradient-sign"),
        ("factor", "gradient-factor"),
        ("transmittance", "gradient-direct-unattenuated"),
        ("detached", "gradient-zero"),
    ] {
        let run = gradient(&TWO, &["--fault", fault]).with_code(1);
        let document = run.json();
        let own = &document["own_values"];
        assert_eq!(document["conclusion"], "not confirmed", "{fault}");
        assert_eq!(own["deviations"][0]["name"], name, "{fault}: {own}");
        assert_eq!(own["deviations"].as_array().map(Vec::len), Some(1));
        assert!(own["farthest"].is_string());
    }
    let document = gradient(&TWO, &[]).with_code(0).json();
    let own = &document["own_values"];
    assert_eq!(own["agree"], own["compared"]);
    assert_eq!(own["compared"], 141);
    // Three rays in one request, and four in another, with cotangents of their own each.
    let together = serde_json::json!({"rays": 7, "differ": 0});
    assert_eq!(own["together"], together);
}

#[test]
fn a_kernel_that_draws_random_numbers_is_compared_in_the_mean() {
    let options = [
        "--cases",
        "rgb-transfer",
        "--levels",
        "16..256",
        "--replicas",
        "40",
    ];
    let json = [&options[..], &["--json", "-"]].concat();
    let document = gradient(&json, &["--sampling", "jittered"])
        .with_code(0)
        .json();
    assert_eq!(document["replicas"], 40);
    let means = document["cases"][0]["means"].as_array().unwrap();
    assert_eq!(means.len(), 4);
    assert!(means.iter().all(|mean| mean["standing"] == "confirmed"));
    // Their own values are those of a seed.
    assert!(document["own_values"]["not_compared"].is_string());
    let wrong = ["--sampling", "jittered", "--fault", "sign"];
    let document = gradient(&json, &wrong).with_code(1).json();
    for mean in document["cases"][0]["means"].as_array().unwrap() {
        let is_wrong = mean["derivative"] == "extinction";
        assert_eq!(mean["verdict"] == "biased", is_wrong, "{mean}");
    }
    let run = gradient(&options, &wrong).with_code(1);
    assert!(run.out.contains("biased by -2.0e0"), "{}", run.out);
    assert!(run.out.contains("4 of them"), "{}", run.out);
    let run = gradient(&["--replicas", "3"], &[]).with_code(2);
    assert!(
        run.err.contains("no number of seeds (allowed: 8"),
        "{}",
        run.err
    );
}

#[test]
fn the_report_is_printed_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let options = ["--cases", "sine-squared", "--out", out.to_str().unwrap()];
    let run = gradient(&options, &["--fault", "transmittance"]).with_code(1);
    assert!(run.out.contains("by τ, largest"), "{}", run.out);
    assert!(run.out.contains("Stalled"), "{}", run.out);
    assert!(
        run.out.contains("the gradient is not confirmed"),
        "{}",
        run.out
    );
    for file in ["gradient.json", "gradient.md", "index.html"] {
        assert!(out.join(file).is_file(), "{file}");
    }
}

#[test]
fn a_kernel_without_gradient_is_refused_in_one_line() {
    let nerf = in_repository("examples/kernels/nerf.py");
    for kernel in [
        &["python3", &nerf][..],
        &["method:front-to-back/middle/expm1"],
    ] {
        let run = volver(&[&["gradient", "--cases", "sine-squared"], kernel].concat()).with_code(2);
        assert_eq!(run.out, "");
        assert_eq!(run.err.lines().count(), 1, "{}", run.err);
        let allowed = "no gradient is declared (allowed: \"gradient\": \"middles\" or \"edges\" in the greeting)";
        assert!(run.err.contains(allowed), "{}", run.err);
    }
    let run = gradient(&["--levels", "8,16"], &[]).with_code(2);
    assert!(
        run.err
            .starts_with("volver: --levels: 2 levels show no order"),
        "{}",
        run.err
    );
}

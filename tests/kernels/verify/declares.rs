//! What a program's greeting declares of arithmetic and rays, from the wire to the report.

use super::run::fixture;
use serde_json::json;

fn greeting(more: &serde_json::Value) -> String {
    let mut greeting = json!({"protocol": 2, "method": "front-to-back/middle/subtraction"});
    let keys = greeting.as_object_mut().unwrap();
    keys.extend(more.as_object().unwrap().clone());
    greeting.to_string()
}

/// Rays go over the wire in pieces, and all that is declared stands in JSON.
#[test]
fn what_is_declared_is_used_and_said() {
    let declared = greeting(&json!({
        "channels": 2, "output": "f64", "quantum": {"relative": 1e-9}, "exp_ulp": {"a": 4, "b": 1},
        "expm1_ulp": 1, "pow_ulp": 2, "subnormals": "lost", "emission": "positive"
    }));
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log");
    let options = ["--json", "-", "--log", log.to_str().unwrap()];
    let run = fixture(&options, &["--declare", &declared]).with_code(0);
    let kernel = &run.json()["kernel"];
    assert_eq!(kernel["channels"], 2);
    assert_eq!(kernel["output"], "f64");
    assert_eq!(kernel["quantum"], json!({"relative": 1e-9}));
    assert_eq!(kernel["exp_ulp"], json!({"a": 4.0, "b": 1.0}));
    assert_eq!(kernel["subnormals"], "lost");
    assert_eq!(kernel["emission"], "positive");
    let log = std::fs::read_to_string(&log).unwrap();
    let requests = log.lines().filter_map(|line| line.strip_prefix("3 "));
    let mut tasks = 0;
    for request in requests {
        let request: serde_json::Value = serde_json::from_str(request).unwrap();
        for task in request["tasks"].as_array().into_iter().flatten() {
            assert_eq!(task["channels"].as_array().unwrap().len(), 2, "{task}");
            let edges = &task["data"]["edges"]["emission"];
            assert_eq!(edges.as_array().unwrap().len(), 2);
            tasks += 1;
        }
    }
    assert!(tasks > 0);
}

/// Without the breaks of lines.
fn said(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ")
}

/// Noise is allowed as far as it is declared, and no further.
#[test]
fn noise_is_allowed_where_it_is_declared() {
    let declared = |noise: f64| greeting(&json!({ "noise": noise }));
    // The fixture's answers are up to a thousandth of them too large.
    let few = fixture(&[], &["--unsteady", "--declare", &declared(1e-9)]).with_code(1);
    assert!(said(&few.out).contains("differ from run to run by more than twice"));
    // Through so much of it no order shows; nothing speaks against the kernel either.
    let enough = fixture(&[], &["--unsteady", "--declare", &declared(4e-3)]).with_code(1);
    let enough = said(&enough.out);
    assert!(!enough.contains("differ from run to run"), "{enough}");
    assert!(!enough.contains("not what it declares"), "{enough}");
    assert!(enough.contains(" 0 contradicted"), "{enough}");
}

#[test]
fn what_cannot_be_together_is_refused_in_one_line() {
    for (more, words) in [
        (
            json!({"noise": 1e-6, "stochastic": true}),
            "it declares noise and random numbers, whose scatter is measured (allowed: one of the two)",
        ),
        (
            json!({"channels": 3, "gradient": "middles"}),
            "it declares a gradient and how many channels a ray has to have (allowed: one of the two)",
        ),
    ] {
        let run = fixture(&[], &["--declare", &greeting(&more)]).with_code(2);
        assert!(run.err.contains(words), "{}", run.err);
    }
}

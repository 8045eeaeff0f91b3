//! `volver gradient-test`: anybody's Taylor remainders.

use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::fmt::Write;

/// f(x) = exp(x₀) sin(x₁) at (1/2, 1/3) along v = (1, 2), with its slope; the gradient tested is wrong by `part` of it.
fn remainders(steps: &[f64], part: f64, with_change: bool) -> String {
    let f = |x: f64, y: f64| x.exp() * y.sin();
    let (x, y) = (0.5_f64, 1.0 / 3.0_f64);
    let slope = f(x, y) + 2.0 * x.exp() * y.cos();
    let mut text = String::new();
    for h in steps {
        let change = f(x + h, y + 2.0 * h) - f(x, y);
        let remainder = (change - h * slope * (1.0 + part)).abs();
        let _ = write!(text, "{h:e} {remainder:e}");
        let _ = if with_change {
            writeln!(text, " {:e}", change.abs())
        } else {
            writeln!(text)
        };
    }
    text
}

fn tenths(from: i32, to: i32) -> Vec<f64> {
    (from..=to).map(|k| 10_f64.powi(-k)).collect()
}

fn halves(count: i32) -> Vec<f64> {
    (3..3 + count).map(|k| 0.5_f64.powi(k)).collect()
}

fn run(options: &[&str], input: &str) -> (Option<i32>, String, String) {
    let mut command = cargo_bin_cmd!("volver");
    command.args(["gradient-test", "-"]).args(options);
    let output = command.write_stdin(input.to_string()).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn json(options: &[&str], input: &str) -> Value {
    let (_, out, err) = run(&[&["--json"], options].concat(), input);
    serde_json::from_str(&out).unwrap_or_else(|_| panic!("{out}{err}"))
}

#[test]
fn a_right_gradient_leaves_the_second_order() {
    // Down to roundoff, which the last have reached.
    for steps in [halves(8), tenths(1, 6), tenths(1, 12)] {
        let input = remainders(&steps, 0.0, true);
        let (code, out, err) = run(&[], &input);
        assert_eq!(code, Some(0), "{out}{err}");
        let words = "second-order remainder: the gradient is right";
        assert!(out.ends_with(&format!("{words}\n")), "{out}");
        let found = json(&[], &input);
        assert_eq!(found["remainder"], "second-order");
        assert_eq!(found["wrong_by"], Value::Null);
        let order = found["fit"]["order"].as_f64().unwrap();
        assert!((order - 2.0).abs() < 0.05, "{order}");
        let is_cut = !found["roundoff"].is_null();
        assert_eq!(is_cut, steps.len() == 12, "{found}");
    }
}

#[test]
fn a_wrong_gradient_is_said_to_be_wrong_and_by_how_much() {
    for part in [0.03, -0.03, 0.001, -2.0, 1e-4] {
        for steps in [halves(12), tenths(1, 10)] {
            let input = remainders(&steps, part, true);
            let (code, out, _) = run(&[], &input);
            assert_eq!(code, Some(1), "{part} {out}");
            let (_, said) = out
                .rsplit_once("first-order remainder: the gradient is wrong by about ")
                .unwrap();
            let percent: f64 = said.strip_suffix(" %\n").unwrap().parse().unwrap();
            assert!(
                (percent / 100.0 / part.abs() - 1.0).abs() < 0.05,
                "{part} {out}"
            );
            let found = json(&[], &input)["wrong_by"].as_f64().unwrap();
            assert!((found / part.abs() - 1.0).abs() < 0.05, "{part} {found}");
        }
        // Whatever roundoff does to the finest, that is not right.
        let (code, out, _) = run(&[], &remainders(&tenths(1, 12), part, true));
        assert_eq!(code, Some(1), "{part} {out}");
    }
    let (_, out, _) = run(&[], &remainders(&halves(12), 0.03, true));
    assert!(
        out.ends_with("the gradient is wrong by about 3 %\n"),
        "{out}"
    );
}

#[test]
fn without_changes_the_slope_says_how_much_that_is() {
    let input = remainders(&halves(10), 0.03, false);
    let found = json(&[], &input);
    assert_eq!(found["remainder"], "first-order");
    assert_eq!(found["wrong_by"], Value::Null);
    let slope = 0.5_f64.exp() * ((1.0_f64 / 3.0).sin() + 2.0 * (1.0_f64 / 3.0).cos());
    let first = found["first"].as_f64().unwrap();
    assert!((first / (0.03 * slope) - 1.0).abs() < 0.01, "{found}");
    let found = json(&["--slope", "-3.6561"], &input);
    assert!(
        (found["wrong_by"].as_f64().unwrap() - 0.03).abs() < 0.001,
        "{found}"
    );
}

#[test]
fn forms_of_the_table_are_the_same() {
    let rows = "0.4 0.16\n0.2 0.04\n0.1 0.01\n0.05 0.0025\n";
    let want = json(&[], rows);
    assert_eq!(want["remainder"], "second-order");
    for input in [
        "h,remainder\n0.05,0.0025\n0.1,0.01\n0.2,0.04\n0.4,0.16\n",
        "# a comment\neps;r\n0.4;0.16\n0.2;-0.04\n0.1;0.01\n0.05;0.0025\n",
        "[[0.4,0.16],[0.2,0.04],[0.1,0.01],[0.05,0.0025]]",
        "{\"h\":[0.4,0.2,0.1,0.05],\"remainder\":[0.16,0.04,0.01,0.0025]}",
    ] {
        assert_eq!(
            json(&[], input)["fit"]["order"],
            want["fit"]["order"],
            "{input}"
        );
    }
}

#[test]
fn what_no_order_shows_in_does_not_pass() {
    let nan = run(&[], ".4 nan\n.2 .1\n.1 .1\n.05 .1\n");
    assert_eq!(nan.0, Some(1));
    assert!(
        nan.1.ends_with("a remainder is NaN or infinite\n"),
        "{}",
        nan.1
    );
    let few = run(&[], ".4 .16\n.2 .04\n");
    assert_eq!(few.0, Some(1));
    assert!(few.1.contains("no order shows (TooFewLevels)"), "{}", few.1);
    // All of it is roundoff.
    let floor = run(
        &["--floor", "1e-3"],
        ".4 1e-3\n.2 2e-3\n.1 1e-3\n.05 2e-3\n",
    );
    assert_eq!(floor.0, Some(1), "{}", floor.1);
    // f is linear along v, or has no curvature there.
    let zero = run(&[], ".4 0\n.2 0\n.1 0\n.05 0\n");
    assert_eq!(zero.0, Some(0));
    let third = run(&[], ".4 .064\n.2 .008\n.1 .001\n.05 .000125\n");
    assert_eq!(third.0, Some(0), "{}", third.1);
    let words: Vec<&str> = third.1.split_whitespace().collect();
    assert!(words.join(" ").contains("no curvature"), "{}", third.1);
}

#[test]
fn what_is_no_table_is_refused_in_one_line() {
    for (input, words) in [
        ("", "-: no rows of numbers"),
        (".4 .1\n.2\n", "-: line 2: 1 fields (allowed: 2)"),
        (".4\n", "-: line 1: 1 fields (allowed: 2)"),
        (
            "h,q\n.4,.1\n",
            "-: line 1: unknown column 'q' (allowed: h, eps,",
        ),
        ("h,h\n.4,.1\n", "-: line 1: column 'h' is one too many"),
        ("h\n.4\n", "-: line 1: the header has no remainder"),
        (
            ".4 .1\n.4 .1\n",
            "-: line 2: step '0.4' stands in line 1 already",
        ),
        ("-1 .1\n.4 .1\n", "-: line 1, h: step '-1' is not allowed"),
        (".4 x\n.2 .1\n", "-: line 1, remainder: 'x' is not allowed"),
        ("[[0.4],[0.2]]", "-: line 1: 1 fields (allowed: 2)"),
        ("[[0.4,0.1],[0.2]]", "-: line 2: 1 fields (allowed: 2)"),
        (
            "{\"h\":[1],\"remainder\":[]}",
            "-: columns of 1 and 0 numbers",
        ),
        ("[[0.4,", "-: "),
        ("{\"h\":3}", "-: "),
    ] {
        let (code, out, err) = run(&[], input);
        assert_eq!((code, &*out), (Some(2), ""), "{input:?} {err}");
        assert!(
            err.starts_with(&format!("volver: {words}")),
            "{input:?} {err}"
        );
        assert!(err.contains("(allowed: "), "{input:?} {err}");
        assert_eq!(err.lines().count(), 1, "{err}");
    }
    for option in ["--slope=0", "--slope=x", "--floor=-1"] {
        let (code, _, err) = run(&[option], ".4 .1\n.2 .1\n");
        assert_eq!(code, Some(2), "{err}");
    }
}

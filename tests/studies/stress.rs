//! At the extremes nothing is silently wrong, and what befalls a run is called by its name.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use rug::{Float, Rational};
use std::collections::BTreeSet;
use std::sync::LazyLock;
use volver::case::{Fresh, HomogeneousSlab};
use volver::method::Method;
use volver::real::{Mpfr, Native};
use volver::study::Silent;
use volver::study::stress::{
    Cell, Digits, FORMATS, Kind, METHODS, Medium, Scenario, Settings, Verdict, exact, run,
    scenarios,
};

/// The default grid, but for its longest rays, which optimised code alone runs in reasonable time.
static CELLS: LazyLock<Vec<Cell>> = LazyLock::new(|| {
    let all = scenarios(None, &[1, 2, 256, 65_536]);
    grid(all, &METHODS, &FORMATS)
});

fn grid(scenarios: Vec<Scenario>, methods: &[&str], formats: &[&str]) -> Vec<Cell> {
    let settings = Settings {
        scenarios,
        methods: methods.iter().map(|name| name.parse().unwrap()).collect(),
        formats: formats.iter().map(|name| name.parse().unwrap()).collect(),
    };
    run(&settings, &Silent).unwrap()
}

fn cell(scenario: &str, method: &str, format: &str) -> &'static Cell {
    CELLS
        .iter()
        .find(|c| c.scenario == scenario && c.method == method && c.format == format)
        .unwrap_or_else(|| panic!("no cell {scenario} {method} {format}"))
}

fn verdict(scenario: &str, method: &str, format: &str) -> Option<Verdict> {
    cell(scenario, method, format).verdict
}

const EXPM1: &str = "front-to-back/middle/expm1";
const SUBTRACTION: &str = "front-to-back/middle/subtraction";
const LINEAR: &str = "front-to-back/middle/linear";
const DEPTHS: &str = "front-to-back/middle/expm1/depths";
const NEUMAIER: &str = "front-to-back/middle/expm1/depths/neumaier";

#[test]
fn no_cell_is_silently_wrong() {
    let wrong: Vec<&Cell> = CELLS.iter().filter(|c| c.is_silently_wrong()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(CELLS.len() % (METHODS.len() * FORMATS.len()), 0);
}

/// A promise of nothing is kept by anything: in ordinary media there must be something to keep.
#[test]
fn ordinary_cells_are_promised_digits_and_have_no_verdict() {
    for method in METHODS {
        // Units of binary32 and binary64 are 10^−7.2 and 10^−15.95; n = 256 costs 2.4 digits and some.
        let subtraction = method == SUBTRACTION;
        for scenario in ["depth/1e0", "depth/1e2", "length/1e-10", "segments/256"] {
            for (format, least) in [("f32", 3.5), ("f64", 12.0)] {
                let cell = cell(scenario, method, format);
                assert_eq!(cell.verdict, None, "{cell:?}");
                assert!(cell.promised >= least, "{cell:?}");
            }
        }
        let thin = cell("depth/1e-4", method, "f32");
        assert!(subtraction || thin.promised > 3.5, "{thin:?}");
        // 1 − e^(−x) keeps nothing of x = 4e-7 in binary32 that could be promised.
        assert!(!subtraction || thin.promised < 1.0, "{thin:?}");
    }
}

/// The bound is of the worst case; it must not be a worst case of bounds.
#[test]
fn promises_are_not_far_below_what_is_reached() {
    let distance = |cell: &Cell| match (cell.verdict, cell.digits) {
        (None, Some(Digits::Of(digits))) if cell.promised > 0.0 => Some(digits - cell.promised),
        _ => None,
    };
    for method in METHODS {
        let of_method = CELLS.iter().filter(|cell| cell.method == method);
        let nearest = of_method.filter_map(distance).fold(f64::INFINITY, f64::min);
        println!("{method}: {nearest:.2} digits between promise and the worst cell");
        assert!((0.0..3.0).contains(&nearest), "{method}: {nearest}");
    }
}

/// The closed forms of Q_∞ against the method itself, run in MPFR.
#[test]
fn closed_forms_are_what_the_methods_give() {
    let others = [
        "front-to-back/back/linear/depths",
        "tree/front/linear",
        "back-to-front/middle/relative",
        "preintegrated/linear-by-3-trapezoid/linear-by-3-trapezoid",
    ];
    for (extinction, n) in [((1, 3), 6), ((40, 1), 8), ((700, 1), 10), ((1, 1 << 20), 4)] {
        let slab = HomogeneousSlab {
            length: Rational::from((7, 5)),
            extinction: extinction.into(),
            emission: Rational::from((5, 3)),
        };
        for name in METHODS.into_iter().chain(others) {
            let method: Method = name.parse().unwrap();
            let kind = Kind::of(&method).unwrap();
            let closed = exact(&Medium::Slab(slab.clone()), &method, kind, n).unwrap();
            let nodes = Fresh::new(&slab, Mpfr { bits: 300 });
            let run: Float = method.radiance(&nodes, n).unwrap().into();
            let error = Float::with_val(300, &run - &closed.approximation) / &run;
            let error = error.abs().to_f64();
            assert!(error < 1e-60, "{name} {extinction:?} {n}: {error:e}");
        }
    }
}

/// A watched format computes what the format computes.
#[test]
fn digits_are_those_of_plain_runs() {
    for scenario in scenarios(None, &[1, 2]) {
        if !["depth", "flat", "segments"].contains(&scenario.group) {
            continue;
        }
        for name in METHODS {
            let cell = cell(&scenario.name, name, "f32");
            let Some(Digits::Of(found)) = cell.digits else {
                continue;
            };
            let method: Method = name.parse().unwrap();
            let kind = Kind::of(&method).unwrap();
            let nodes = Fresh::new(&scenario.medium, Native::<f32>::new());
            let plain = method.radiance(&nodes, scenario.n).unwrap();
            let exact = exact(&scenario.medium, &method, kind, scenario.n).unwrap();
            let error = Float::with_val(400, plain - &exact.approximation) / exact.approximation;
            let digits = -error.abs().log10().to_f64();
            assert!((digits.max(0.0) - found).abs() < 1e-9, "{digits} {cell:?}");
        }
    }
}

#[test]
fn methods_without_a_bound_and_formats_without_ends_are_refused() {
    for name in [
        "riemann-left/trapezoid",
        "trapezoid/trapezoid/linear",
        "front-to-back/middle/expm1/stop=1:255",
        "preintegrated/quadratic/linear",
        "preintegrated/linear-by-300-trapezoid/linear-by-300-trapezoid",
    ] {
        let method: Method = name.parse().unwrap();
        assert!(Kind::of(&method).is_err(), "{name}");
    }
    let settings = Settings {
        scenarios: scenarios(None, &[1]),
        methods: vec![EXPM1.parse().unwrap()],
        formats: vec!["mpfr:100".parse().unwrap()],
    };
    assert!(run(&settings, &Silent).is_err());
}

/// x = 3/8·2⁻²⁴ is less than half a unit of 1: 1 − α is 1, so that T never falls, and e^(−x) is 1.
#[test]
fn binary32_stalls_at_two_to_the_24() {
    let long: Vec<Scenario> = scenarios(None, &[1 << 24])
        .into_iter()
        .filter(|scenario| scenario.group == "segments")
        .collect();
    let slow = grid(long.clone(), &[EXPM1], &["f16"]);
    assert_eq!(slow[0].verdict, Some(Verdict::LeftOut), "{:?}", slow[0]);
    let cells = grid(long, &[EXPM1, SUBTRACTION, NEUMAIER], &["f32"]);
    assert_eq!(cells[0].verdict, Some(Verdict::Stalled), "{:?}", cells[0]);
    assert_eq!(cells[1].verdict, Some(Verdict::Absorbed), "{:?}", cells[1]);
    assert_eq!(cells[2].verdict, None, "{:?}", cells[2]);
    let Some(Digits::Of(stalled)) = cells[0].digits else {
        panic!("{:?}", cells[0]);
    };
    // 3/8 instead of 1 − e^(−3/8) = 0.3127: T stayed 1.
    assert!(stalled < 1.0, "{stalled}");
    // What it keeps of the sums it sums naively.
    assert!(cells[2].digits.unwrap().reach(2.5), "{:?}", cells[2]);
    assert!(cells.iter().all(|cell| !cell.is_silently_wrong()));
}

#[test]
fn small_numbers_are_called_so() {
    use Verdict::{Absorbed, Underflow};
    // 1e-8/256 < u/2: e^(−x) is 1 in binary32, and not in binary64.
    assert_eq!(verdict("depth/1e-8", SUBTRACTION, "f32"), Some(Absorbed));
    assert_eq!(verdict("depth/1e-8", SUBTRACTION, "f64"), None);
    assert_eq!(verdict("depth/1e-8", EXPM1, "f32"), None);
    assert_eq!(verdict("depth/1e-30", SUBTRACTION, "f64"), Some(Absorbed));
    assert_eq!(verdict("depth/1e-30", EXPM1, "f64"), None);
    // Relative to 1 what is lost is no number of binary32.
    assert_eq!(verdict("depth/1e-300", SUBTRACTION, "f64"), Some(Absorbed));
    assert_eq!(verdict("depth/1e-30", EXPM1, "bf16"), None);
    for method in METHODS {
        // 1e-300 is no number of any format but binary64, where x and C α T are normal.
        for format in [
            "f16", "bf16", "f32", "tf32", "fp8-e4m3", "fixed:8", "fixed:15",
        ] {
            let verdict = verdict("depth/1e-300", method, format);
            assert_eq!(verdict, Some(Underflow), "{method} {format}");
        }
        assert_eq!(verdict("emission/1e-310", method, "f32"), Some(Underflow));
        assert_eq!(verdict("emission/1e-310", method, "f64"), Some(Underflow));
        assert_eq!(verdict("emission/1e-40", method, "f32"), Some(Underflow));
        assert_eq!(verdict("emission/1e-40", method, "f64"), None);
        assert_eq!(
            verdict("length/1e-30", method, "fixed:15"),
            Some(Verdict::Saturated)
        );
    }
    assert_eq!(verdict("depth/1e-300", EXPM1, "f64"), None);
}

#[test]
fn large_numbers_are_called_so() {
    for method in METHODS {
        assert_eq!(
            verdict("emission/1e6", method, "f16"),
            Some(Verdict::Overflow),
            "{method}"
        );
        assert_eq!(
            verdict("emission/1e6", method, "fp8-e4m3"),
            Some(Verdict::Overflow)
        );
        assert_eq!(
            verdict("emission/1e6", method, "fixed:8"),
            Some(Verdict::Saturated)
        );
        assert_eq!(
            verdict("emission/1e308", method, "f32"),
            Some(Verdict::Overflow)
        );
        // Linear opacities of thick segments are another matter, and so are series without end.
        if method != LINEAR && method != "preintegrated/linear/linear" {
            for format in ["f32", "f64", "bf16"] {
                let found = verdict("depth/1e10", method, format);
                assert_eq!(found, Some(Verdict::OracleUnderflow), "{method} {format}");
            }
        }
    }
    assert_eq!(verdict("emission/1e4", EXPM1, "f16"), None);
    assert_eq!(verdict("emission/1e308", EXPM1, "f64"), None);
    let refused = cell("depth/1e10", "preintegrated/linear/linear", "f64");
    assert_eq!(refused.verdict, Some(Verdict::Refused));
    assert!(refused.reason.as_ref().unwrap().contains("(allowed: "));
    // T = e^(−10⁴) underflows everywhere, and nobody is the worse for it.
    assert_eq!(verdict("depth/1e4", EXPM1, "f64"), None);
    assert!(cell("depth/1e4", EXPM1, "f64").digits.unwrap().reach(15.0));
}

#[test]
fn linear_opacities_of_thick_segments_are_called_so() {
    for format in ["f16", "bf16", "f32", "f64", "tf32"] {
        assert_eq!(
            verdict("step/3/2", LINEAR, format),
            Some(Verdict::NegativeTransmittance)
        );
        assert_eq!(
            verdict("step/5/2", LINEAR, format),
            Some(Verdict::Oscillating)
        );
        for method in [EXPM1, DEPTHS, "tree/middle/expm1"] {
            assert_eq!(
                verdict("step/5/2", method, format),
                None,
                "{method} {format}"
            );
        }
    }
}

#[test]
fn faulty_transfer_functions_are_called_so() {
    for format in ["f16", "bf16", "f32", "f64", "tf32"] {
        for method in [
            EXPM1,
            SUBTRACTION,
            "trapezoid/trapezoid",
            "tree/middle/expm1",
        ] {
            let of = |fault: &str| verdict(&format!("fault/{fault}"), method, format);
            assert_eq!(of("nan"), Some(Verdict::NotANumber), "{method}");
            assert_eq!(of("infinity"), Some(Verdict::Infinite), "{method}");
            assert_eq!(of("minus-infinity"), Some(Verdict::Infinite), "{method}");
            let negative = [Verdict::NegativeRadiance, Verdict::NegativeMedium];
            for fault in ["negative-tau", "negative-c"] {
                let found = of(fault).unwrap();
                assert!(negative.contains(&found), "{method} {fault}: {found}");
            }
        }
    }
    assert_eq!(
        verdict("fault/nan", EXPM1, "fixed:15"),
        Some(Verdict::NotANumber)
    );
    assert_eq!(
        verdict("fault/infinity", EXPM1, "fixed:15"),
        Some(Verdict::Infinite)
    );
}

#[test]
fn vacuum_is_exact_and_a_missed_spike_has_no_digit_of_the_radiance() {
    for method in METHODS {
        for format in FORMATS {
            let vacuum = cell("vacuum/all", method, format);
            assert_eq!(vacuum.digits, Some(Digits::Exact), "{vacuum:?}");
            assert_eq!(vacuum.verdict, None, "{vacuum:?}");
        }
        let missed = cell("spike/missed", method, "f64");
        if missed.verdict.is_none() {
            assert_eq!(missed.digits, Some(Digits::Exact), "{missed:?}");
            assert_eq!(missed.against_radiance, Some(Digits::Of(0.0)), "{missed:?}");
        }
    }
    // A jump at 3/10 and nodes at sixteenths cannot be told apart in 4 bits.
    let found = verdict("vacuum/part", EXPM1, "fp8-e4m3");
    assert_eq!(found, Some(Verdict::BranchDiverged));
    // s at the front and at the back of a segment are the same number of binary32.
    let flat = cell("flat/2^-30", "preintegrated/linear/linear", "f32");
    assert!(
        flat.verdict.is_none() && flat.digits.unwrap().reach(5.0),
        "{flat:?}"
    );
}

#[test]
fn every_verdict_occurs() {
    let found: BTreeSet<Verdict> = CELLS.iter().filter_map(|cell| cell.verdict).collect();
    let missing: Vec<Verdict> = Verdict::ALL
        .into_iter()
        .filter(|verdict| !found.contains(verdict))
        // Those of rays of 2²⁴ segments.
        .filter(|verdict| ![Verdict::LeftOut, Verdict::Stalled].contains(verdict))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn the_verdicts() {
    let mut lines: Vec<String> = vec![format!("formats: {}", FORMATS.join(" "))];
    for row in CELLS.chunks(FORMATS.len()) {
        let said = row.iter().map(|cell| match cell.verdict {
            Some(verdict) => verdict.code().to_string(),
            None => format!("{:.0}", cell.promised.floor()),
        });
        let said: Vec<String> = said.collect();
        let head = &row[0];
        lines.push(format!(
            "{} {}: {}",
            head.scenario,
            head.method,
            said.join(" ")
        ));
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("stress_verdicts", lines.join("\n")));
}

fn volver(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.arg("stress").args(arguments);
    command
}

#[test]
fn the_command_prints_tables_and_writes_its_files() {
    let parent = tempfile::tempdir().unwrap();
    let directory = parent.path().join("new");
    let file = parent.path().join("cells.json");
    let output = volver(&[
        "--scenarios",
        "depth,spike/hit",
        "--formats",
        "f16,ieee:24,-126,127,f64",
    ])
    .args([
        "--methods",
        "tree/middle/expm1,trapezoid/trapezoid",
        "--out",
    ])
    .arg(&directory)
    .arg("--json")
    .arg(&file)
    .assert()
    .code(0)
    .stderr("")
    .get_output()
    .stdout
    .clone();
    let text = String::from_utf8(output).unwrap();
    assert!(text.contains("60 cells: "), "{text}");
    assert!(text.contains(" 0 are silently wrong"), "{text}");
    assert!(
        text.lines()
            .all(|line| line.chars().count() <= 80 || line.contains("files in")),
        "{text}"
    );
    let written = std::fs::read_to_string(&file).unwrap();
    let document: serde_json::Value = serde_json::from_str(&written).unwrap();
    assert_eq!(document["cells"].as_array().unwrap().len(), 60);
    assert_eq!(document["silently_wrong"], 0);
    let twin = std::fs::read_to_string(directory.join("stress.json")).unwrap();
    assert_eq!(twin, written);
    let map = std::fs::read_to_string(directory.join("stress.svg")).unwrap();
    assert!(map.starts_with("<svg ") && map.contains("spike/hit"));
    assert!(directory.join("stress.md").exists());
}

#[test]
fn what_cannot_be_run_is_named_in_one_line() {
    for (arguments, message) in [
        (
            &["--scenarios", "deep"][..],
            "unknown scenario 'deep' (allowed: depth, ",
        ),
        (
            &["--scenarios", "spike/no"],
            "unknown scenario 'spike/no' (allowed: spike/missed, spike/hit)",
        ),
        (
            &["--methods", "boole/boole"],
            "method 'boole/boole': no bound of its roundoff is known (allowed: ",
        ),
        (
            &["--formats", "mpfr:99"],
            "format 'mpfr:99': there is nothing to stress (allowed: ",
        ),
        (&["--levels", "0.5,0.25"], "is not allowed (allowed: 1 to "),
        (&["-n", "0"], "invalid value '0' for '--segments <N>'"),
    ] {
        volver(arguments)
            .assert()
            .code(2)
            .stdout("")
            .stderr(predicate::str::contains(message))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
}

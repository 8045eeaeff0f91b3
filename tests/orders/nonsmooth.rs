//! What jumps and kinks cost comes out as theory says.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use std::sync::LazyLock;
use volver::convergence::Verdict;
use volver::method::Expected;
use volver::study::Silent;
use volver::study::nonsmooth::{Cell, Kind, Place, measure};

static CELLS: LazyLock<Vec<Cell>> = LazyLock::new(|| measure(&Silent).unwrap());

/// By hand, independent of the crate's theory: rules, then the orders on a node, off the nodes, moving.
const JUMP: [(&str, [f64; 3]); 6] = [
    ("riemann", [1.0, 1.0, 1.0]),
    // Never looks at the node.
    ("midpoint", [2.0, 1.0, 1.0]),
    ("trapezoid", [1.0, 1.0, 1.0]),
    ("simpson", [1.0, 1.0, 1.0]),
    ("boole", [1.0, 1.0, 1.0]),
    ("gauss-3", [6.0, 1.0, 1.0]),
];
const KINK: [(&str, [f64; 3]); 6] = [
    ("riemann", [1.0, 1.0, 1.0]),
    ("midpoint", [2.0, 2.0, 2.0]),
    ("trapezoid", [2.0, 2.0, 2.0]),
    // 4/6·1/6 + 1/6·2/3 = 2/9 = (2/3)²/2: exact for a corner at a third.
    ("simpson", [4.0, 3.0, 2.0]),
    ("boole", [6.0, 2.0, 2.0]),
    ("gauss-3", [6.0, 2.0, 2.0]),
];

fn cell(kind: Kind, rule: &str, place: Place) -> &'static Cell {
    CELLS
        .iter()
        .find(|cell| cell.kind == kind && cell.rule == rule && cell.place == place)
        .unwrap_or_else(|| panic!("no cell {kind:?} {rule} {place:?}"))
}

#[test]
fn orders_are_those_worked_out_by_hand_and_theory_agrees() {
    assert_eq!(CELLS.len(), 36);
    for (kind, table) in [(Kind::Jump, JUMP), (Kind::Kink, KINK)] {
        for (rule, orders) in table {
            for (place, order) in Place::ALL.into_iter().zip(orders) {
                let cell = cell(kind, rule, place);
                let said = format!("{kind:?} {rule} {place:?}: {:?}", cell.measured);
                assert_eq!(cell.theory, Expected::Order(order), "{said}");
                let measured = cell.measured.order.unwrap();
                assert!((measured - order).abs() < 0.15, "{said}");
                assert_eq!(cell.measured.verdict, Verdict::Confirmed, "{said}");
                assert!(!cell.contradicts_theory());
            }
        }
    }
}

#[test]
fn no_place_gives_less_than_what_is_guaranteed() {
    for cell in CELLS.iter() {
        let own = match cell.rule {
            "riemann" => 1.0_f64,
            _ => 2.0,
        };
        let guaranteed = own.min(if cell.kind == Kind::Jump { 1.0 } else { 2.0 });
        assert_eq!(cell.guaranteed, Expected::Order(guaranteed), "{cell:?}");
    }
}

#[test]
fn doublings_do_not_see_the_orders_at_a_moving_place() {
    let usual = |kind, place| {
        let rules = ["trapezoid", "simpson", "boole", "gauss-3"];
        rules.map(|rule| cell(kind, rule, place).usual.verdict)
    };
    for kind in Kind::ALL {
        let verdicts = usual(kind, Place::Moving);
        assert!(!verdicts.contains(&Verdict::Confirmed), "{verdicts:?}");
        let verdicts = usual(kind, Place::OnNode);
        assert_eq!(verdicts, [Verdict::Confirmed; 4]);
    }
}

#[test]
fn the_table_of_orders() {
    let lines: Vec<String> = CELLS
        .iter()
        .map(|c| {
            format!(
                "{:?} {} {:?}: theory {:?} guaranteed {:?} order {:.2} {}, doublings {:.2} {}",
                c.kind,
                c.rule,
                c.place,
                c.theory,
                c.guaranteed,
                c.measured.order.unwrap_or(f64::NAN),
                c.measured.verdict,
                c.usual.order.unwrap_or(f64::NAN),
                c.usual.verdict,
            )
        })
        .collect();
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("nonsmooth_orders", lines.join("\n")));
}

fn volver(arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.args(["reproduce", "--nonsmooth"]).args(arguments);
    command
}

/// What the program prints and writes. It takes as long as all other tests of it, so that it runs once.
pub(crate) struct Told {
    pub(crate) text: String,
    json: String,
    twin: String,
    has_report: bool,
}

pub(crate) static TOLD: LazyLock<Told> = LazyLock::new(|| {
    let parent = tempfile::tempdir().unwrap();
    let directory = parent.path().join("new");
    let file = parent.path().join("cells.json");
    let mut command = volver(&["--out"]);
    command.arg(&directory).arg("--json").arg(&file);
    let output = command.assert().code(0).stderr("");
    Told {
        text: String::from_utf8(output.get_output().stdout.clone()).unwrap(),
        json: std::fs::read_to_string(&file).unwrap(),
        twin: std::fs::read_to_string(directory.join("nonsmooth.json")).unwrap(),
        has_report: directory.join("nonsmooth.md").exists(),
    }
});

#[test]
fn the_command_prints_the_table_and_writes_its_files() {
    let Told { text, json, .. } = &*TOLD;
    assert!(text.contains("36 cells: 36 agree with theory"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let document: serde_json::Value = serde_json::from_str(json).unwrap();
    assert_eq!(document["cells"].as_array().unwrap().len(), 36);
    assert_eq!(TOLD.twin, *json);
    assert!(TOLD.has_report);
}

#[test]
fn options_of_the_tables_do_not_go_with_it() {
    for option in [
        ["--table", "1"],
        ["--inner", "simpson"],
        ["--outer", "boole"],
        ["--format", "f32"],
        ["--levels", "8..256"],
        ["--seed", "2"],
    ] {
        volver(&option)
            .assert()
            .code(2)
            .stdout("")
            .stderr(predicate::str::contains("--nonsmooth"))
            .stderr(predicate::str::contains("(allowed: "))
            .stderr(predicate::function(|text: &str| text.lines().count() == 1));
    }
}

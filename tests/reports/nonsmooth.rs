//! The table of jumps and kinks as a document.

use super::markdown::is_regular;
use super::{about, without_color};
use volver::convergence::{Verdict, fit};
use volver::method::Expected;
use volver::render::{markdown, terminal};
use volver::report::nonsmooth::{document, json};
use volver::study::nonsmooth::{Cell, Kind, Measured, Place};

fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for kind in Kind::ALL {
        for place in Place::ALL {
            cells.push(Cell {
                kind,
                place,
                rule: "trapezoid",
                method: "trapezoid × trapezoid".into(),
                theory: Expected::Order(2.0),
                guaranteed: Expected::Order(1.0),
                measured: Measured {
                    order: Some(2.0123),
                    half_width: Some(0.0201),
                    verdict: Verdict::Confirmed,
                },
                levels: Vec::new(),
                usual: fit(&[], None).unwrap(),
            });
        }
    }
    cells
}

fn text(cells: &[Cell], width: usize) -> String {
    terminal(&document(cells, &about()), width, false)
}

#[test]
fn a_cell_shows_order_theory_and_the_usual_verdict() {
    let wide = text(&cells(), 120);
    let (cell, usual) = ("2.012 ± 0.020 [2]", "doublings: - TooFewLevels");
    let [order, below] = [cell, usual].map(|part| format!("  {part:>25}").repeat(3));
    let line = format!("\n  trapezoid{order}\n           {below}\n");
    assert_eq!(wide.matches(&line).count(), 2, "{wide}");
    assert!(wide.ends_with("\n6 cells: 6 agree with theory\n"), "{wide}");
    let narrow = text(&cells(), 80);
    for part in [cell, usual] {
        assert_eq!(narrow.matches(part).count(), 6, "{narrow}");
    }
    assert!(
        narrow.lines().all(|line| line.chars().count() <= 80),
        "{narrow}"
    );
}

#[test]
fn what_contradicts_theory_is_said() {
    let mut cells = cells();
    cells[1].measured.verdict = Verdict::TooHigh;
    let said = "trapezoid, jump of the extinction off the nodes (D/3): 2.012 ± 0.020 where theory says 2 (TooHigh)";
    let text = text(&cells, 120);
    assert!(text.contains(&format!("! {said}\n")), "{text}");
    assert!(text.ends_with("6 cells: 5 agree with theory, 1 contradict it\n"));
    let markdown = markdown(&document(&cells, &about()));
    assert!(markdown.contains(&format!("- **{said}**\n")), "{markdown}");
}

#[test]
fn every_form_has_every_cell() {
    let cells = cells();
    let markdown = markdown(&document(&cells, &about()));
    let entry = "2.012 ± 0.020 \\[2\\]<br>doublings: - TooFewLevels";
    let row = format!("| trapezoid | {entry} | {entry} | {entry} |\n");
    assert_eq!(markdown.matches(&row).count(), 2, "{markdown}");
    is_regular(&markdown);
    let document: serde_json::Value = serde_json::from_str(&json(&cells).unwrap()).unwrap();
    assert_eq!(document["cells"].as_array().unwrap().len(), 6);
    assert_eq!(document["cells"][0]["guaranteed_order"], 1.0);
}

#[test]
fn color_adds_escapes_and_nothing_else() {
    let colored = terminal(&document(&cells(), &about()), 80, true);
    assert!(colored.contains("\u{1b}[32m2.012"), "{colored}");
    assert_eq!(without_color(&colored), text(&cells(), 80));
}

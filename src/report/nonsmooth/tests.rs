use super::{json, markdown, text};
use crate::convergence::{Verdict, fit};
use crate::method::Expected;
use crate::study::nonsmooth::{Cell, Kind, Measured, Place};

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

#[test]
fn a_cell_shows_order_theory_and_the_usual_verdict() {
    let text = text(&cells(), 80, false);
    let cell = "2.012 ± 0.020 [2]     ";
    let line = format!("trapezoid  {cell}{cell}{}\n", cell.trim_end());
    assert!(text.contains(&line), "{text}");
    assert!(
        text.contains("\n doublings - TooFewLevels        - TooFew"),
        "{text}"
    );
    assert!(text.ends_with("\n6 cells: 6 agree with theory\n"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn what_contradicts_theory_is_said() {
    let mut cells = cells();
    cells[1].measured.verdict = Verdict::TooHigh;
    let said = "trapezoid, jump of the extinction off the nodes (D/3): 2.012 ± 0.020 where theory says 2 (TooHigh)";
    let text = text(&cells, 120, false);
    assert!(text.contains(&format!("! {said}\n")), "{text}");
    assert!(text.ends_with("6 cells: 5 agree with theory, 1 contradict it\n"));
    let markdown = markdown(&cells);
    assert!(markdown.contains(&format!("- **{said}**\n")), "{markdown}");
}

#[test]
fn documents_have_every_cell() {
    let cells = cells();
    let markdown = markdown(&cells);
    let entry = "2.012 ± 0.020 \\[2\\]<br>doublings: - TooFewLevels";
    let row = format!("| **trapezoid** | {entry} | {entry} | {entry} |\n");
    assert_eq!(markdown.matches(&row).count(), 2, "{markdown}");
    let document: serde_json::Value = serde_json::from_str(&json(&cells).unwrap()).unwrap();
    assert_eq!(document["cells"].as_array().unwrap().len(), 6);
    assert_eq!(document["cells"][0]["guaranteed_order"], 1.0);
}

#[test]
fn color_adds_escapes_and_nothing_else() {
    let mut plain = text(&cells(), 80, true);
    assert!(plain.contains("\u{1b}[32m2.012"), "{plain}");
    for code in [0, 1, 2, 31, 32, 33] {
        plain = plain.replace(&format!("\u{1b}[{code}m"), "");
    }
    assert_eq!(plain, text(&cells(), 80, false));
}

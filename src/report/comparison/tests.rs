//! What differs between two small reports.

use super::*;
use crate::document::Kind;

fn part(name: &str, rows: &[(&str, f64, Tone)]) -> Part {
    let mut page = Document::new("study", "Trial", About::new(["volver"]));
    let mut table = Table::new(
        "Orders",
        [
            Column::text("method"),
            Column::number("order"),
            Column::logarithm("best"),
            Column::verdict("verdict"),
        ],
    );
    for (method, order, tone) in rows {
        let verdict = if *tone == Tone::Good {
            "Confirmed"
        } else {
            "TooLow"
        };
        table.rows.push(vec![
            Cell::text(*method),
            Cell::number(format!("{order:.3}"), *order),
            Cell::number("1e-400", -400.0 * order),
            Cell::verdict(verdict, *tone),
        ]);
    }
    let mut section = Section::new("orders", "Orders");
    section.blocks.push(Block::Table(table));
    page.sections.push(section);
    Part {
        name: name.into(),
        page,
    }
}

fn compared(before: &[(&str, f64, Tone)], now: &[(&str, f64, Tone)]) -> Comparison {
    compare(&[part("a", before), part("b", now)], About::new(["volver"]))
}

fn table(comparison: &Comparison) -> Option<&Table> {
    let section = comparison
        .page
        .sections
        .iter()
        .find(|section| section.title == "What differs")?;
    section.blocks.iter().find_map(|block| match block {
        Block::Table(table) => Some(table),
        _ => None,
    })
}

#[test]
fn the_same_report_twice_differs_nowhere() {
    let rows = [("trapezoid", 2.0, Tone::Good), ("simpson", 4.0, Tone::Good)];
    let same = compared(&rows, &rows);
    assert_eq!((same.cells, same.verdicts, same.others), (6, 0, 0));
    assert_eq!(table(&same), None);
    assert_eq!(same.page.summary[0].tone, Some(Tone::Good));
}

#[test]
fn what_differs_is_listed_with_its_amount_whatever_the_order_of_rows() {
    let before = [
        ("trapezoid", 2.0, Tone::Good),
        ("simpson", 4.0, Tone::Good),
        ("gone", 1.0, Tone::Good),
    ];
    let now = [
        ("simpson", 3.5, Tone::Bad),
        ("trapezoid", 2.0, Tone::Good),
        ("new", 1.0, Tone::Good),
    ];
    let found = compared(&before, &now);
    assert_eq!((found.cells, found.verdicts, found.others), (6, 1, 1));
    let rows: Vec<Vec<&str>> = table(&found)
        .unwrap()
        .rows
        .iter()
        .map(|row| row.iter().map(|cell| cell.text.as_str()).collect())
        .collect();
    assert_eq!(
        rows,
        [
            vec!["simpson", "order", "4.000", "3.500", "−0.5"],
            vec!["simpson", "verdict", "Confirmed", "TooLow", "worse"],
        ]
    );
    assert_eq!(found.page.summary[0].tone, Some(Tone::Bad));
}

#[test]
fn reports_of_other_kinds_are_not_compared_but_kept() {
    let rows = [("trapezoid", 2.0, Tone::Good)];
    let mut other = part("b", &rows);
    other.page.kind = "verify".into();
    let found = compare(&[part("a", &rows), other], About::new(["volver"]));
    assert_eq!(found.cells, 0);
    let titles: Vec<&str> = found
        .page
        .sections
        .iter()
        .map(|s| s.title.as_str())
        .collect();
    assert_eq!(
        titles,
        [
            "Side by side",
            "What differs",
            "a: Trial",
            "a · Orders",
            "b: Trial",
            "b · Orders"
        ]
    );
}

#[test]
fn logarithms_are_compared_by_their_ratio() {
    let cell = |text: &str, sort: f64| Cell::number(text, sort);
    let ratio = cells::change(
        &cell("1e-400", -400.0),
        &cell("2e-400", -399.699),
        Kind::Logarithm,
    );
    assert_eq!(ratio.unwrap().text, "× 2");
    let other = cells::change(&cell("x", f64::NAN), &cell("y", 1.0), Kind::Number);
    assert_eq!(other.unwrap().text, "other");
}

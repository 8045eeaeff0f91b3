//! What differs between two small reports.

use super::about;
use volver::document::{
    Block, Cell, Column, Conclusion, Document, Fact, Medium, Section, Table, Tone,
};
use volver::report::comparison::{Comparison, Part, compare};

fn part(name: &str, table: Table) -> Part {
    let mut page = Document::new("study", "Trial", about());
    let section = Section::of("orders", "Orders", [Block::Table(table)]);
    page.sections.push(section);
    Part {
        name: name.into(),
        page,
    }
}

fn orders(rows: &[(&str, f64, Tone)]) -> Table {
    let columns = [
        Column::text("method"),
        Column::number("order"),
        Column::logarithm("best"),
        Column::verdict("verdict"),
    ];
    let rows = rows.iter().map(|(method, order, tone)| {
        let verdict = if *tone == Tone::Good {
            "Confirmed"
        } else {
            "TooLow"
        };
        vec![
            Cell::text(*method),
            Cell::number(format!("{order:.3}"), *order),
            Cell::number("1e-400", -400.0 * order),
            Cell::verdict(verdict, *tone),
        ]
    });
    Table::new("Orders", columns).with(rows)
}

fn compared(before: Table, now: Table) -> Comparison {
    compare(&[part("a", before), part("b", now)], about())
}

fn section<'a>(comparison: &'a Comparison, title: &str) -> &'a Section {
    let mut sections = comparison.page.sections.iter();
    sections.find(|section| section.title == title).unwrap()
}

/// The rows of the first table under a heading; none where there is no table.
fn rows(comparison: &Comparison, title: &str) -> Vec<Vec<String>> {
    let blocks = &section(comparison, title).blocks;
    let table = blocks.iter().find_map(|block| match block {
        Block::Table(table) => Some(table),
        _ => None,
    });
    let rows = table.into_iter().flat_map(|table| &table.rows);
    rows.map(|row| row.iter().map(|cell| cell.text.clone()).collect())
        .collect()
}

fn differing(comparison: &Comparison) -> Vec<Vec<String>> {
    rows(comparison, "What differs")
}

#[test]
fn the_same_report_twice_differs_nowhere() {
    let rows = [("trapezoid", 2.0, Tone::Good), ("simpson", 4.0, Tone::Good)];
    let same = compared(orders(&rows), orders(&rows));
    assert_eq!((same.cells, same.verdicts, same.others), (6, 0, 0));
    assert!(differing(&same).is_empty());
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
    let found = compared(orders(&before), orders(&now));
    assert_eq!((found.cells, found.verdicts, found.others), (6, 1, 1));
    assert_eq!(
        differing(&found),
        [
            vec!["simpson", "order", "4.000", "3.500", "−0.5"],
            vec!["simpson", "verdict", "Confirmed", "TooLow", "worse"],
        ]
    );
    assert_eq!(found.page.summary[0].tone, Some(Tone::Bad));
}

#[test]
fn rows_are_named_by_their_groups_too() {
    let table = |rows: [(&str, &str, f64); 3]| {
        let columns = [
            Column::text("case").grouping(),
            Column::text("inner").grouping(),
            Column::text("outer"),
            Column::number("order"),
        ];
        let row = |(inner, outer, order): (&str, &str, f64)| {
            let names = ["sine-squared", inner, outer].map(Cell::text);
            let order = Cell::number(format!("{order}"), order);
            names.into_iter().chain([order]).collect()
        };
        Table::new("Orders", columns).with(rows.map(row))
    };
    let found = compared(
        table([
            ("simpson", "boole", 4.0),
            ("gauss-3", "boole", 6.0),
            ("simpson", "riemann", 1.0),
        ]),
        table([
            ("gauss-3", "boole", 6.0),
            ("simpson", "boole", 3.0),
            ("simpson", "riemann", 1.0),
        ]),
    );
    assert_eq!((found.cells, found.others), (3, 1));
    let expected = vec!["sine-squared, simpson, boole", "order", "4", "3", "−1"];
    assert_eq!(differing(&found), [expected]);
}

#[test]
fn tables_are_compared_that_a_page_shows() {
    let of = |order, medium| {
        let mut part = part("a", orders(&[("trapezoid", 2.0, Tone::Good)]));
        let table = Block::Table(orders(&[("trapezoid", order, Tone::Good)]));
        part.page.sections[0].blocks = vec![table.only(medium)];
        part
    };
    for (medium, cells) in [
        (Medium::Written, 3),
        (Medium::Page, 3),
        (Medium::Terminal, 0),
        (Medium::Csv, 0),
    ] {
        let found = compare(&[of(2.0, medium), of(2.0, medium)], about());
        assert_eq!(found.cells, cells, "{medium:?}");
    }
}

#[test]
fn reports_of_other_kinds_are_not_compared_but_kept() {
    let rows = [("trapezoid", 2.0, Tone::Good)];
    let mut other = part("b", orders(&rows));
    other.page.kind = "verify".into();
    let found = compare(&[part("a", orders(&rows)), other], about());
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
    let table = |best: (&str, f64), order: (&str, f64)| {
        let columns = [
            Column::text("method"),
            Column::logarithm("best"),
            Column::number("order"),
        ];
        let row = vec![
            Cell::text("m"),
            Cell::number(best.0, best.1),
            Cell::number(order.0, order.1),
        ];
        Table::new("t", columns).with([row])
    };
    let found = compared(
        table(("1e-400", -400.0), ("x", f64::NAN)),
        table(("2e-400", -399.699), ("y", 1.0)),
    );
    assert_eq!(
        differing(&found),
        [
            vec!["m", "best", "1e-400", "2e-400", "× 2"],
            vec!["m", "order", "x", "y", "other"],
        ]
    );
}

#[test]
fn each_says_what_came_out_in_its_own_words() {
    let mut parts = ["a", "b"].map(|name| part(name, orders(&[])));
    parts[0].page.summary = vec![Fact::new("seed", "of a fact").toned(Tone::Bad)];
    parts[1].page.conclusion = Some(Conclusion::new("1 line").toned(Tone::Good));
    parts[1].page.about.seeds = vec![1, 2];
    let found = compare(&parts, about());
    let said = rows(&found, "Side by side");
    let row = |index: usize| said[index].iter().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(row(0), ["report", "Trial", "Trial"]);
    assert_eq!(row(3), ["seed", "", "1, 2"]);
    // A fact of a report is told from what every report has.
    assert_eq!(row(5), ["seed", "of a fact", ""]);
    assert_eq!(row(6), ["conclusion", "", "1 line"]);
    let Block::Finding(finding) = &section(&found, "b: Trial").blocks[0] else {
        panic!("a report begins with its conclusion");
    };
    assert_eq!(
        (&*finding.words, finding.tone),
        ("1 line", Some(Tone::Good))
    );
}

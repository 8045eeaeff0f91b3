//! The tables of a document for programs.

use super::document;
use volver::document::{Block, Cell, Column, Medium, Table};
use volver::render::csv;

fn table(caption: &str) -> Table {
    let columns = [Column::text("name"), Column::number("n").detail()];
    let row = vec![Cell::text(caption), Cell::number("1", 1.0)];
    Table::new(caption, columns).with([row])
}

#[test]
fn every_table_that_all_see_has_a_file() {
    let other = Block::Table(table("other")).only(Medium::Terminal);
    let tables = csv(&document([
        Block::Table(table("a")),
        other,
        Block::Table(table("b")).only(Medium::Written),
        Block::Table(table("c").named("runs")),
        Block::Text("words".into()),
    ]));
    let file = |stem: &str, name| (stem.to_string(), format!("name,n\n{name},1\n"));
    let expected = [file("trial", "a"), file("trial-2", "b"), file("runs", "c")];
    assert_eq!(tables.unwrap(), expected);
    assert!(csv(&document([])).unwrap().is_empty());
}

#[test]
fn tables_for_programs_stand_for_all_others() {
    let own = Block::Table(table("own").named("runs")).only(Medium::Csv);
    let words = Block::Text("words".into()).only(Medium::Csv);
    let tables = csv(&document([Block::Table(table("other")), words, own])).unwrap();
    assert_eq!(
        tables,
        [("runs".to_string(), "name,n\nown,1\n".to_string())]
    );
}

#[test]
fn cells_are_quoted_where_they_have_to_be_and_rows_are_complete() {
    let columns = [Column::text("a,b"), Column::text("c"), Column::number("d")];
    let rows = [
        vec![Cell::text("say \"x\""), Cell::text("two\nlines")],
        vec![Cell::text("1"); 4],
    ];
    let tables = csv(&document([Block::Table(
        Table::new("t", columns).with(rows),
    )]))
    .unwrap();
    let expected = "\"a,b\",c,d\n\"say \"\"x\"\"\",\"two\nlines\",\n1,1,1\n";
    assert_eq!(tables, [("trial".to_string(), expected.to_string())]);
}

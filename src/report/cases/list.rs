//! The list of cases: a row a channel.

use super::{Derived, decimal, value};
use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Section, Table, Tone,
};
use crate::reference::ReferenceError;
use rug::Float;
use std::collections::BTreeSet;

/// Cases, each with its depth and radiance, what of its statements is open, and its tags; `wanted` are the tags that chose
/// them.
#[must_use]
pub fn list(derived: &[Derived], wanted: &[String], about: &About) -> Document {
    let mut document = Document::new("cases", "Cases with an exact radiance", about.clone());
    if derived.is_empty() {
        let words = format!("no case has all of these tags: {}", wanted.join(", "));
        document.conclusion = Some(Conclusion::new(words));
        return document;
    }
    let channels = || derived.iter().flat_map(|derived| &derived.cases);
    let proved = channels().filter(|case| open(case).is_empty()).count();
    document.conclusion = Some(Conclusion::new(format!(
        "{} cases, {} channels; every statement is proved for {proved}",
        derived.len(),
        channels().count(),
    )));
    let all = derived.iter().flat_map(|derived| &derived.description.tags);
    let all: BTreeSet<&str> = all.map(String::as_str).collect();
    let all: Vec<&str> = all.into_iter().collect();
    let tags = Block::Facts(vec![Fact::new("tags", all.join(", "))]);
    document.sections = vec![
        Section::of("cases", "", [Block::Table(table(derived))]),
        Section::of("tags", "", [tags]),
    ];
    document
}

fn table(derived: &[Derived]) -> Table {
    let columns = [
        Column::text("case"),
        Column::number("D"),
        Column::number("t(D)"),
        Column::number("I(D)"),
        Column::verdict("state"),
        Column::text("tags").brief(),
        Column::text("open").below(),
    ];
    let count = |tag: &String| {
        let tags = derived.iter().map(|derived| &derived.description.tags);
        tags.filter(|tags| tags.contains(tag)).count()
    };
    let rows = derived.iter().flat_map(|derived| {
        // The rarest and so the most telling first: what does not fit is cut.
        let mut tags = derived.description.tags.clone();
        tags.sort_by_key(count);
        let tags = tags.join(", ");
        let row = move |case| row(case, &tags);
        derived.cases.iter().map(row)
    });
    Table::new(
        "Depth and radiance at the far end of the ray, and whether their closed form is proved",
        columns,
    )
    .with(rows)
}

fn row(case: &Manufactured, tags: &str) -> Vec<Cell> {
    let (state, tone) = match (case.has_closed_form(), case.is_proved()) {
        (false, _) => ("by reference", Tone::Open),
        (true, true) => ("proved", Tone::Good),
        (true, false) => ("open", Tone::Open),
    };
    let length = case.case.length();
    vec![
        Cell::text(case.case.name()),
        Cell::number(value::rational(&length), length.to_f64()),
        number(value::total_depth(case)),
        number(value::radiance(case)),
        Cell::verdict(state, tone),
        Cell::text(tags),
        match open(case).join("\n") {
            none if none.is_empty() => Cell::default(),
            open => Cell::text(open).toned(Tone::Open),
        },
    ]
}

/// What is not proved.
fn open(case: &Manufactured) -> Vec<String> {
    case.unproved().iter().map(ToString::to_string).collect()
}

fn number(value: Result<Float, ReferenceError>) -> Cell {
    match value {
        Ok(value) => Cell::number(decimal(&value), value.to_f64()),
        Err(_) => Cell::text("-"),
    }
}

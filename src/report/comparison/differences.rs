//! Which cells of which tables differ.

use super::Part;
use super::cells::{Placed, change, placed};
use crate::document::{Block, Cell, Column, Medium, Table, Tone};
use std::collections::HashMap;

/// What differs between reports.
#[derive(Debug, Default)]
pub(super) struct Differences {
    /// A table for each that has cells that differ.
    pub(super) tables: Vec<Table>,
    /// Cells that stand in more than one report.
    pub(super) cells: usize,
    /// Verdicts among them that differ.
    pub(super) verdicts: usize,
    /// Verdicts that are worse than in the first report.
    pub(super) worse: usize,
    /// Other cells that differ.
    pub(super) others: usize,
}

/// A table where it stands: kind of report, heading, table.
type Place<'a> = (&'a str, &'a str, &'a str);

pub(super) fn differences(parts: &[Part]) -> Differences {
    let mut found = Differences::default();
    let mut places: Vec<Place<'_>> = Vec::new();
    for (place, _) in parts.iter().flat_map(tables) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    for place in places {
        let holders: Vec<(&Part, &Table)> = parts
            .iter()
            .filter_map(|part| {
                let (_, table) = tables(part).find(|(here, _)| *here == place)?;
                Some((part, table))
            })
            .collect();
        if let [first, others @ ..] = &holders[..]
            && !others.is_empty()
        {
            found.add(place, first, others);
        }
    }
    found
}

/// The tables that a page shows.
fn tables(part: &Part) -> impl Iterator<Item = (Place<'_>, &Table)> {
    let sections = part.page.shown_in(&[Medium::Written, Medium::Page]);
    sections.into_iter().flat_map(|(section, blocks)| {
        blocks.into_iter().filter_map(|block| match block {
            Block::Table(table) => {
                let place = (&*part.page.kind, &*section.title, &*table.caption);
                Some((place, table))
            }
            _ => None,
        })
    })
}

impl Differences {
    fn add(
        &mut self,
        (_, heading, caption): Place<'_>,
        first: &(&Part, &Table),
        others: &[(&Part, &Table)],
    ) {
        let mut columns = vec![Column::text("row"), Column::text("column")];
        columns.push(Column::text(&first.0.name));
        for (part, _) in others {
            columns.push(Column::text(&part.name));
            columns.push(Column::verdict("change"));
        }
        let mut table = Table::new(format!("{heading}: {caption}"), columns);
        let theirs: Vec<HashMap<_, &Cell>> = others
            .iter()
            .map(|(_, table)| {
                placed(table)
                    .map(|other| ((other.row, other.column), other.cell))
                    .collect()
            })
            .collect();
        for Placed {
            row,
            column,
            kind,
            cell,
        } in placed(first.1)
        {
            let mut shown = vec![Cell::text(&row.0), Cell::text(&column.0), plain(cell)];
            let key = (row, column);
            let mut differs = false;
            for cells in &theirs {
                let Some(other) = cells.get(&key) else {
                    shown.extend([Cell::text("not there"), Cell::default()]);
                    continue;
                };
                self.cells += 1;
                let change = change(cell, other, kind);
                if change.is_some() {
                    differs = true;
                    self.count(cell, other);
                }
                shown.extend([plain(other), change.unwrap_or_default()]);
            }
            if differs {
                table.rows.push(shown);
            }
        }
        if !table.rows.is_empty() {
            self.tables.push(table);
        }
    }

    fn count(&mut self, before: &Cell, now: &Cell) {
        let is_verdict =
            before.tone != now.tone || (before.tone.is_some() && before.sort.is_none());
        if is_verdict {
            self.verdicts += 1;
            self.worse += usize::from(is_worse(before.tone, now.tone));
        } else {
            self.others += 1;
        }
    }
}

fn is_worse(before: Option<Tone>, now: Option<Tone>) -> bool {
    before.zip(now).is_some_and(|(before, now)| now < before)
}

/// Without the colour of a map.
fn plain(cell: &Cell) -> Cell {
    Cell {
        shade: None,
        ..cell.clone()
    }
}

//! The cells of a table by their names, and how two of them differ.

use crate::document::{Cell, Kind, Table, Tone};
use std::collections::HashMap;

/// The name of a row or column, and which of those of this name it is.
pub(super) type Key = (String, usize);

/// A cell where it stands.
pub(super) struct Placed<'a> {
    pub(super) row: Key,
    pub(super) column: Key,
    pub(super) kind: Kind,
    pub(super) cell: &'a Cell,
}

/// All cells but those that name their row: the first that is in no column of groups, and the groups before it.
pub(super) fn placed(table: &Table) -> impl Iterator<Item = Placed<'_>> {
    let groups = table.columns.iter().take_while(|column| column.is_group);
    let naming = groups.count() + 1;
    let name = |row: &Vec<Cell>| {
        let cells: Vec<&str> = row.iter().take(naming).map(|c| c.text.as_str()).collect();
        cells.join(", ")
    };
    let rows = numbered(table.rows.iter().map(name));
    let columns = numbered(table.columns.iter().map(|column| column.title.clone()));
    table.rows.iter().zip(rows).flat_map(move |(cells, row)| {
        let columns = table.columns.iter().zip(columns.clone());
        let behind = cells.iter().zip(columns).skip(naming);
        behind.map(move |(cell, (column, key))| Placed {
            row: row.clone(),
            column: key,
            kind: column.kind,
            cell,
        })
    })
}

fn numbered(names: impl Iterator<Item = String>) -> Vec<Key> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let key = |name: String| {
        let count = seen.entry(name.clone()).or_default();
        *count += 1;
        (name, *count)
    };
    names.map(key).collect()
}

/// How a cell differs from the one before; `None` where both show the same.
pub(super) fn change(before: &Cell, now: &Cell, kind: Kind) -> Option<Cell> {
    if before.text == now.text && before.tone == now.tone {
        return None;
    }
    let verdict = match (before.tone, now.tone) {
        (Some(before), Some(now)) if now > before => Some(("better", Tone::Good)),
        (Some(before), Some(now)) if now < before => Some(("worse", Tone::Bad)),
        _ => None,
    };
    let amount = before.sort.zip(now.sort).map(|(before, now)| match kind {
        Kind::Logarithm => format!("× {}", short(10_f64.powf(now - before))),
        Kind::Number | Kind::Text | Kind::Verdict => {
            let sign = if now < before { "−" } else { "+" };
            format!("{sign}{}", short((now - before).abs()))
        }
    });
    Some(match (verdict, amount) {
        (Some((word, tone)), Some(amount)) => Cell::verdict(format!("{word}, {amount}"), tone),
        (Some((word, tone)), None) => Cell::verdict(word, tone),
        (None, Some(amount)) => Cell::text(amount),
        (None, None) => Cell::text("other"),
    })
}

/// Three decimals where they mean something, without zeros at the end.
fn short(x: f64) -> String {
    if x != 0.0 && !(1e-3..1e4).contains(&x) {
        return format!("{x:.1e}");
    }
    let text = format!("{x:.3}");
    text.trim_end_matches('0').trim_end_matches('.').into()
}

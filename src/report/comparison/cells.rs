//! The cells of a table by their names, and how two of them differ.

use crate::document::{Cell, Kind, Table, Tone};
use std::collections::HashMap;

/// The name of a row or column, and which of those of this name it is.
pub(super) type Key<'a> = (&'a str, usize);

/// A cell where it stands.
pub(super) struct Placed<'a> {
    pub(super) row: Key<'a>,
    pub(super) column: Key<'a>,
    pub(super) kind: Kind,
    pub(super) cell: &'a Cell,
}

/// All cells behind the first of their row.
pub(super) fn placed(table: &Table) -> impl Iterator<Item = Placed<'_>> {
    let names = table
        .rows
        .iter()
        .map(|row| row.first().map_or("", |cell| cell.text.as_str()));
    let rows = numbered(names);
    let columns = numbered(table.columns.iter().map(|column| column.title.as_str()));
    table.rows.iter().zip(rows).flat_map(move |(cells, row)| {
        let columns = table.columns.iter().zip(columns.clone());
        let behind = cells.iter().zip(columns).skip(1);
        behind.map(move |(cell, (column, key))| Placed {
            row,
            column: key,
            kind: column.kind,
            cell,
        })
    })
}

fn numbered<'a>(names: impl Iterator<Item = &'a str>) -> Vec<Key<'a>> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    let key = |name| {
        let count = seen.entry(name).or_default();
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

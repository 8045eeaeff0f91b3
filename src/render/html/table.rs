//! A table: its headings become buttons where there is a script.

use super::tone::{class, sign};
use crate::document::{Cell, Kind, Table, Tone};
use crate::render::plot::is_dark;
use maud::{Markup, html};

/// Tables of more columns are set smaller on paper.
const WIDE: usize = 9;

pub(super) fn table(table: &Table) -> Markup {
    let empty = Cell::default();
    html! {
        // The box scrolls, not the page, and keyboards have to reach it.
        div.scroll.wide[table.columns.len() > WIDE] tabindex="0" role="region" aria-label=(table.caption) {
            table {
                caption { (table.caption) }
                thead {
                    tr {
                        @for column in &table.columns {
                            th scope="col" data-kind=(name(column.kind)) { (column.title) }
                        }
                    }
                }
                tbody {
                    @for row in &table.rows {
                        tr {
                            @for (index, column) in table.columns.iter().enumerate() {
                                (cell(row.get(index).unwrap_or(&empty), column.kind, index == 0))
                            }
                        }
                    }
                    @if table.rows.is_empty() {
                        tr { td.none colspan=(table.columns.len().max(1)) { "nothing" } }
                    }
                }
            }
        }
    }
}

fn cell(cell: &Cell, kind: Kind, names_the_row: bool) -> Markup {
    let sort = match kind {
        Kind::Number | Kind::Logarithm => cell.sort.filter(|sort| sort.is_finite()),
        Kind::Verdict => cell.tone.map(rank),
        Kind::Text => None,
    };
    let content = html! {
        @match cell.tone {
            Some(_) => span.badge.(class(cell.tone).unwrap_or_default()) { (sign(cell.tone)) (cell.text) },
            None => (cell.text),
        }
    };
    let shade = cell
        .shade
        .map(|share| format!("--share:{:.0}%", 100.0 * share));
    let shaded = cell
        .shade
        .map(|share| if is_dark(share) { "high" } else { "low" });
    html! {
        @if names_the_row {
            th scope="row" data-sort=[sort] { (content) }
        } @else {
            td.(name(kind)) data-sort=[sort] data-shade=[shaded] style=[shade] { (content) }
        }
    }
}

/// The worst first.
fn rank(tone: Tone) -> f64 {
    match tone {
        Tone::Bad => 0.0,
        Tone::Open => 1.0,
        Tone::Good => 2.0,
    }
}

fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Text => "text",
        Kind::Number | Kind::Logarithm => "number",
        Kind::Verdict => "verdict",
    }
}

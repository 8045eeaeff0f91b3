//! A table in columns of characters.

use super::MIN_WIDTH;
use super::paint::{Style, paint};
use super::wrap::{cut, harmless, wrap};
use crate::document::{Cell, Column, Finding, Kind, OnTerminal, Table};

/// Before a row, and between its columns; closer where a row has one line then, and two otherwise.
const SPACES: [(usize, usize); 2] = [(2, 2), (0, 1)];
/// So much deeper stand the further lines of a row.
const DEEPER: usize = 2;
/// A last column of text gets a line of its own rather than be wrapped, or cut, to less than this.
const NARROWEST: usize = 24;
const BRIEFEST: usize = 8;

/// The whole table: headings, rows, and how many more there are.
pub(super) fn table(table: &Table, width: usize, color: bool) -> String {
    let layout = Layout::new(table, width);
    let most = table.most.unwrap_or(usize::MAX);
    let mut text = layout.heading(color);
    let mut above: Vec<&str> = Vec::new();
    for row in table.rows.iter().take(most) {
        let groups = layout.groups(row);
        if groups != above && !groups.is_empty() {
            text += &paint(&layout.group_line(&groups), Style::Bold, color);
            text.push('\n');
            above = groups;
        }
        text += &layout.row(row, color);
    }
    if let Some(more) = table.rows.len().checked_sub(most).filter(|more| *more > 0) {
        let line = format!("  … and {more} rows more");
        text += &paint(&line, Style::Faint, color);
        text.push('\n');
    }
    text
}

/// The headings of a table whose rows are shown one by one as they come.
#[must_use]
pub fn heading(table: &Table, width: usize, color: bool) -> String {
    Layout::new(table, width).heading(color)
}

/// A row of such a table: its columns are as wide as they say, whatever other rows there are.
#[must_use]
pub fn row(table: &Table, cells: &[Cell], width: usize, color: bool) -> String {
    Layout::new(table, width).row(cells, color)
}

/// Something found about the row above, set deeper than it.
#[must_use]
pub fn below(finding: &Finding, width: usize, color: bool) -> String {
    let style = finding.tone.map_or(Style::Plain, Style::of);
    let lines = wrap(&finding.sentence(), width.max(MIN_WIDTH), "    ", "      ");
    let lines = lines
        .iter()
        .map(|line| paint(&harmless(line), style, color) + "\n");
    lines.collect()
}

/// Where a column stands.
struct Place {
    column: usize,
    width: usize,
    /// How wide it may become at most: text at the end of a line.
    room: Option<usize>,
}

/// Which column stands where.
struct Layout<'t> {
    table: &'t Table,
    indent: usize,
    gap: usize,
    lines: Vec<Vec<Place>>,
    groups: Vec<usize>,
}

impl<'t> Layout<'t> {
    fn new(table: &'t Table, width: usize) -> Self {
        let is_shown = |c: &Column| !c.is_group && c.on_terminal != OnTerminal::Omitted;
        let shown = table.columns.iter().enumerate();
        let shown = shown.filter_map(|(index, column)| {
            let own = own_width(table, index, column).filter(|_| is_shown(column))?;
            Some((index, column.on_terminal, own))
        });
        let mut shown: Vec<(usize, OnTerminal, usize)> = shown.collect();
        shown.sort_by_key(|(_, on, _)| *on == OnTerminal::Below);
        let mut beside = shown.iter().filter(|(_, on, _)| *on != OnTerminal::Below);
        let last = beside.next_back().map(|(index, ..)| *index);
        let last = last.filter(|index| !is_right(table, *index));
        let beside = shown.iter().filter(|(_, on, _)| *on != OnTerminal::Below);
        let (count, all) = beside.fold((0, 0), |(count, all), (_, _, own)| (count + 1, all + own));
        let fits =
            |(indent, gap): &(usize, usize)| indent + all + gap * (count.max(1) - 1) <= width;
        let (indent, gap) = SPACES.into_iter().find(fits).unwrap_or(SPACES[0]);
        let (mut lines, mut line, mut used) = (Vec::new(), Vec::<Place>::new(), indent);
        for (index, on_terminal, own) in shown {
            let room = width.saturating_sub(used);
            let least = match on_terminal {
                OnTerminal::Brief => BRIEFEST,
                _ => NARROWEST.max(longest_word(table, index)),
            };
            let fits = own <= room || (last == Some(index) && least <= room);
            if !line.is_empty() && (on_terminal == OnTerminal::Below || !fits) {
                lines.push(std::mem::take(&mut line));
                used = indent + DEEPER;
            }
            let ends = last == Some(index) || on_terminal == OnTerminal::Below;
            let room = ends.then(|| width.saturating_sub(used).max(BRIEFEST));
            used += own + gap;
            line.push(Place {
                column: index,
                width: room.map_or(own, |room| own.min(room)),
                room,
            });
        }
        lines.push(line);
        let groups = table.columns.iter().enumerate();
        let groups = groups.filter(|(_, column)| column.is_group);
        Layout {
            table,
            indent,
            gap,
            lines,
            groups: groups.map(|(index, _)| index).collect(),
        }
    }

    fn heading(&self, color: bool) -> String {
        // What stands below its row needs no heading.
        let title = |column: &Column| {
            (column.on_terminal != OnTerminal::Below).then(|| Cell::text(&column.title))
        };
        let titles = self.table.columns.iter().map(title);
        let titles: Vec<Cell> = titles.map(Option::unwrap_or_default).collect();
        if titles.iter().all(|title| title.text.is_empty()) {
            return String::new();
        }
        self.lines(&titles, Some(Style::Faint), color)
    }

    fn row(&self, cells: &[Cell], color: bool) -> String {
        self.lines(cells, None, color)
    }

    fn lines(&self, cells: &[Cell], style: Option<Style>, color: bool) -> String {
        let mut text = String::new();
        for (index, places) in self.lines.iter().enumerate() {
            let deeper = if index == 0 { 0 } else { DEEPER };
            let parts = places.iter().map(|place| self.parts(cells, place));
            let parts: Vec<Vec<(Style, String)>> = parts.collect();
            let most = parts.iter().map(Vec::len).max().unwrap_or(0);
            for part in 0..most.max(usize::from(index == 0)) {
                let padded = places.iter().zip(&parts).map(|(place, parts)| {
                    let (own, words) = match parts.get(part) {
                        Some((style, words)) => (*style, words.as_str()),
                        None => (Style::Plain, ""),
                    };
                    let padding = " ".repeat(place.width.saturating_sub(words.chars().count()));
                    let painted = paint(words, style.unwrap_or(own), color);
                    if is_right(self.table, place.column) {
                        padding + &painted
                    } else {
                        painted + &padding
                    }
                });
                let padded: Vec<String> = padded.collect();
                let line = " ".repeat(self.indent + deeper) + &padded.join(&" ".repeat(self.gap));
                text += line.trim_end();
                text.push('\n');
            }
        }
        text
    }

    /// The lines of a cell and how they look: what is below the first is faint.
    fn parts(&self, cells: &[Cell], place: &Place) -> Vec<(Style, String)> {
        let Some(cell) = cells.get(place.column) else {
            return Vec::new();
        };
        let column = self.table.columns.get(place.column);
        let is_brief = column.is_some_and(|column| column.on_terminal == OnTerminal::Brief);
        let first = cell.tone.map_or(Style::Plain, Style::of);
        let mut parts = Vec::new();
        for (index, line) in cell.text.lines().map(harmless).enumerate() {
            let style = if index == 0 { first } else { Style::Faint };
            let fitting = match place.room {
                Some(room) if is_brief => vec![cut(&line, room)],
                Some(room) if line.chars().count() > room => wrap(&line, room, "", ""),
                _ => vec![line],
            };
            parts.extend(fitting.into_iter().map(|line| (style, line)));
        }
        parts
    }

    fn groups<'r>(&self, row: &'r [Cell]) -> Vec<&'r str> {
        let cell = |index: &usize| row.get(*index).map_or("", |cell| cell.text.as_str());
        self.groups.iter().map(cell).collect()
    }

    /// "inner: simpson".
    fn group_line(&self, groups: &[&str]) -> String {
        let named = self.groups.iter().zip(groups).map(|(index, group)| {
            let title = self.table.columns.get(*index).map(|c| c.title.as_str());
            match title.filter(|title| !title.is_empty()) {
                Some(title) => format!("{title}: {group}"),
                None => (*group).to_string(),
            }
        });
        harmless(&named.collect::<Vec<_>>().join(", "))
    }
}

/// How wide a column is; `None` where it has a heading and nothing below.
fn own_width(table: &Table, index: usize, column: &Column) -> Option<usize> {
    if let Some(width) = column.width {
        return Some(width);
    }
    let most = table.most.unwrap_or(usize::MAX);
    let rows = || table.rows.iter().take(most);
    let cells = rows().filter_map(|row| row.get(index));
    let lines = cells.flat_map(|cell| cell.text.lines());
    let widest = lines.map(|line| line.chars().count()).max();
    let is_bare = widest.is_none_or(|widest| widest == 0) && rows().next().is_some();
    (!is_bare).then(|| widest.unwrap_or(0).max(column.title.chars().count()))
}

/// What wrapping leaves whole.
fn longest_word(table: &Table, index: usize) -> usize {
    let cells = table.rows.iter().filter_map(|row| row.get(index));
    let words = cells.flat_map(|cell| cell.text.split_whitespace());
    words.map(|word| word.chars().count()).max().unwrap_or(0)
}

fn is_right(table: &Table, index: usize) -> bool {
    let kind = table.columns.get(index).map(|column| column.kind);
    matches!(kind, Some(Kind::Number | Kind::Logarithm))
}

//! A table in columns of characters.

use super::paint::{Style, paint};
use super::{MIN_WIDTH, wrap};
use crate::document::{Cell, Column, Finding, Kind, Table};

/// Before a row, and between its columns; closer where a row has one line then, and two otherwise.
const SPACES: [(usize, usize); 2] = [(2, 2), (0, 1)];
/// So much deeper stand the further lines of a row.
const DEEPER: usize = 2;

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
    let lines = lines.iter().map(|line| paint(line, style, color) + "\n");
    lines.collect()
}

/// Which column stands where.
struct Layout<'t> {
    table: &'t Table,
    indent: usize,
    gap: usize,
    /// Columns by their place in the table, line by line, each with its width.
    lines: Vec<Vec<(usize, usize)>>,
    groups: Vec<usize>,
}

impl<'t> Layout<'t> {
    fn new(table: &'t Table, width: usize) -> Self {
        let is_shown = |column: &Column| !column.is_group && !column.is_detail;
        let columns = table.columns.iter().enumerate();
        let columns = columns.filter(|(_, column)| is_shown(column));
        let columns = columns.filter_map(|(index, c)| Some((index, own_width(table, index, c)?)));
        let columns: Vec<(usize, usize)> = columns.collect();
        let all: usize = columns.iter().map(|(_, own)| own).sum();
        let gaps = columns.len().saturating_sub(1);
        let fits = |(indent, gap): &(usize, usize)| indent + all + gap * gaps <= width;
        let (indent, gap) = SPACES.into_iter().find(fits).unwrap_or(SPACES[0]);
        let (mut lines, mut line, mut used) = (Vec::new(), Vec::new(), indent);
        for (index, own) in columns {
            let needed = if line.is_empty() { own } else { own + gap };
            if !line.is_empty() && used + needed > width {
                lines.push(std::mem::take(&mut line));
                used = indent + DEEPER;
            }
            used += if line.is_empty() { own } else { own + gap };
            line.push((index, own));
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
        let titles = self.table.columns.iter().map(|c| Cell::text(&c.title));
        let titles: Vec<Cell> = titles.collect();
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
        for (index, columns) in self.lines.iter().enumerate() {
            let indent = self.indent + if index == 0 { 0 } else { DEEPER };
            let within = |(column, _): &(usize, usize)| cells.get(*column);
            let lines = columns.iter().filter_map(within).map(lines);
            let most = lines.map(|lines| lines.len()).max().unwrap_or(0);
            for part in 0..most.max(usize::from(index == 0)) {
                let line = self.line(cells, columns, part, (style, color));
                let line = " ".repeat(indent) + &line;
                text += line.trim_end();
                text.push('\n');
            }
        }
        text
    }

    /// One line of a row: of cells with several lines that part.
    fn line(
        &self,
        cells: &[Cell],
        columns: &[(usize, usize)],
        part: usize,
        (style, color): (Option<Style>, bool),
    ) -> String {
        let cells = columns.iter().map(|(column, width)| {
            let cell = cells.get(*column);
            let words = cell.and_then(|cell| lines(cell).into_iter().nth(part));
            let words = words.unwrap_or_default();
            let padding = " ".repeat(width.saturating_sub(words.chars().count()));
            let own = match cell.and_then(|cell| cell.tone) {
                _ if part > 0 => Style::Faint,
                Some(tone) => Style::of(tone),
                None => Style::Plain,
            };
            let painted = paint(&words, style.unwrap_or(own), color);
            if is_right(self.table, *column) {
                padding + &painted
            } else {
                painted + &padding
            }
        });
        cells.collect::<Vec<_>>().join(&" ".repeat(self.gap))
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
        named.collect::<Vec<_>>().join(", ")
    }
}

/// How wide a column is; `None` where it has a heading and nothing below.
fn own_width(table: &Table, index: usize, column: &Column) -> Option<usize> {
    if let Some(width) = column.width {
        return Some(width);
    }
    let most = table.most.unwrap_or(usize::MAX);
    let rows = || table.rows.iter().take(most);
    let cells = rows().filter_map(|row| row.get(index)).flat_map(lines);
    let widest = cells.map(|line| line.chars().count()).max();
    let is_bare = widest.is_none_or(|widest| widest == 0) && rows().next().is_some();
    (!is_bare).then(|| widest.unwrap_or(0).max(column.title.chars().count()))
}

fn is_right(table: &Table, index: usize) -> bool {
    let kind = table.columns.get(index).map(|column| column.kind);
    matches!(kind, Some(Kind::Number | Kind::Logarithm))
}

/// The lines of a cell; what a file says is shown, and does not steer the terminal.
fn lines(cell: &Cell) -> Vec<String> {
    let shown = |c: char| if c.is_control() { ' ' } else { c };
    let lines = cell.text.lines();
    lines
        .map(|line| line.chars().map(shown).collect())
        .collect()
}

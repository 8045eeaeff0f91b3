//! The entries that stand in one table of a report.

use crate::study::reproduce::{Entry, Table};

/// The entries of one table in one format, row by row.
///
/// Entries with replicas run in binary64 whatever was asked for: they stand with that format's
/// entries if there are any, otherwise with the table's first.
#[derive(Clone, Debug)]
pub struct Group<'a> {
    /// Which table.
    pub table: Table,
    /// The format of the entries without replicas.
    pub format: &'a str,
    /// The only group of its table: its name needs no format.
    pub only: bool,
    /// The rows, in the order of the paper.
    pub rows: Vec<Row<'a>>,
}

/// The entries of one row.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// The inner rule, or how the color is computed.
    pub name: &'static str,
    /// One entry a column.
    pub entries: Vec<&'a Entry>,
}

/// Sorts entries into tables and rows; both keep the order in which they first appear.
#[must_use]
pub fn groups(entries: &[Entry]) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    let with_replicas = |entry: &&Entry| entry.replicas.is_some();
    for entry in entries.iter().filter(|entry| !with_replicas(entry)) {
        add(&mut groups, entry, |group| group.format == entry.format);
    }
    for entry in entries.iter().filter(with_replicas) {
        let own = groups
            .iter()
            .any(|group| group.table == entry.table && group.format == entry.format);
        add(&mut groups, entry, |group| {
            !own || group.format == entry.format
        });
    }
    groups.sort_by_key(|group| group.table);
    let tables: Vec<Table> = groups.iter().map(|group| group.table).collect();
    for group in &mut groups {
        group.only = tables.iter().filter(|&&t| t == group.table).count() == 1;
    }
    groups
}

/// Adds an entry to the first group of its table that suits, or to a new one.
fn add<'a>(groups: &mut Vec<Group<'a>>, entry: &'a Entry, suits: impl Fn(&Group<'a>) -> bool) {
    let found = groups
        .iter()
        .position(|group| group.table == entry.table && suits(group));
    let index = found.unwrap_or(groups.len());
    if found.is_none() {
        groups.push(Group {
            table: entry.table,
            format: &entry.format,
            only: true,
            rows: Vec::new(),
        });
    }
    let rows = &mut groups[index].rows;
    match rows.iter_mut().find(|row| row.name == entry.row) {
        Some(row) => row.entries.push(entry),
        None => rows.push(Row {
            name: entry.row,
            entries: vec![entry],
        }),
    }
}

impl<'a> Group<'a> {
    /// All entries, row by row.
    pub fn entries(&self) -> impl Iterator<Item = &'a Entry> {
        self.rows.iter().flat_map(|row| row.entries.iter().copied())
    }

    /// The columns, in the order in which they first appear.
    #[must_use]
    pub fn columns(&self) -> Vec<&'static str> {
        let mut columns = Vec::new();
        for entry in self.entries() {
            if !columns.contains(&entry.column) {
                columns.push(entry.column);
            }
        }
        columns
    }

    /// The heading: the table's, and the format.
    #[must_use]
    pub fn title(&self) -> String {
        format!("{} ({})", self.table.title(), self.format)
    }

    /// The stem of a file name: letters, digits and `-`, such as `table-1-exact`; with the format
    /// where the table has more than one.
    #[must_use]
    pub fn file_stem(&self) -> String {
        let table = match self.table {
            Table::Exact => "table-1-exact",
            Table::Linear => "table-1-linear",
            Table::Cubic => "table-1-cubic",
            Table::Preintegrated => "table-2",
        };
        if self.only {
            table.to_string()
        } else {
            format!("{table}-{}", self.format.replace(':', "-"))
        }
    }
}

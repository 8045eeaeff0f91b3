//! Tables whose rows can be sorted by any column.

use super::{Tone, absent};
use serde::{Deserialize, Serialize};

/// Rows under headings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// What its files are called, without an ending: lower-case letters, digits and dashes. Without a name its CSV is called
    /// after its place, and shaded cells are not drawn.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub file: String,
    /// What it shows.
    pub caption: String,
    /// The headings.
    pub columns: Vec<Column>,
    /// The rows; a row that is too short has empty cells at its end. The first cell that is in no column of groups names
    /// the row, together with the groups before it: reports are compared by that.
    pub rows: Vec<Vec<Cell>>,
    /// How many rows a terminal shows; where it is not said, all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most: Option<usize>,
}

impl Table {
    /// A table without rows.
    #[must_use]
    pub fn new(caption: impl Into<String>, columns: impl IntoIterator<Item = Column>) -> Self {
        Table {
            file: String::new(),
            caption: caption.into(),
            columns: columns.into_iter().collect(),
            rows: Vec::new(),
            most: None,
        }
    }

    /// The same table with rows.
    #[must_use]
    pub fn with(self, rows: impl IntoIterator<Item = Vec<Cell>>) -> Self {
        Table {
            rows: rows.into_iter().collect(),
            ..self
        }
    }

    /// The same table, whose files have a name.
    #[must_use]
    pub fn named(self, file: impl Into<String>) -> Self {
        Table {
            file: file.into(),
            ..self
        }
    }

    /// The same table, of which a terminal shows so many rows.
    #[must_use]
    pub fn at_most(self, rows: usize) -> Self {
        Table {
            most: Some(rows),
            ..self
        }
    }

    /// Whether any cell is coloured: then it is a map.
    #[must_use]
    pub fn is_shaded(&self) -> bool {
        let mut cells = self.rows.iter().flatten();
        cells.any(|cell| cell.shade.is_some())
    }
}

/// A heading.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// The heading.
    pub title: String,
    /// How its cells are sorted and set.
    pub kind: Kind,
    /// Rows with the same cell here belong together: a terminal makes it a heading above them.
    #[serde(default, skip_serializing_if = "absent::is_default")]
    pub is_group: bool,
    /// What a terminal makes of it.
    #[serde(default, skip_serializing_if = "absent::is_default")]
    pub on_terminal: OnTerminal,
    /// So many characters wide on a terminal, whatever is in it: rows that are shown before all are known need that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<usize>,
}

impl Column {
    fn new(title: impl Into<String>, kind: Kind) -> Self {
        Column {
            title: title.into(),
            kind,
            is_group: false,
            on_terminal: OnTerminal::Whole,
            width: None,
        }
    }

    /// A column of text.
    #[must_use]
    pub fn text(title: impl Into<String>) -> Self {
        Column::new(title, Kind::Text)
    }

    /// A column of numbers.
    #[must_use]
    pub fn number(title: impl Into<String>) -> Self {
        Column::new(title, Kind::Number)
    }

    /// A column of numbers of any magnitude, whose cells have decimal logarithms to sort by.
    #[must_use]
    pub fn logarithm(title: impl Into<String>) -> Self {
        Column::new(title, Kind::Logarithm)
    }

    /// A column of verdicts.
    #[must_use]
    pub fn verdict(title: impl Into<String>) -> Self {
        Column::new(title, Kind::Verdict)
    }

    /// The same column, by which rows belong together.
    #[must_use]
    pub fn grouping(self) -> Self {
        Column {
            is_group: true,
            ..self
        }
    }

    /// The same column for those with room.
    #[must_use]
    pub fn detail(self) -> Self {
        Column {
            on_terminal: OnTerminal::Omitted,
            ..self
        }
    }

    /// The same column, below the row on a terminal.
    #[must_use]
    pub fn below(self) -> Self {
        Column {
            on_terminal: OnTerminal::Below,
            ..self
        }
    }

    /// The same column, cut on a terminal where it does not fit.
    #[must_use]
    pub fn brief(self) -> Self {
        Column {
            on_terminal: OnTerminal::Brief,
            ..self
        }
    }

    /// The same column, so many characters wide on a terminal.
    #[must_use]
    pub fn wide(self, characters: usize) -> Self {
        Column {
            width: Some(characters),
            ..self
        }
    }
}

/// What a terminal, which has little room, makes of a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnTerminal {
    /// It is shown; text at the end of a line is wrapped where it does not fit.
    #[default]
    Whole,
    /// It is shown, and text at the end of a line is cut where it does not fit.
    Brief,
    /// Often empty, or long: it stands below the row, where there is something to say.
    Below,
    /// It is left out: for those with room.
    Omitted,
}

/// What is in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Sorted as text, without regard to case.
    Text,
    /// Sorted by [`Cell::sort`]; cells without one come last.
    Number,
    /// The same, where that is the decimal logarithm of what is shown; compared by their ratio.
    Logarithm,
    /// Sorted by tone, the worst first, then as text.
    Verdict,
}

/// One cell.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// What is shown; it may have several lines.
    pub text: String,
    /// What it is sorted and compared by, in a column of numbers or logarithms. Not a finite number is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sort: Option<f64>,
    /// What its verdict amounts to; shown as a badge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tone: Option<Tone>,
    /// How strongly it is coloured, from 0 to 1: tables of shaded cells are heat maps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shade: Option<f64>,
}

impl Cell {
    /// Text.
    #[must_use]
    pub fn text(text: impl Into<String>) -> Self {
        Cell {
            text: text.into(),
            ..Cell::default()
        }
    }

    /// A number as it is shown, and as it is sorted.
    #[must_use]
    pub fn number(text: impl Into<String>, sort: impl Into<Option<f64>>) -> Self {
        Cell {
            sort: sort.into().filter(|sort| sort.is_finite()),
            ..Cell::text(text)
        }
    }

    /// A verdict.
    #[must_use]
    pub fn verdict(text: impl Into<String>, tone: Tone) -> Self {
        Cell::text(text).toned(tone)
    }

    /// The same cell, judged.
    #[must_use]
    pub fn toned(self, tone: Tone) -> Self {
        Cell {
            tone: Some(tone),
            ..self
        }
    }

    /// The same cell, coloured from 0 (pale) to 1 (dark).
    #[must_use]
    pub fn shaded(self, share: f64) -> Self {
        Cell {
            shade: share.is_finite().then_some(share.clamp(0.0, 1.0)),
            ..self
        }
    }
}

//! Transfer functions as tables in CSV.

use super::medium::nearest;
use super::{SceneProblem, Values};
use crate::case::Transfer;
use crate::input;
use crate::symbolic::parse_number;
use rug::Rational;
use std::path::Path;

/// More entries are no table of a transfer function.
const MAX_ENTRIES: usize = 1 << 16;

/// C and τ by field value.
pub(super) struct TransferTable {
    /// s, increasing.
    pub(super) s: Vec<Rational>,
    /// By entry, then by channel.
    pub(super) values: Vec<Vec<Values>>,
}

/// A finite decimal number.
pub(super) fn number(text: &str) -> Option<Rational> {
    parse_number(text).ok()
}

/// A table with the columns `s`, `extinction` and `emission`; of several channels one column of emission each,
/// by its name, and one of extinction for all or `extinction-NAME` each.
pub(super) fn read(path: &Path, channels: &[String]) -> Result<TransferTable, SceneProblem> {
    let file = |problem: String| SceneProblem::File {
        path: path.display().to_string(),
        problem,
    };
    let text = input::text(path, input::DATA).map_err(|error| file(error.to_string()))?;
    parse(&text, channels).map_err(file)
}

fn parse(text: &str, channels: &[String]) -> Result<TransferTable, String> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let heading = reader.headers().map_err(|error| error.to_string())?.clone();
    let columns = Columns::new(&heading, channels)?;
    let mut table = TransferTable {
        s: Vec::new(),
        values: Vec::new(),
    };
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let cell = |column: usize| {
            let text = record.get(column).unwrap_or("");
            number(text).ok_or_else(|| {
                let shown = text.escape_debug();
                format!("line {line}: '{shown}' is no number (allowed: finite numbers)")
            })
        };
        let not_negative = |column: usize| {
            let value = cell(column)?;
            if value < 0 {
                let name = heading.get(column).unwrap_or("");
                return Err(format!(
                    "line {line}: {name} = {} is negative (allowed: 0 or more)",
                    nearest(&value)
                ));
            }
            Ok(value)
        };
        let s = cell(columns.s)?;
        if let Some(last) = table.s.last().filter(|last| **last >= s) {
            return Err(format!(
                "line {line}: s = {} comes after {} (allowed: s that increases)",
                nearest(&s),
                nearest(last)
            ));
        }
        let both = columns.extinction.iter().zip(&columns.emission);
        let values = both.map(|(&extinction, &emission)| {
            Ok(Transfer {
                emission: not_negative(emission)?,
                extinction: not_negative(extinction)?,
            })
        });
        table.values.push(values.collect::<Result<_, String>>()?);
        table.s.push(s);
    }
    match table.s.len() {
        2..=MAX_ENTRIES => Ok(table),
        count => Err(format!("{count} entries (allowed: 2 to {MAX_ENTRIES})")),
    }
}

/// Which column is what.
struct Columns {
    s: usize,
    extinction: Vec<usize>,
    emission: Vec<usize>,
}

impl Columns {
    fn new(heading: &csv::StringRecord, channels: &[String]) -> Result<Columns, String> {
        let find = |name: &str| heading.iter().position(|cell| cell == name);
        let missing = |name: &str| {
            let found: Vec<&str> = heading.iter().collect();
            let found = found.join(",");
            let found = found.escape_debug();
            format!(
                "no column '{name}' in '{found}' (allowed: a heading such as s,extinction,emission)"
            )
        };
        let named = |name: &str| find(name).ok_or_else(|| missing(name));
        let emission = channels.iter().map(|channel| {
            let name = if channel.is_empty() {
                "emission"
            } else {
                channel
            };
            named(name)
        });
        let extinction = channels.iter().map(|channel| {
            let own = find(&format!("extinction-{channel}"));
            own.map_or_else(|| named("extinction"), Ok)
        });
        Ok(Columns {
            s: named("s")?,
            extinction: extinction.collect::<Result<_, String>>()?,
            emission: emission.collect::<Result<_, String>>()?,
        })
    }
}

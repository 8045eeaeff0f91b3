//! What a jump or a kink of the medium costs, by rule and by place: orders beside theory.
//!
//! The paper assumes bounded derivatives; this measures what happens without them. The cases are the
//! catalogue's: a break on a node, off the nodes, and at a place that moves within its segment.

mod cell;
mod level;
mod rows;

pub use cell::Cell;
pub use level::{Level, Measured, STARTS, judge, level, numbers};
pub use rows::{Kind, Place};

use super::{Progress, Run, samples};
use crate::case::manufacture::{ManufactureError, manufacture};
use crate::case::{FileError, SymbolicCase, catalogue};
use crate::convergence::{FitError, fit};
use crate::method::{Method, MethodError, expected, expected_on};
use crate::parallel;
use crate::real::Mpfr;
use crate::reference::ReferenceError;
use rows::{case_name, rows};

/// Bits of the runs: the finest error of the table is near 1e-22, the floor near 1e-34.
pub const BITS: u32 = 128;

/// The ladder of a usual study, for comparison.
pub const LADDER: [u64; 9] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048];

/// Why the table cannot be measured.
#[derive(Debug, thiserror::Error)]
pub enum NonsmoothError {
    /// A case is not in the catalogue.
    #[error("the catalogue has no case '{name}'")]
    Missing {
        /// Its name.
        name: &'static str,
    },
    /// A case cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A case cannot be derived.
    #[error(transparent)]
    Manufacture(#[from] ManufactureError),
    /// A level does not suit a method.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The exact radiance is not to be had.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The errors cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// Measures the table: kind by kind, rule by rule, place by place.
///
/// # Errors
/// [`NonsmoothError`], which would be a mistake of this crate.
pub fn measure(progress: &dyn Progress) -> Result<Vec<Cell>, NonsmoothError> {
    let methods: Vec<Method> = rows().into_iter().map(|(_, method)| method).collect();
    let columns = columns()?;
    // A run a number of segments: neighbouring n have hardly a node in common. The largest come first.
    let mut tasks: Vec<(usize, u64)> = columns
        .iter()
        .enumerate()
        .flat_map(|(index, column)| {
            all_numbers(column.place)
                .into_iter()
                .map(move |n| (index, n))
        })
        .collect();
    tasks.sort_by_key(|&(_, n)| std::cmp::Reverse(n));
    let format = Mpfr { bits: BITS };
    let runs: Vec<(usize, Run)> = parallel::try_map(&tasks, |&(index, n)| {
        let case = &columns[index].case;
        let run = Run::new(case, format, &methods, &[n], progress)?;
        Ok::<_, MethodError>((index, run))
    })?;
    let mut cells = Vec::new();
    for (index, column) in columns.iter().enumerate() {
        let own = runs.iter().rev().filter(|(of, _)| *of == index);
        let run = Run::joined(own.map(|(_, run)| run), methods.len(), BITS);
        for (row, (rule, method)) in rows().into_iter().enumerate() {
            cells.push((row, cell(column, rule, &method, row, &run)?));
        }
    }
    cells.sort_by_key(|(row, cell)| (cell.kind, *row, cell.place));
    Ok(cells.into_iter().map(|(_, cell)| cell).collect())
}

/// The units that [`Progress`] will hear of in all.
#[must_use]
pub fn work() -> u64 {
    let places = Place::ALL.into_iter();
    let segments: u64 = places
        .map(|place| all_numbers(place).iter().sum::<u64>())
        .sum();
    segments * (Kind::ALL.len() * rows().len()) as u64
}

struct Column {
    kind: Kind,
    place: Place,
    case: SymbolicCase,
}

fn columns() -> Result<Vec<Column>, NonsmoothError> {
    let mut columns = Vec::new();
    for kind in Kind::ALL {
        for place in Place::ALL {
            let name = case_name(kind, place);
            let missing = NonsmoothError::Missing { name };
            let Some(description) = catalogue::find(name) else {
                return Err(missing);
            };
            let derived = manufacture(&description?)?.into_iter().next();
            let case = derived.ok_or(missing)?.case;
            columns.push(Column { kind, place, case });
        }
    }
    Ok(columns)
}

/// All numbers of segments that a case is run on: those of the levels and the usual ladder, ascending.
fn all_numbers(place: Place) -> Vec<u64> {
    let mut all: Vec<u64> = STARTS
        .iter()
        .flat_map(|&start| numbers(place, start))
        .chain(LADDER)
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn cell(
    column: &Column,
    rule: &'static str,
    method: &Method,
    row: usize,
    run: &Run,
) -> Result<Cell, NonsmoothError> {
    let Column { kind, place, case } = column;
    let all = samples(case, run, row, None)?;
    let numbers: Vec<u64> = STARTS
        .iter()
        .flat_map(|&start| numbers(*place, start))
        .collect();
    let theory = expected_on(method, case, &numbers);
    let levels: Vec<Level> = STARTS
        .iter()
        .filter_map(|&start| level::level(*place, start, &all))
        .collect();
    let usual = samples(case, &run.at_levels(&LADDER), row, None)?;
    Ok(Cell {
        kind: *kind,
        place: *place,
        rule,
        method: method.to_string(),
        guaranteed: expected(method, case),
        theory,
        measured: judge(&levels, theory),
        levels,
        usual: fit(&usual, Some(expected_on(method, case, &LADDER)))?,
    })
}

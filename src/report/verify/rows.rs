//! Rows for a terminal, as they come: columns are as wide as they may have to be.

use super::scattered::short;
use super::tone;
use super::words::{bars, failure, failures, largest, order, sign, theory, window};
use crate::document::{Cell, Column, Finding, Table, Tone};
use crate::kernel::Quantity;
use crate::render::terminal;
use crate::study::verify::{Line, Measured, Standing};

/// Levels of which errors are shown.
const BARS: usize = 8;
/// Failures shown of one channel.
const FAILURES: usize = 2;

/// With the longest name and the longest verdict they fill 80 columns.
fn table() -> Table {
    let columns = [
        ("", 1),
        ("case", 22),
        ("order", 5),
        ("measured", 11),
        ("window", 8),
        ("worst", 5),
        ("errors", BARS),
        ("verdict", 13),
    ];
    Table::new(
        "",
        columns.map(|(title, width)| Column::text(title).wide(width)),
    )
}

/// That of a kernel that draws random numbers: two orders where others have one, its levels and a floor.
fn scattered_table() -> Table {
    let columns = [
        ("", 1),
        ("case", 22),
        ("order", 5),
        ("larger error", 13),
        ("smaller", 12),
        ("errors", BARS),
        ("verdict", 13),
    ];
    Table::new(
        "",
        columns.map(|(title, width)| Column::text(title).wide(width)),
    )
}

/// The names of the columns of a kernel that draws random numbers, above the first [`row`].
#[must_use]
pub fn scattered_heading(width: usize, color: bool) -> String {
    terminal::heading(&scattered_table(), width, color)
}

/// The names of the columns, above the first [`row`].
#[must_use]
pub fn heading(width: usize, color: bool) -> String {
    terminal::heading(&table(), width, color)
}

/// One channel: the order promised and measured, the window, the largest error as a part of the radiance, the
/// errors as bars, the verdict; failures below. Of a kernel that draws random numbers the orders of both parts of its
/// error, in place of window and largest error. Nothing where no method shows the order, and of other quantities than the
/// first that is answered where they do not contradict: those stand in one place.
#[must_use]
pub fn row(line: &Line, first: Quantity, width: usize, color: bool) -> String {
    if line.standing == Standing::Unresolved || is_beside(line, first) {
        return String::new();
    }
    let tone = tone(line.standing);
    let verdict = match line.standing {
        Standing::Failed => "failed",
        _ => line.measured.verdict().name(),
    };
    let (table, measured) = match &line.measured {
        Measured::Scattered(fit) => (scattered_table(), short(fit).to_vec()),
        Measured::Fitted { .. } | Measured::Nothing => {
            let order = order(line).replace(" ± ", "±");
            (table(), vec![order, window(line), largest(line)])
        }
    };
    let first = [
        Cell::verdict(sign(line.standing), tone),
        Cell::text(name(line, first)),
        Cell::text(theory(line.expected)),
    ];
    let last = [
        Cell::text(thinned(&bars(line))),
        Cell::verdict(verdict, tone),
    ];
    let measured = measured.into_iter().map(Cell::text);
    let cells: Vec<Cell> = first.into_iter().chain(measured).chain(last).collect();
    let mut text = terminal::row(&table, &cells, width, color);
    for words in trouble(line) {
        let finding = Finding::new("", words).toned(Tone::Open);
        text += &terminal::below(&finding, width, color);
    }
    text
}

/// The case alone where all rows are of the same quantity.
fn name(line: &Line, first: Quantity) -> &str {
    match line.name.split_once(':') {
        Some((case, _)) if line.quantity == first => case,
        _ => &line.name,
    }
}

/// Whether a section of its own says all of it.
fn is_beside(line: &Line, first: Quantity) -> bool {
    line.quantity != first && line.standing != Standing::Contradicted
}

/// What stands below a row.
fn trouble(line: &Line) -> Vec<String> {
    let groups = failures(line);
    let mut shown: Vec<String> = groups.iter().take(FAILURES).map(failure).collect();
    let left = groups.iter().skip(FAILURES);
    match left.map(|(levels, _)| levels.len()).sum() {
        0 => {}
        1 => shown.push("and 1 level more".into()),
        left => shown.push(format!("and {left} levels more")),
    }
    if !line.steady {
        shown.push("two answers to the coarsest level differ".into());
    }
    let remarks = line.remarks.iter();
    shown.extend(remarks.map(|remark| remark.of(line.quantity)));
    shown
}

/// As many bars as there is room for, evenly over the levels and with the finest.
fn thinned(bars: &str) -> String {
    let count = bars.chars().count();
    let every = count.div_ceil(BARS).max(1);
    let kept = |index: &usize| (count - 1 - index).is_multiple_of(every);
    let bars = bars.chars().enumerate();
    bars.filter(|(index, _)| kept(index))
        .map(|(_, bar)| bar)
        .collect()
}

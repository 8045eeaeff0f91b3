//! A report as one page: a file that opens in any browser, without a network and without a server.
//!
//! A [`Page`] says what is shown and knows nothing of what is reported: facts, sections, tables, plots. [`render`]
//! makes the document, [`place`] puts it into a directory of reports, and [`read`] gives the page back that a
//! document was made of, which is how several reports are compared.
//!
//! ```
//! use volver::report::html::{About, Axis, Block, Cell, Column, Fact, Page, Plot, Point, Section, Series, Table, Tone, render};
//!
//! let mut page = Page::new("trial", "A trial", About::new(["volver", "trial"]));
//! page.summary.push(Fact::new("Confirmed", "1").toned(Tone::Good));
//! let mut section = Section::new("orders", "Orders");
//! let mut table = Table::new("Order and verdict", [Column::text("method"), Column::number("order")]);
//! table.rows.push(vec![Cell::text("trapezoid"), Cell::number("2.000 ± 0.004", 2.0)]);
//! section.blocks.push(Block::Table(table));
//! // Logarithmic axes take logarithms, so that 1e-400 has its place too.
//! let mut plot = Plot::new("trapezoid", Axis::log("segments n"), Axis::log("|error|"));
//! let points = [Point::new(1.0, -2.0, "n = 10: 1e-2"), Point::new(2.0, -4.0, "n = 100: 1e-4")];
//! plot.series.push(Series::line("total", points));
//! section.blocks.push(Block::Plot(plot));
//! page.sections.push(section);
//! let html = render(&page)?;
//! assert!(html.starts_with("<!DOCTYPE html>") && html.contains("2.000 ± 0.004"));
//! # Ok::<(), volver::report::ReportError>(())
//! ```

mod about;
mod embed;
mod machine;
mod number;
mod page;
mod place;
mod plot;
mod render;
mod table;
#[cfg(test)]
mod tests;

pub use about::About;
pub use embed::{PageError, SCHEMA, read};
pub use page::{Block, Fact, Link, Page, Section, Tone};
pub use place::{INDEX, place};
pub use plot::{Axis, Guide, Plot, Point, Scale, Series, Stroke, Trace};
pub use render::render;
pub use table::{Cell, Column, Kind, Table};

//! A document as one page: a file that opens in any browser, without a network and without a server.
//!
//! [`render`] makes the page, [`place`] puts it into a directory of reports, and [`read`] gives the document back that a page
//! was made of, which is how several reports are compared.
//!
//! ```
//! use volver::document::{About, Axis, Block, Document, Fact, Figure, Plot, Point, Section, Series, Tone};
//! use volver::render::html::{read, render};
//!
//! let mut document = Document::new("trial", "A trial", About::new(["volver", "trial"]));
//! document.summary.push(Fact::new("Confirmed", "1").toned(Tone::Good));
//! // Logarithmic axes take logarithms, so that 1e-400 has its place too.
//! let mut plot = Plot::new("trapezoid", Axis::log("segments n"), Axis::log("|error|"));
//! let points = [Point::new(1.0, -2.0, "n = 10: 1e-2"), Point::new(2.0, -4.0, "n = 100: 1e-4")];
//! plot.series.push(Series::line("total", points));
//! let figure = Block::Figure(Figure::new("errors", "Error against segments", [plot]));
//! document.sections.push(Section::of("orders", "Orders", [figure]));
//! let html = render(&document)?;
//! assert!(html.starts_with("<!DOCTYPE html>"));
//! assert_eq!(read(&html)?, document);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blocks;
mod embed;
mod figure;
mod head;
mod page;
mod place;
mod table;
mod tone;

pub use embed::{PageError, SCHEMA, read};
pub use page::render;
pub use place::{INDEX, place};

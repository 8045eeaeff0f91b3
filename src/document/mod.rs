//! A report before it has a format: what is said, in which order, and how good or bad it is.
//!
//! A command makes one [`Document`]; the back ends of [`render`](crate::render) show it on a terminal, as Markdown, as a page,
//! as tables for LaTeX and for programs. A document knows nothing of what it reports and nothing of how it will look.
//!
//! ```
//! use volver::document::{About, Block, Cell, Column, Conclusion, Document, Section, Table, Tone};
//! use volver::render::{markdown, terminal};
//!
//! let mut document = Document::new("trial", "A trial", About::new(["volver", "trial"]));
//! let mut table = Table::new("Order and verdict", [Column::text("method"), Column::number("order")]);
//! table.rows.push(vec![Cell::text("trapezoid"), Cell::number("2.000 ± 0.004", 2.0)]);
//! document.sections.push(Section::of("orders", "Orders", [Block::Table(table)]));
//! document.conclusion = Some(Conclusion::new("1 line: 1 Confirmed").toned(Tone::Good));
//!
//! assert!(terminal(&document, 80, false).ends_with("1 line: 1 Confirmed\n"));
//! assert!(markdown(&document).contains("| trapezoid | 2.000 ± 0.004 |"));
//! ```

mod about;
mod absent;
mod block;
mod figure;
mod machine;
mod outline;
mod table;

pub use about::{About, quoted};
pub use block::{Block, Fact, Finding, Medium, Tone};
pub use figure::{Axis, Figure, Guide, Plot, Point, Scale, Series, Sign, Stroke, Trace};
pub use outline::{Conclusion, Document, Link, Section};
pub use table::{Cell, Column, Kind, OnTerminal, Table};

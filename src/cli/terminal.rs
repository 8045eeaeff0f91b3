//! What the terminal is like.

use clap::ValueEnum;
use std::io::{self, IsTerminal};

/// Columns of a text that goes to a file or a pipe, and the fewest and the most on a terminal.
const PLAIN: usize = 80;
const NARROWEST: usize = 60;
const WIDEST: usize = 120;

/// When to colour.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Color {
    Auto,
    Always,
    Never,
}

impl Color {
    /// Colours only on a terminal, and not where `NO_COLOR` says so.
    pub(crate) fn is_on(self) -> bool {
        match self {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => {
                let unwanted = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
                !unwanted && io::stdout().is_terminal()
            }
        }
    }
}

/// How many columns to fill: the terminal's, within reason.
pub(crate) fn width() -> usize {
    let size = terminal_size::terminal_size_of(io::stdout());
    size.map_or(PLAIN, |(columns, _)| {
        usize::from(columns.0).clamp(NARROWEST, WIDEST)
    })
}

//! Colour, where there is colour.

use crate::document::Tone;

/// How letters look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// As they come.
    Plain,
    /// Headings.
    Bold,
    /// Help for reading.
    Faint,
    /// Green: it passes.
    Good,
    /// Yellow: it neither passes nor fails.
    Open,
    /// Red: it fails.
    Bad,
}

impl Style {
    pub(super) fn of(tone: Tone) -> Self {
        match tone {
            Tone::Good => Style::Good,
            Tone::Open => Style::Open,
            Tone::Bad => Style::Bad,
        }
    }
}

/// Text in a style, where there is colour.
pub(super) fn paint(text: &str, style: Style, color: bool) -> String {
    let code = match style {
        Style::Plain => return text.into(),
        Style::Bold => 1,
        Style::Faint => 2,
        Style::Good => 32,
        Style::Open => 33,
        Style::Bad => 31,
    };
    if !color || text.is_empty() {
        return text.into();
    }
    format!("\u{1b}[{code}m{text}\u{1b}[0m")
}

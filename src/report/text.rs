//! For builders that are no documents yet.

pub use crate::render::terminal::wrap;

/// Narrower than this, lines are cut by the terminal instead.
pub(super) const MIN_WIDTH: usize = 40;

#[derive(Clone, Copy)]
pub(super) enum Style {
    Bold,
    Faint,
    Good,
    Open,
    Bad,
}

/// Text in a style, where there is colour.
pub(super) fn paint(text: &str, style: Style, color: bool) -> String {
    if !color {
        return text.into();
    }
    let code = match style {
        Style::Bold => 1,
        Style::Faint => 2,
        Style::Good => 32,
        Style::Open => 33,
        Style::Bad => 31,
    };
    format!("\u{1b}[{code}m{text}\u{1b}[0m")
}

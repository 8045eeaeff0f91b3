//! Where in a text a byte is, and what stands around it.

/// How many characters of a line are shown on either side of a place.
const CONTEXT: usize = 32;

/// Line and column of a byte, counted from 1 in characters, and the part of the line around it.
pub(super) struct Place {
    pub(super) line: usize,
    pub(super) column: usize,
    pub(super) excerpt: Excerpt,
}

/// Part of a line, and how many characters of it stand before the place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Excerpt {
    shown: String,
    before: usize,
}

impl Place {
    pub(super) fn new(text: &str, at: usize) -> Place {
        let (before, after) = text.split_at_checked(at).unwrap_or((text, ""));
        let (above, before) = before
            .rsplit_once('\n')
            .map_or((None, before), |(above, before)| (Some(above), before));
        let after = after.split('\n').next().unwrap_or("");
        let column = before.chars().count();
        let skipped = column.saturating_sub(CONTEXT);
        let around = before.chars().skip(skipped).chain(after.chars());
        Place {
            line: above.map_or(1, |above| above.matches('\n').count() + 2),
            column: column + 1,
            excerpt: Excerpt {
                shown: around.take(2 * CONTEXT).map(printable).collect(),
                before: column - skipped,
            },
        }
    }
}

impl Excerpt {
    /// Two lines: the excerpt, and a caret under the place.
    pub(super) fn caret(&self) -> String {
        let before = self.before;
        format!("{}\n{:before$}^", self.shown.trim_end(), "")
    }
}

fn printable(c: char) -> char {
    if c.is_control() { ' ' } else { c }
}

/// A text of the file in a message: one line of bounded length.
pub(super) fn quoted(text: &str) -> String {
    let mut shown: String = text.chars().take(2 * CONTEXT).map(printable).collect();
    if text.chars().nth(2 * CONTEXT).is_some() {
        shown.push('…');
    }
    format!("'{shown}'")
}

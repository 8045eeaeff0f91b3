//! How tones look on a page: a class, and a sign beside its colour.

use crate::document::{Fact, Tone};
use maud::{Markup, html};

/// The class of a tone.
pub(super) fn class(tone: Option<Tone>) -> Option<&'static str> {
    tone.map(|tone| match tone {
        Tone::Good => "good",
        Tone::Bad => "bad",
        Tone::Open => "open",
    })
}

/// A class of its own beside that of a tone.
pub(super) fn classes(own: &str, tone: Option<Tone>) -> String {
    match class(tone) {
        Some(tone) => format!("{own} {tone}"),
        None => own.into(),
    }
}

/// A sign beside a tone's colour, which not everybody sees.
pub(super) fn sign(tone: Option<Tone>) -> &'static str {
    match tone {
        Some(Tone::Good) => "✓ ",
        Some(Tone::Bad) => "✗ ",
        Some(Tone::Open) => "○ ",
        None => "",
    }
}

/// Names and what is said of them, one below the other.
pub(super) fn facts(facts: &[Fact]) -> Markup {
    html! {
        dl {
            @for fact in facts {
                dt class=[class(fact.tone)] { (sign(fact.tone)) (fact.name) }
                dd { (fact.value) }
            }
        }
    }
}

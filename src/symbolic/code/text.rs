//! Pieces of an expression as text.

/// How tightly a piece of text holds together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Strength {
    Choice,
    Sum,
    Product,
    Sign,
    Atom,
}

/// An expression as text.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) strength: Strength,
}

impl Text {
    /// What needs no parentheses anywhere.
    pub(super) fn atom(text: impl Into<String>) -> Text {
        Text {
            text: text.into(),
            strength: Strength::Atom,
        }
    }

    /// The text, in parentheses where it holds together less than `least`.
    pub(super) fn at(&self, least: Strength) -> String {
        if self.strength < least {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }
}

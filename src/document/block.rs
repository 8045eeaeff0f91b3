//! The pieces of a section.

use super::{Figure, Table};
use serde::{Deserialize, Serialize};

/// A piece of a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Lines that keep their breaks and spaces, such as formulas and code.
    Lines(String),
    /// Words and what is to be said of them, one below the other.
    Facts(Vec<Fact>),
    /// Something found, worth a paragraph of its own.
    Finding(Finding),
    /// Rows under headings.
    Table(Table),
    /// Curves on axes.
    Figure(Figure),
    /// A piece for some readers alone.
    For(Medium, Box<Block>),
}

impl Block {
    /// The same piece for some readers alone.
    #[must_use]
    pub fn only(self, medium: Medium) -> Self {
        Block::For(medium, Box::new(self))
    }

    /// The piece as readers of these media see it, if they do.
    #[must_use]
    pub fn shown_in(&self, media: &[Medium]) -> Option<&Block> {
        match self {
            Block::For(medium, block) if media.contains(medium) => block.shown_in(media),
            Block::For(..) => None,
            block => Some(block),
        }
    }
}

/// Who reads a piece that is not for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Medium {
    /// People at a terminal, who want the short form.
    Terminal,
    /// Readers of Markdown and of pages, who have room.
    Written,
    /// Readers of Markdown alone.
    Markdown,
    /// Readers of pages alone.
    Page,
    /// Programs that read tables as CSV. Tables for them stand for all others.
    Csv,
    /// Papers set by LaTeX. Tables for them stand for all others.
    Latex,
}

/// A name and what is to be said of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fact {
    /// The name.
    pub name: String,
    /// What is said.
    pub value: String,
    /// Whether that is good or bad, where it is either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tone: Option<Tone>,
}

impl Fact {
    /// A fact that is neither good nor bad.
    #[must_use]
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Fact {
            name: name.into(),
            value: value.into(),
            tone: None,
        }
    }

    /// The same fact, judged.
    #[must_use]
    pub fn toned(self, tone: Tone) -> Self {
        Fact {
            tone: Some(tone),
            ..self
        }
    }
}

/// Something found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Finding {
    /// What it is: "defect", say; may be empty.
    pub label: String,
    /// What was found, in a sentence.
    pub words: String,
    /// Whether that is good or bad, where it is either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tone: Option<Tone>,
}

impl Finding {
    /// A finding that is neither good nor bad.
    #[must_use]
    pub fn new(label: impl Into<String>, words: impl Into<String>) -> Self {
        Finding {
            label: label.into(),
            words: words.into(),
            tone: None,
        }
    }

    /// The same finding, judged.
    #[must_use]
    pub fn toned(self, tone: Tone) -> Self {
        Finding {
            tone: Some(tone),
            ..self
        }
    }

    /// Label and words in one sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        if self.label.is_empty() {
            self.words.clone()
        } else {
            format!("{}: {}", self.label, self.words)
        }
    }
}

/// What a verdict amounts to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// It fails.
    Bad,
    /// It neither passes nor fails.
    Open,
    /// It passes.
    Good,
}

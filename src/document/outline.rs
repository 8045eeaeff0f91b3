//! What a document consists of.

use super::{About, Block, Fact, Medium, Tone, absent};
use serde::{Deserialize, Serialize};

/// A report, whatever it reports and whatever shows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// Which kind of report: letters, digits and dashes, such as `study`; files are named after it.
    pub kind: String,
    /// The heading.
    pub title: String,
    /// What made it.
    pub about: About,
    /// What matters most, in figures: counts of verdicts first.
    pub summary: Vec<Fact>,
    /// What matters most, in a sentence: the last line on a terminal, the first of a text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conclusion: Option<Conclusion>,
    /// All the rest.
    pub sections: Vec<Section>,
    /// Pages beside it.
    pub links: Vec<Link>,
}

impl Document {
    /// A document without content.
    #[must_use]
    pub fn new(kind: impl Into<String>, title: impl Into<String>, about: About) -> Self {
        Document {
            kind: kind.into(),
            title: title.into(),
            about,
            summary: Vec::new(),
            conclusion: None,
            sections: Vec::new(),
            links: Vec::new(),
        }
    }

    /// All blocks, section by section.
    pub fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.sections.iter().flat_map(|section| &section.blocks)
    }

    /// The sections of which readers of these media see anything, each with what they see.
    #[must_use]
    pub fn shown_in(&self, media: &[Medium]) -> Vec<(&Section, Vec<&Block>)> {
        let seen = self.sections.iter().map(|section| {
            let blocks = section.blocks.iter();
            (section, blocks.filter_map(|b| b.shown_in(media)).collect())
        });
        seen.filter(|(_, blocks): &(_, Vec<&Block>)| !blocks.is_empty())
            .collect()
    }
}

/// A sentence that says what came out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Conclusion {
    /// The sentence, without a full stop.
    pub words: String,
    /// Whether that is good or bad, where it is either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tone: Option<Tone>,
}

impl Conclusion {
    /// A conclusion that is neither good nor bad.
    #[must_use]
    pub fn new(words: impl Into<String>) -> Self {
        Conclusion {
            words: words.into(),
            tone: None,
        }
    }

    /// The same conclusion, judged.
    #[must_use]
    pub fn toned(self, tone: Tone) -> Self {
        Conclusion {
            tone: Some(tone),
            ..self
        }
    }
}

/// A part of a document with a heading.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// The place that addresses point to; made safe, and distinct from other sections', where it is shown.
    pub id: String,
    /// The heading; there is none where it is empty.
    pub title: String,
    /// Help for reading, not a result: a terminal shows it in faint letters.
    #[serde(default, skip_serializing_if = "absent::is_default")]
    pub is_aside: bool,
    /// The content; figures that follow each other stand side by side where there is room.
    pub blocks: Vec<Block>,
}

impl Section {
    /// A section without content.
    #[must_use]
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Self {
        Section::of(id, title, [])
    }

    /// A section with its content.
    #[must_use]
    pub fn of(
        id: impl Into<String>,
        title: impl Into<String>,
        blocks: impl IntoIterator<Item = Block>,
    ) -> Self {
        Section {
            id: id.into(),
            title: title.into(),
            is_aside: false,
            blocks: blocks.into_iter().collect(),
        }
    }

    /// The same section as help for reading.
    #[must_use]
    pub fn aside(self) -> Self {
        Section {
            is_aside: true,
            ..self
        }
    }
}

/// A page in the same directory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Link {
    /// The name of its file; shown as a link only where it is a plain name that ends in `.html`.
    pub file: String,
    /// Its heading.
    pub title: String,
}

//! What a page consists of.

use super::{About, Plot, Table};
use serde::{Deserialize, Serialize};

/// A report as a page shows it, whatever it reports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Page {
    /// Which kind of report: letters, digits and dashes, such as `study`; see [`place`](super::place()).
    pub kind: String,
    /// The heading.
    pub title: String,
    /// What made it.
    pub about: About,
    /// What matters most, at the top: verdict counts first.
    pub summary: Vec<Fact>,
    /// All the rest.
    pub sections: Vec<Section>,
    /// Pages beside it.
    pub links: Vec<Link>,
}

impl Page {
    /// A page without content.
    #[must_use]
    pub fn new(kind: impl Into<String>, title: impl Into<String>, about: About) -> Self {
        Page {
            kind: kind.into(),
            title: title.into(),
            about,
            summary: Vec::new(),
            sections: Vec::new(),
            links: Vec::new(),
        }
    }
}

/// A part of a page with a heading.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// The place that addresses point to; made safe, and distinct from other sections', where it is shown.
    pub id: String,
    /// The heading.
    pub title: String,
    /// The content; plots that follow each other stand side by side.
    pub blocks: Vec<Block>,
}

impl Section {
    /// A section without content.
    #[must_use]
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Self {
        Section {
            id: id.into(),
            title: title.into(),
            blocks: Vec::new(),
        }
    }
}

/// A piece of a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Words and what is to be said of them, one below the other.
    Facts(Vec<Fact>),
    /// Rows that can be sorted.
    Table(Table),
    /// Curves on axes.
    Plot(Plot),
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

/// A page in the same directory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Link {
    /// The name of its file; shown as a link only where it is a plain name that ends in `.html`.
    pub file: String,
    /// Its heading.
    pub title: String,
}

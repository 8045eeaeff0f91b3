//! Case files: TOML with exact numbers and expressions in strings.
//!
//! ```toml
//! name = "tent"
//! length = "1"
//! depth = "w*lambda^2"            # of lambda, like field and radiance
//! emission_of_depth = "1 + t"     # of t; extinction, emission and inverse are of s
//!
//! [parameters]                    # optional, used by any expression
//! w = "5/2"
//! ```
//!
//! A file gives one [`Recipe`]. Where there are `[channels.NAME]` tables, `radiance`, `emission` and
//! `emission_of_depth` stand in them. `title`, `tags` and `derivation` are optional and for readers.

mod error;
mod excerpt;
mod expression;
mod message;
mod nesting;
mod problem;
mod recipe;
mod table;
mod text;

pub use error::FileError;
#[cfg(feature = "studies")]
pub(crate) use message::said;
#[cfg(feature = "studies")]
pub(crate) use nesting::{MAX_DOTS, deepest_dot};
pub use problem::FileProblem;
pub use recipe::Recipe;

use crate::symbolic::Expr;
use expression::Parameters;
use rug::Rational;
use std::str::FromStr;
use table::{Entry, Table};
use toml::de::DeTable;

/// The largest file that is read, in bytes.
pub const MAX_FILE: usize = 1 << 20;
/// The most channels a case has.
pub const MAX_CHANNELS: usize = 8;
/// The most characters of a name or a tag.
pub const MAX_NAME: usize = 64;
/// The most characters of a title.
pub const MAX_TITLE: usize = 200;

/// A case as a file describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// In kebab-case.
    pub name: String,
    /// One line, may be empty.
    pub title: String,
    /// In kebab-case.
    pub tags: Vec<String>,
    /// For readers, may be empty.
    pub derivation: String,
    /// D > 0.
    pub length: Rational,
    /// s(λ); λ itself where the file does not say.
    pub field: Expr,
    /// λ(s), where the field is not λ.
    pub inverse: Option<Expr>,
    /// t(λ).
    pub depth: Option<Expr>,
    /// τ(s).
    pub extinction: Option<Expr>,
    /// At least one; one without a name where the file has no `[channels]`.
    pub channels: Vec<ChannelDescription>,
    recipe: Recipe,
}

/// What a file says of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelDescription {
    /// In kebab-case.
    pub name: Option<String>,
    /// I(λ).
    pub radiance: Option<Expr>,
    /// C(s).
    pub emission: Option<Expr>,
    /// C as a function of the depth t.
    pub emission_of_depth: Option<Expr>,
    /// What comes from behind the end of the ray, for kernels that take a background.
    pub background: Option<Rational>,
}

impl Description {
    /// Reads a case file, parameters put into the expressions.
    ///
    /// # Errors
    ///
    /// [`FileError`], with line and column, the problem and what is allowed.
    ///
    /// ```
    /// use volver::case::Description;
    ///
    /// let text = "name = \"bad\"\nlength = 1\ndepth = \"2*x\"\nradiance = \"0\"";
    /// let error = Description::read(text).unwrap_err();
    /// assert_eq!((error.line, error.column), (3, 12));
    /// assert_eq!(error.caret().unwrap(), "depth = \"2*x\"\n           ^");
    /// ```
    pub fn read(text: &str) -> Result<Description, FileError> {
        if text.len() > MAX_FILE {
            let bytes = text.len();
            return Err(FileError::without_place(FileProblem::TooLong { bytes }));
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        nesting::check(text)?;
        let entries = DeTable::parse(text).map_err(|error| {
            let span = error.span().unwrap_or_default();
            let problem = match (error.message(), text.get(span.clone())) {
                ("duplicate key", Some(key)) => FileProblem::DuplicateKey { key: key.into() },
                (message, _) => FileProblem::Syntax {
                    message: message.into(),
                },
            };
            FileError::new(text, span.start, problem)
        })?;
        describe(&Table::top(text, entries.get_ref()))
    }

    /// Which keys the file gives, the same for all channels.
    #[must_use]
    pub fn recipe(&self) -> Recipe {
        self.recipe
    }
}

impl FromStr for Description {
    type Err = FileError;

    fn from_str(text: &str) -> Result<Description, FileError> {
        Description::read(text)
    }
}

const OF_CHANNEL: [&str; 4] = ["radiance", "emission", "emission_of_depth", "background"];

fn describe(top: &Table<'_>) -> Result<Description, FileError> {
    top.allow(&[
        "name",
        "title",
        "tags",
        "derivation",
        "length",
        "field",
        "inverse",
        "depth",
        "extinction",
        "radiance",
        "emission",
        "emission_of_depth",
        "background",
        "parameters",
        "channels",
    ])?;
    let channels = channels(top)?;
    let recipe = recipe::recipe(top, &channels)?;
    let parameters = Parameters::read(top)?;
    let expression = |key, variable| parameters.expression(top, key, variable);
    let of_channel = |table: &Table<'_>| {
        Ok(ChannelDescription {
            name: table.own_key().map(|(name, _)| name.to_string()),
            radiance: parameters.expression(table, "radiance", "lambda")?,
            emission: parameters.expression(table, "emission", "s")?,
            emission_of_depth: parameters.expression(table, "emission_of_depth", "t")?,
            background: match table.entry("background") {
                Some(entry) => Some(expression::background(&entry)?),
                None => None,
            },
        })
    };
    Ok(Description {
        name: top.required("name")?.name()?.to_string(),
        title: text::title(top)?,
        tags: text::tags(top)?,
        derivation: match top.entry("derivation") {
            Some(entry) => entry.text()?.to_string(),
            None => String::new(),
        },
        length: expression::length(&top.required("length")?)?,
        field: expression("field", "lambda")?.unwrap_or_else(|| Expr::symbol("lambda")),
        inverse: expression("inverse", "s")?,
        depth: expression("depth", "lambda")?,
        extinction: expression("extinction", "s")?,
        channels: channels
            .iter()
            .map(of_channel)
            .collect::<Result<_, FileError>>()?,
        recipe,
    })
}

/// The tables of the channels, in the order of the file; the file itself without `[channels]`.
fn channels<'f>(top: &Table<'f>) -> Result<Vec<Table<'f>>, FileError> {
    let Some(entry) = top.entry("channels") else {
        return Ok(vec![top.clone()]);
    };
    let entries = entry.table()?.entries();
    let count = entries.len();
    if !(1..=MAX_CHANNELS).contains(&count) {
        return Err(entry.error(FileProblem::ChannelCount { count }));
    }
    if let Some(outside) = OF_CHANNEL.iter().find_map(|key| top.entry(key)) {
        let key = outside.path().into();
        return Err(outside.error(FileProblem::OutsideChannels { key }));
    }
    let channel = |entry: &Entry<'f>| {
        text::check_name(entry.name_of_key()).map_err(|problem| entry.error(problem))?;
        let table = entry.table()?;
        table.allow(&OF_CHANNEL)?;
        Ok(table)
    };
    entries.iter().map(channel).collect()
}

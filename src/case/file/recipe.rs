//! Which keys of a file go together.

use super::table::{Entry, Table};
use super::{FileError, FileProblem};

/// What a file gives, and what follows from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recipe {
    /// Depth and radiance: extinction and emission follow.
    DepthAndRadiance,
    /// Depth and emission as a function of it: extinction and radiance follow. A radiance given is a claim.
    EmissionOfDepth,
    /// Extinction and emission with the depth and the radiance that have to be proved.
    Claimed,
    /// Extinction and emission alone: nothing is claimed of the depth and the radiance.
    Medium,
}

/// The keys of all recipes, for messages.
pub(super) const ALLOWED: &str = "depth and radiance, or depth and emission_of_depth, both with field and \
     inverse or neither; or depth, radiance, extinction and emission, with or without field; or extinction \
     and emission alone, with or without field";

impl Recipe {
    /// The keys that it needs, of the case and of each channel.
    fn keys(self) -> (&'static [&'static str], &'static [&'static str]) {
        match self {
            Recipe::DepthAndRadiance => (&["depth"], &["radiance"]),
            Recipe::EmissionOfDepth => (&["depth"], &["emission_of_depth"]),
            Recipe::Claimed => (&["extinction", "depth"], &["emission", "radiance"]),
            Recipe::Medium => (&["extinction"], &["emission"]),
        }
    }
}

/// The recipe of a file whose channels are the tables `channels`.
pub(super) fn recipe<'f>(top: &Table<'f>, channels: &[Table<'f>]) -> Result<Recipe, FileError> {
    let find = |key: &str| channels.iter().find_map(|table| table.entry(key));
    let medium = top.entry("extinction").or_else(|| find("emission"));
    let is_claimed = top.entry("depth").is_some() || find("radiance").is_some();
    let recipe = match (medium, find("emission_of_depth")) {
        (Some(a), Some(b)) => return Err(excluded(a, b)),
        (Some(_), None) if is_claimed => Recipe::Claimed,
        (Some(_), None) => Recipe::Medium,
        (None, Some(_)) => Recipe::EmissionOfDepth,
        (None, None) => Recipe::DepthAndRadiance,
    };
    for channel in channels {
        complete(recipe, top, channel)?;
    }
    let (field, inverse) = (top.entry("field"), top.entry("inverse"));
    match (recipe, field, inverse, top.entry("extinction")) {
        (Recipe::Claimed | Recipe::Medium, _, Some(inverse), Some(extinction)) => {
            Err(excluded(inverse, extinction))
        }
        (Recipe::DepthAndRadiance | Recipe::EmissionOfDepth, Some(field), None, _) => {
            Err(incomplete(&field, top.path("inverse")))
        }
        (_, None, Some(inverse), _) => Err(incomplete(&inverse, top.path("field"))),
        _ => Ok(recipe),
    }
}

/// Refuses a channel without one of the keys that the recipe needs.
fn complete(recipe: Recipe, top: &Table<'_>, channel: &Table<'_>) -> Result<(), FileError> {
    let (of_case, of_channel) = recipe.keys();
    let missing = |table: &Table<'_>, keys: &[&str]| -> Vec<String> {
        let keys = keys.iter().filter(|key| table.entry(key).is_none());
        keys.map(|key| table.path(key)).collect()
    };
    let missing_of_channel = missing(channel, of_channel);
    let in_channel = channel
        .own_key()
        .map(|(_, at)| at)
        .filter(|_| !missing_of_channel.is_empty());
    let missing = [missing(top, of_case), missing_of_channel].concat();
    if missing.is_empty() {
        return Ok(());
    }
    let mut given: Vec<Entry<'_>> = of_case
        .iter()
        .filter_map(|key| top.entry(key))
        .chain(of_channel.iter().filter_map(|key| channel.entry(key)))
        .collect();
    given.sort_by_key(Entry::at);
    let problem = FileProblem::Incomplete {
        missing,
        given: given.iter().map(|entry| entry.path().into()).collect(),
    };
    Err(match (in_channel, given.first()) {
        (Some(at), _) => top.error(at, problem),
        (None, Some(entry)) => entry.error(problem),
        (None, None) => FileError::without_place(problem),
    })
}

/// An entry that asks for another one.
fn incomplete(given: &Entry<'_>, missing: String) -> FileError {
    given.error(FileProblem::Incomplete {
        missing: vec![missing],
        given: vec![given.path().into()],
    })
}

/// Two entries that do not go together, with the place of the later one.
fn excluded(a: Entry<'_>, b: Entry<'_>) -> FileError {
    let (first, second) = if a.at() < b.at() { (a, b) } else { (b, a) };
    second.error(FileProblem::Excluded {
        key: second.path().into(),
        other: first.path().into(),
    })
}

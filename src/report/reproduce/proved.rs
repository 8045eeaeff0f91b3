//! The theorems behind the orders that entries expect.

use super::words;
use crate::method::Theorem;
use crate::study::reproduce::Entry;

/// More entries than these are counted, not named.
const NAMED: usize = 3;

/// Each theorem and the entries it is behind, in order of appearance; last, with no theorem, the rest.
pub(super) fn theorems<'a>(
    entries: impl Iterator<Item = &'a Entry>,
) -> Vec<(Option<Theorem>, String)> {
    let mut groups: Vec<(Option<Theorem>, Vec<String>)> = Vec::new();
    for entry in entries {
        // Of which order it is does not matter: the theorem is the same.
        let same = |other: Option<Theorem>| other.map(|t| t.name) == entry.theorem.map(|t| t.name);
        let name = words::name(entry);
        match groups.iter_mut().find(|(theorem, _)| same(*theorem)) {
            Some((_, names)) => names.push(name),
            None => groups.push((entry.theorem, vec![name])),
        }
    }
    groups.sort_by_key(|(theorem, _)| theorem.is_none());
    let said = |names: Vec<String>| match names.len() {
        count if count > NAMED => format!("{count} entries"),
        _ => names.join(", "),
    };
    groups
        .into_iter()
        .map(|(theorem, names)| (theorem, said(names)))
        .collect()
}

/// "`nested_bound` (proofs/theory/Nested.v)", or that there is none.
pub(super) fn name(theorem: Option<Theorem>) -> String {
    theorem.map_or("no theorem".into(), |theorem| theorem.to_string())
}

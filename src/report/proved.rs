//! The theorems behind the orders that entries expect.

use super::legend;
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
        let name = legend::name(entry);
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

#[cfg(test)]
mod tests {
    use super::super::fixture::entry;
    use super::*;

    #[test]
    fn entries_stand_with_their_theorem_and_the_rest_last() {
        let of = |row, theorem| Entry {
            theorem,
            ..entry(row, "boole")
        };
        let [riemann, .., nested, _, _, _] = Theorem::ALL;
        let other_order = Theorem { order: 6, ..nested };
        let entries = [
            of("monte-carlo", None),
            of("riemann", Some(riemann)),
            of("a", Some(nested)),
            of("b", Some(other_order)),
            of("c", Some(nested)),
            of("d", Some(nested)),
        ];
        let said = theorems(entries.iter());
        let said: Vec<_> = said.iter().map(|(t, of)| (name(*t), of.as_str())).collect();
        assert_eq!(
            said,
            [
                (riemann.to_string(), "riemann × boole"),
                (nested.to_string(), "4 entries"),
                ("no theorem".to_string(), "monte-carlo × boole"),
            ]
        );
    }
}

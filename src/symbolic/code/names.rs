//! Names that nothing else has.

use super::layout::Layout;
use std::collections::HashSet;

/// The names that are taken in one scope.
#[derive(Clone)]
pub(super) struct Names<'l> {
    layout: &'l dyn Layout,
    taken: HashSet<String>,
}

impl<'l> Names<'l> {
    pub(super) fn new(layout: &'l dyn Layout) -> Self {
        Names {
            layout,
            taken: HashSet::new(),
        }
    }

    fn take(&mut self, name: &str) -> bool {
        !self.layout.reserved(name) && self.taken.insert(name.into())
    }

    /// Names like the `wanted` ones, in their order.
    pub(super) fn claim(&mut self, wanted: &[&str]) -> Vec<String> {
        // What can stay as it is comes first, so that `lambda` gives way to a `lambda_` after it.
        let kept: Vec<bool> = wanted
            .iter()
            .map(|name| identifier(name) == **name && self.take(name))
            .collect();
        let mut names = Vec::new();
        for (name, kept) in wanted.iter().zip(kept) {
            let mut name = identifier(name);
            while !kept && !self.take(&name) {
                name.push('_');
            }
            names.push(name);
        }
        names
    }

    /// The next free one of t1, t2, ….
    pub(super) fn local(&mut self, last: &mut usize) -> String {
        loop {
            *last += 1;
            let name = format!("t{last}");
            if self.take(&name) {
                return name;
            }
        }
    }
}

/// The text with only what identifiers may have.
fn identifier(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = name.chars().map(letter).collect();
    if name.starts_with(|c: char| !c.is_ascii_digit()) {
        name
    } else {
        format!("_{name}")
    }
}

/// Whether `name` is one of the words of a list.
pub(super) fn listed(words: &str, name: &str) -> bool {
    words.split_ascii_whitespace().any(|word| word == name)
}

//! What the files of figures are called.

use std::collections::HashSet;

/// Longer names are cut: file systems have limits.
const MOST: usize = 100;

/// Names that were given; no two are alike.
#[derive(Default)]
pub(super) struct FileNames(HashSet<String>);

impl FileNames {
    /// "parts-sine-squared-simpson-boole", with a number behind it where that is taken.
    pub(super) fn next(&mut self, kind: &str, of: &[&str]) -> String {
        let parts = std::iter::once(kind.to_string()).chain(of.iter().map(|name| safe(name)));
        let stem = parts.collect::<Vec<_>>().join("-");
        let numbered = (2_u64..).map(|k| format!("{stem}-{k}"));
        let mut names = std::iter::once(stem.clone()).chain(numbered);
        let free = names.find(|name| self.0.insert(name.clone()));
        free.unwrap_or(stem)
    }
}

/// Lower-case letters, digits and single dashes between them, which every file system takes.
fn safe(name: &str) -> String {
    let mut safe = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            safe.push(c.to_ascii_lowercase());
        } else if !safe.is_empty() && !safe.ends_with('-') {
            safe.push('-');
        }
    }
    safe.truncate(MOST);
    safe.trim_end_matches('-').to_string()
}

//! Which figures there are, and what their files are called.

use crate::study::sweep::{Line, Results};
use std::collections::HashSet;

/// A figure of one case and one method.
pub(super) struct Figure<'r> {
    /// The name of its file.
    pub(super) file: String,
    pub(super) case: &'r str,
    pub(super) method: &'r str,
    pub(super) lines: Vec<&'r Line>,
    /// A map of digits, not a plot of parts.
    pub(super) is_map: bool,
}

/// All figures, in the order of the study; no two have the same file.
pub(super) fn figures(results: &Results) -> Vec<Figure<'_>> {
    let mut taken = HashSet::new();
    let mut figures = Vec::new();
    let mut add = |(case, method, lines): (_, _, Vec<_>), is_map: bool| {
        if lines.is_empty() {
            return;
        }
        let kind = if is_map { "digits" } else { "parts" };
        let stem = format!("{kind}-{}-{}", safe(case), safe(method));
        let numbered = (2_u64..).map(|k| format!("{stem}-{k}"));
        let mut names = std::iter::once(stem.clone()).chain(numbered);
        let file = names.find(|name| taken.insert(name.clone()));
        figures.push(Figure {
            file: format!("{}.svg", file.unwrap_or(stem)),
            case,
            method,
            lines,
            is_map,
        });
    };
    results.groups().for_each(|group| add(group, false));
    results.maps().for_each(|map| add(map, true));
    figures
}

/// Lower-case letters, digits and single dashes between them, which every file system takes.
pub(in crate::report) fn safe(name: &str) -> String {
    let mut safe = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            safe.push(c.to_ascii_lowercase());
        } else if !safe.is_empty() && !safe.ends_with('-') {
            safe.push('-');
        }
    }
    let most = safe.len().min(100);
    safe[..most].trim_end_matches('-').to_string()
}

#[cfg(test)]
mod tests {
    use super::safe;

    #[test]
    fn names_are_safe_for_every_file_system() {
        assert_eq!(safe("rgb-transfer/red"), "rgb-transfer-red");
        assert_eq!(
            safe("trapezoid × simpson, linear exponential"),
            "trapezoid-simpson-linear-exponential"
        );
        assert_eq!(safe("../Ä:*x "), "x");
        assert_eq!(safe(&"a/".repeat(200)).len(), 99);
    }
}

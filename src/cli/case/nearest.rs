//! Names that somebody may have meant.

/// The most names given.
const MOST: usize = 3;

/// The known names that a few typing mistakes or missing ends make of `name`, the nearest first.
pub(super) fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Vec<&'n str> {
    // Longer than any name: not worth comparing.
    if name.len() > 100 {
        return Vec::new();
    }
    let mistakes = (name.chars().count() / 3).max(1);
    let mut near: Vec<(usize, &str)> = known
        .filter_map(|candidate| {
            let distance = distance(name, candidate);
            let part = name.len() >= 3 && candidate.contains(name);
            (distance <= mistakes || part).then_some((distance, candidate))
        })
        .collect();
    near.sort_unstable();
    near.into_iter().take(MOST).map(|(_, name)| name).collect()
}

/// How many letters to insert, to leave out or to replace to make one text the other.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut next = vec![i + 1];
        let mut left = i + 1;
        for (other, ends) in b.chars().zip(row.windows(2)) {
            let [diagonal, above] = ends else { continue };
            let replaced = diagonal + usize::from(letter != other);
            left = replaced.min(above + 1).min(left + 1);
            next.push(left);
        }
        row = next;
    }
    row.last().copied().unwrap_or(0)
}

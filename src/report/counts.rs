//! Verdicts, counted.

use crate::document::{Fact, Tone};

/// How often each verdict occurs, the most frequent first, in the worst of its tones.
pub(super) fn counts(verdicts: impl IntoIterator<Item = (String, Tone)>) -> Vec<Fact> {
    let mut counts: Vec<(String, Tone, usize)> = Vec::new();
    for (verdict, tone) in verdicts {
        match counts.iter_mut().find(|(known, ..)| *known == verdict) {
            Some((_, worst, count)) => {
                *worst = tone.min(*worst);
                *count += 1;
            }
            None => counts.push((verdict, tone, 1)),
        }
    }
    counts.sort_by_key(|(_, _, count)| std::cmp::Reverse(*count));
    let fact = |(verdict, tone, count): (String, Tone, usize)| {
        Fact::new(verdict, count.to_string()).toned(tone)
    };
    counts.into_iter().map(fact).collect()
}

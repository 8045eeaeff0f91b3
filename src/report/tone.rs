//! On a page a verdict is as good or bad as on a terminal.

use super::text::Style;
use crate::document::{Fact, Tone};

pub(super) fn tone(style: Style) -> Tone {
    match style {
        Style::Good => Tone::Good,
        Style::Bad => Tone::Bad,
        Style::Bold | Style::Faint | Style::Open => Tone::Open,
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_has_its_worst_tone() {
        let verdict = |name: &str, tone| (name.to_string(), tone);
        let facts = counts([
            verdict("Stalled", Tone::Open),
            verdict("Exact", Tone::Good),
            verdict("Exact", Tone::Bad),
        ]);
        assert_eq!(
            facts,
            [
                Fact::new("Exact", "2").toned(Tone::Bad),
                Fact::new("Stalled", "1").toned(Tone::Open)
            ]
        );
    }
}

//! The words that reports share: figures, names of entries, what a verdict means.

use crate::convergence::Verdict;
use crate::study::reproduce::Entry;

/// What stands where there is no figure.
const NONE: &str = "-";

/// "simpson × boole".
pub(super) fn name(entry: &Entry) -> String {
    format!("{} × {}", entry.row, entry.column)
}

/// The paper's figure, with the digits it prints.
pub(super) fn paper(entry: &Entry) -> String {
    two_decimals(entry.paper)
}

/// What the paper's protocol gives here.
pub(super) fn protocol(entry: &Entry) -> String {
    two_decimals(entry.protocol_order)
}

fn two_decimals(order: Option<f64>) -> String {
    order.map_or(NONE.into(), |p| format!("{p:.2}"))
}

/// "4.003 ± 0.009", with a fourth decimal where the third would make the interval 0; without a window the last pair's
/// order, which has no interval: "~4.40".
pub(super) fn order(entry: &Entry) -> String {
    match (entry.asymptotic_order, entry.asymptotic_half_width) {
        (Some(order), _) if entry.window.is_none() => format!("~{order:.2}"),
        (Some(order), Some(half_width)) if half_width < 0.0005 => {
            format!("{order:.4} ± {half_width:.4}")
        }
        (Some(order), Some(half_width)) => format!("{order:.3} ± {half_width:.3}"),
        (Some(order), None) => format!("{order:.3}"),
        (None, _) => NONE.into(),
    }
}

/// "512 … 4096".
pub(super) fn window(entry: &Entry) -> String {
    let span = |(first, last)| format!("{first} … {last}");
    entry.window.map_or(NONE.into(), span)
}

/// One line, for people who have not read the manual.
pub(super) fn meaning(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Confirmed => "the order expected lies in the interval, which is narrow",
        Verdict::TooLow => "the order lies below the one expected",
        Verdict::TooHigh => {
            "the order lies above the one expected: the case does not test the method"
        }
        Verdict::PreAsymptotic => "no order yet: finer levels are needed",
        Verdict::FloorLimited => "roundoff ends the levels before an order shows",
        Verdict::Exact => "no error above the roundoff floor",
        Verdict::Stalled => "the error stays where it is: the method does not converge",
        Verdict::Oscillatory => "the error changes sign where its order should show",
        Verdict::Diverged => "the error grows as the step shrinks",
        Verdict::TooFewLevels => "fewer than four levels say nothing",
        Verdict::NotFinite => "an error is not a finite number",
        Verdict::Blind => "the case hides the method's leading error: neither passed nor failed",
        Verdict::Fitted => "an order was found where none was expected",
    }
}

/// What the columns of a document say; a word and its meaning each.
pub(super) const WORDS: [(&str, &str); 3] = [
    (
        "protocol",
        "the paper's way, here: the slope of one line through log|error| at all of n = 8 … 1024 in binary64, \
         roundoff and all. With replicas, of the first run alone",
    ),
    (
        "order",
        "the asymptotic order, fitted only at the levels where neighbouring levels agree and roundoff is far away, \
         ± half of its interval. With replicas it is the order of the standard deviation; of the bias where that is \
         lower. Without levels it is that of the last pair, and ± is a spread",
    ),
    (
        "levels n",
        "the first and the last level of that fit. In the plots their marks are filled",
    ),
];

/// How often each verdict occurs, the most frequent first, equals in order of appearance.
pub(super) fn counts(entries: &[Entry]) -> Vec<(Verdict, usize)> {
    let mut counts: Vec<(Verdict, usize)> = Vec::new();
    for entry in entries {
        match counts.iter_mut().find(|(v, _)| *v == entry.verdict) {
            Some((_, count)) => *count += 1,
            None => counts.push((entry.verdict, 1)),
        }
    }
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    counts
}

/// "3 entries: 2 Confirmed, 1 Stalled".
pub(super) fn summary(entries: &[Entry]) -> String {
    let noun = if entries.len() == 1 {
        "entry"
    } else {
        "entries"
    };
    let counts: Vec<String> = counts(entries)
        .into_iter()
        .map(|(verdict, count)| format!("{count} {verdict}"))
        .collect();
    let colon = if counts.is_empty() { "" } else { ": " };
    format!("{} {noun}{colon}{}", entries.len(), counts.join(", "))
}

//! For a terminal: rows as they come, then what they say.

use super::words::{
    NONE, bars, conclusion, failure, failures, fingerprint, floor, label, order, sign, theory,
    window,
};
use crate::report::text::{MIN_WIDTH, Style, paint, wrap};
use crate::study::verify::{Conclusion, Line, Standing, Verification};
use std::fmt::Write;

/// Columns and their widths: with the longest verdict behind them they fill 80 columns.
const NAME: usize = 22;
const THEORY: usize = 5;
const ORDER: usize = 11;
const WINDOW: usize = 8;
const FLOOR: usize = 5;
const BARS: usize = 8;
/// What blind is.
const BLIND: &str = "blind: the case hides the leading error of what was declared";
/// Failures shown of one channel.
const FAILURES: usize = 2;

/// The names of the columns, above the first [`row`].
#[must_use]
pub fn heading(color: bool) -> String {
    let columns = columns(["case", "order", "measured", "window", "floor", "errors"]);
    let head = format!("  {columns} verdict");
    paint(&head, Style::Faint, color) + "\n"
}

fn columns([name, theory, order, window, floor, errors]: [&str; 6]) -> String {
    format!(
        "{name:<NAME$} {theory:<THEORY$} {order:<ORDER$} {window:<WINDOW$} {floor:<FLOOR$} {errors:<BARS$}"
    )
}

/// One channel: the order promised and measured, the window, the floor, the errors as bars, the verdict; failures below.
#[must_use]
pub fn row(line: &Line, width: usize, color: bool) -> String {
    let measured = order(line).replace(" ± ", "±");
    let columns = columns([
        &line.name,
        &theory(line.expected),
        &measured,
        &window(line),
        &floor(line),
        &thinned(&bars(line)),
    ]);
    let style = style(line.standing);
    let verdict = match line.standing {
        Standing::Failed => "failed",
        _ => line.measured.verdict().name(),
    };
    let sign = sign(line.standing).to_string();
    let mut text = format!(
        "{} {columns} {}\n",
        paint(&sign, style, color),
        paint(verdict, style, color)
    );
    let mut shown: Vec<String> = Vec::new();
    let groups = failures(line);
    shown.extend(groups.iter().take(FAILURES).map(failure));
    let left = groups.iter().skip(FAILURES);
    match left.map(|(levels, _)| levels.len()).sum() {
        0 => {}
        1 => shown.push("and 1 level more".into()),
        left => shown.push(format!("and {left} levels more")),
    }
    if !line.steady {
        shown.push("two answers to the coarsest level differ".into());
    }
    for words in shown {
        for line in wrap(&words, width.max(MIN_WIDTH), "    ", "      ") {
            // Writing to a String does not fail.
            let _ = writeln!(text, "{}", paint(&line, Style::Open, color));
        }
    }
    text
}

/// As many bars as there is room for, evenly over the levels and with the finest.
fn thinned(bars: &str) -> String {
    let count = bars.chars().count();
    let every = count.div_ceil(BARS).max(1);
    let kept = |index: &usize| (count - 1 - index).is_multiple_of(every);
    let bars = bars.chars().enumerate();
    bars.filter(|(index, _)| kept(index))
        .map(|(_, bar)| bar)
        .collect()
}

/// What the rows say: the fingerprint, defects by name, a legend, and the summary in the last line.
#[must_use]
pub fn closing(verification: &Verification, width: usize, color: bool) -> String {
    let width = width.max(MIN_WIDTH);
    let mut text = String::from("\n");
    let mut say = |words: &str, first: &str, style: Style| {
        let later = " ".repeat(first.chars().count());
        for line in wrap(words, width, first, &later) {
            let _ = writeln!(text, "{}", paint(&line, style, color));
        }
    };
    let deviates = verification
        .fingerprint
        .as_ref()
        .is_some_and(crate::diagnosis::Fingerprint::contradicts_declaration);
    for (index, sentence) in fingerprint(verification).iter().enumerate() {
        let style = if deviates && index != 1 {
            Style::Bad
        } else {
            Style::Bold
        };
        say(sentence, if index == 0 { "" } else { "  " }, style);
    }
    for finding in &verification.findings {
        let channels = match &finding.channels[..] {
            [] => NONE.into(),
            channels if channels.len() > 6 => {
                format!("{} channels", channels.len())
            }
            channels => channels.join(", "),
        };
        let words = format!("{} ({channels})", finding.defect);
        say(&words, label(verification), Style::Bold);
    }
    let legend = "✓ confirmed, ✗ contradicted, ? inconclusive, · blind, ! failed";
    say(legend, "", Style::Faint);
    if verification.counts().blind > 0 {
        say(BLIND, "", Style::Faint);
    }
    let style = match verification.conclusion() {
        Conclusion::Confirmed => Style::Good,
        Conclusion::NotConfirmed | Conclusion::CouldNotRun => Style::Bad,
    };
    say(&conclusion(verification), "", style);
    text
}

pub(super) fn style(standing: Standing) -> Style {
    match standing {
        Standing::Confirmed => Style::Good,
        Standing::Contradicted | Standing::Failed => Style::Bad,
        Standing::Inconclusive | Standing::Blind => Style::Open,
    }
}

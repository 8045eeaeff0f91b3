//! The words of the report.

use super::whole;
use crate::study::extremes::{Answer, Cell, Extremes};
use rug::Float;

/// What stands where there is no figure.
pub(super) const NONE: &str = "-";

/// How to read a figure.
pub(super) const FIGURES: &str = "7/3: 7 digits of what the method gives without rounding, 3 of the truth; = all \
of them, more than 17; ? unknown; ! fewer than format and method promise";

/// What is said of a rule that is not exact in an even medium.
pub(super) const RULE: &str = "the rule is not exact where C and tau are the same everywhere; its answers may be \
off by (tau d)^order there, and by anything where tau d > 1";

/// "7/3", or what stands in place of digits.
pub(super) fn figure(cell: &Cell) -> String {
    let mark = if cell.is_fault { "!" } else { "" };
    match cell.answer.filter(|answer| answer.stands_alone()) {
        Some(answer) => format!("{answer}{mark}"),
        None => format!("{}/{}{mark}", whole(cell.digits), whole(cell.against_truth)),
    }
}

/// To four digits.
pub(super) fn number(value: &Float) -> String {
    if value.is_zero() {
        return "0".into();
    }
    if !value.is_finite() {
        return value.to_f64().to_string();
    }
    // Beyond binary64 too.
    format!("{value:.3e}")
}

/// "wrong in 3 of 16 answers", and how many are right.
pub(super) fn summary(extremes: &Extremes) -> String {
    let (wrong, of) = (extremes.faults().count(), extremes.cells.len());
    if wrong == 0 {
        format!("{of} answers: all have the digits that format and method promise")
    } else {
        format!("{of} answers: {wrong} have fewer digits than format and method promise, or none")
    }
}

/// What is wrong, and with which answers; those with the same reason together.
pub(super) fn accusations(extremes: &Extremes) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for cell in extremes.faults() {
        let Some(reason) = cell.reason.as_deref() else {
            all.push((cell.name(), accusation(cell)));
            continue;
        };
        match reasons.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, names)) => names.push(cell.name()),
            None => reasons.push((reason, vec![cell.name()])),
        }
    }
    let of = |(reason, names): (&str, Vec<String>)| (names.join(", "), reason.to_string());
    all.extend(reasons.into_iter().map(of));
    all
}

/// What is wrong with one answer.
fn accusation(cell: &Cell) -> String {
    match cell.answer {
        Some(Answer::NotANumber) => format!("NaN, where the truth is {}", truth(cell)),
        Some(Answer::Infinite) => format!("an infinity, where the truth is {}", truth(cell)),
        _ => {
            let value = cell.value.as_ref().map_or(NONE.into(), number);
            let said = format!("{value}, where the truth is {}", truth(cell));
            // Of 0 there are no digits.
            let promised = cell.promised.filter(|promised| *promised >= 0.1);
            match promised {
                Some(promised) if cell.digits.is_some() => {
                    let digits = whole(cell.digits);
                    format!("{said}: {digits} digits of {promised:.1} promised")
                }
                _ => said,
            }
        }
    }
}

fn truth(cell: &Cell) -> String {
    cell.truth.as_ref().map_or("finite".into(), number)
}

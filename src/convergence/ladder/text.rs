//! Ladders as text, both ways.

use super::{Ladder, LadderError, Levels};
use std::fmt;
use std::str::FromStr;

impl FromStr for Ladder {
    type Err = LadderError;

    fn from_str(text: &str) -> Result<Self, LadderError> {
        let number = |part: &str| -> Result<u64, LadderError> {
            let part = part.trim();
            let digits = !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
            part.parse()
                .ok()
                .filter(|_| digits)
                .ok_or_else(|| LadderError::NotANumber {
                    text: text.into(),
                    value: part.into(),
                })
        };
        let form = || LadderError::Form { text: text.into() };
        if text.trim().is_empty() {
            return Err(form());
        }
        if let Some(list) = text.trim().strip_prefix("d=") {
            let steps: Result<Vec<f64>, _> = list.split(',').map(|s| s.trim().parse()).collect();
            return Self::steps(steps.map_err(|_| form())?);
        }
        if let Some((first, rest)) = text.split_once("..") {
            let (last, ratio) = match rest.split_once('x') {
                Some((last, ratio)) => (last, number(ratio)?),
                None => (rest, 2),
            };
            return Self::range(number(first)?, number(last)?, ratio);
        }
        if text.contains(',') {
            let list: Result<Vec<u64>, _> = text.split(',').map(number).collect();
            return Self::segments(list?);
        }
        let only = number(text).map_err(|_| form())?;
        Self::segments(vec![only])
    }
}

impl fmt::Display for Ladder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match &self.levels {
            Levels::Segments(list) => match (geometric_ratio(list), &list[..]) {
                (Some(2), [first, .., last]) => format!("{first}..{last}"),
                (Some(ratio), [first, .., last]) => format!("{first}..{last}x{ratio}"),
                _ => join(list),
            },
            Levels::Steps(list) => format!("d={}", join(list)),
        };
        f.pad(&text)
    }
}

/// The whole ratio that every level has to the one before; `None` where there is none.
fn geometric_ratio(list: &[u64]) -> Option<u64> {
    let [first, second, ..] = list else {
        return None;
    };
    let ratio = second / first;
    let constant = list
        .windows(2)
        .all(|pair| pair[0].checked_mul(ratio) == Some(pair[1]));
    constant.then_some(ratio)
}

/// Numbers with commas between them.
fn join<T: fmt::Display>(list: &[T]) -> String {
    let texts: Vec<String> = list.iter().map(T::to_string).collect();
    texts.join(",")
}

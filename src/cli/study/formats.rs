//! Which formats.

use super::asked::{Asked, Asking, split};
use crate::cli::Failure;
use std::ops::RangeInclusive;
use std::str::FromStr;
use volver::real::FormatName;

/// Where --sweep-bits may go: an axis has no room for more.
const SWEEP: RangeInclusive<u32> = 2..=256;

/// The formats of a study.
pub(in crate::cli) struct Formats {
    pub(in crate::cli) names: Vec<FormatName>,
    /// Of each whether it is there for the map of digits alone.
    pub(in crate::cli) swept: Vec<bool>,
    pub(in crate::cli) bits: Option<RangeInclusive<u32>>,
}

pub(in crate::cli) fn chosen(
    asking: &Asking,
    given: &[String],
    sweep: Option<&str>,
) -> Result<Formats, Failure> {
    let asked = asking.names(
        "--formats",
        given,
        asking.file.formats.as_ref(),
        "formats",
        names,
    )?;
    let mut formats = Vec::new();
    for name in asked.into_iter().flatten() {
        let format = FormatName::from_str(&name.text).map_err(|error| name.refused(error))?;
        if formats.contains(&format) {
            let why = format!("'{format}' a second time (allowed: each format once)");
            return Err(name.refused(why));
        }
        formats.push(format);
    }
    if formats.is_empty() {
        formats = vec![FormatName::F32, FormatName::F64];
    }
    let mut swept = vec![false; formats.len()];
    let bits = sweep_bits(asking, sweep)?;
    for bits in bits.iter().cloned().flatten() {
        let format = FormatName::Mpfr(bits);
        if !formats.contains(&format) {
            formats.push(format);
            swept.push(true);
        }
    }
    Ok(Formats {
        names: formats,
        swept,
        bits,
    })
}

/// A..B.
fn sweep_bits(
    asking: &Asking,
    given: Option<&str>,
) -> Result<Option<RangeInclusive<u32>>, Failure> {
    let asked = match (given, &asking.file.sweep_bits) {
        (Some(text), _) => Asked {
            text: text.into(),
            at: "--sweep-bits".into(),
            directory: None,
        },
        (None, Some(text)) => Asked {
            text: text.get_ref().clone(),
            at: asking.place(text),
            directory: None,
        },
        (None, None) => return Ok(None),
    };
    let ends = asked.text.split_once("..").and_then(|(first, last)| {
        let number = |text: &str| text.trim().parse().ok().filter(|bits| SWEEP.contains(bits));
        number(first)
            .zip(number(last))
            .filter(|(first, last)| first <= last)
    });
    let (first, last) = ends.ok_or_else(|| {
        asked.refused(format!(
            "'{}' is no range of bits (allowed: A..B with {} ≤ A ≤ B ≤ {})",
            asked.shown(),
            SWEEP.start(),
            SWEEP.end()
        ))
    })?;
    Ok(Some(first..=last))
}

/// The names in a list: a number behind a comma belongs to the format before it, as in `ieee:11,-14,15`.
pub(in crate::cli) fn names(text: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for part in split(text) {
        let is_number = part.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+');
        match names.last_mut() {
            Some(name) if is_number => {
                name.push(',');
                name.push_str(&part);
            }
            _ => names.push(part),
        }
    }
    names
}

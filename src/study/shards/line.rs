//! Lines with a sum of their own, so that one that was cut off or changed is seen.

use super::key::Key;
use crate::input;
use serde::Serialize;
use std::io::{self, BufRead, Read};

const BEFORE: &str = "{\"sum\":\"";
const BEHIND: &str = "\",";

/// An object as one line of JSON whose first member is the sum of the others' text.
pub(super) fn sealed(value: &impl Serialize) -> String {
    // Records are made of text and numbers, which always have a form.
    let text = serde_json::to_string(value).unwrap_or_default();
    let members = text.strip_prefix('{').unwrap_or(&text);
    format!("{BEFORE}{}{BEHIND}{members}\n", Key::of([members]))
}

/// The object of a line, its sum left out; `None` where that is not the sum of the rest.
pub(super) fn opened(line: &[u8]) -> Option<String> {
    let line = std::str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (sum, members) = line.strip_prefix(BEFORE)?.split_once(BEHIND)?;
    let sum: Key = sum.parse().ok()?;
    (sum == Key::of([members])).then(|| format!("{{{members}"))
}

/// The next line with its end, where it has one; empty at the end of the file. Of a line beyond what a program writes, as much as
/// that.
pub(super) fn next(reader: &mut impl BufRead) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.take(input::COMPUTED).read_until(b'\n', &mut bytes)?;
    Ok(bytes)
}

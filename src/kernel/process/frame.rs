//! Many rays in one request, as arrays and not as text: a line of JSON says which blocks stand behind it.

mod answered;
mod asked;
pub(super) mod message;

pub(super) use answered::{head, read};
pub(super) use asked::{fits, write};

use super::written::{Numbers, Written};
use message::{BlockType, WireBlock};
use serde::Serialize;
use std::ops::RangeInclusive;

/// So many rays a frame a kernel may ask for.
pub(super) const RAYS: RangeInclusive<u64> = 1..=1_000_000;

/// The bytes of one number of any block.
const NUMBER: usize = 8;

/// A frame as it goes over a pipe.
#[derive(Debug)]
pub(super) struct Frame {
    /// The line, with its end.
    pub(super) line: Vec<u8>,
    /// What stands behind it.
    pub(super) bytes: Vec<u8>,
    /// The same as lines of text, for the log: one a block.
    pub(super) text: Vec<u8>,
}

impl<N> WireBlock<N> {
    /// How many bytes it has; none where that is more than can be counted.
    fn size(&self) -> Option<usize> {
        let sizes = self.shape.iter().copied();
        let mut numbers = sizes.map(|size| usize::try_from(size).ok());
        numbers.try_fold(NUMBER, |size, by| size.checked_mul(by?))
    }
}

/// How a block is named in messages of errors: `<f8 [4096, 3]`.
fn described(kind: BlockType, shape: &[u64]) -> String {
    let sizes: Vec<String> = shape.iter().map(ToString::to_string).collect();
    format!("{} [{}]", kind.name(), sizes.join(", "))
}

/// A line of the log.
#[derive(Serialize)]
struct Line<'b, N> {
    block: &'b N,
    values: Vec<Logged>,
}

/// A number as it stands in a log.
#[derive(Serialize)]
#[serde(untagged)]
enum Logged {
    Real(Written),
    Integer(i64),
    Natural(u64),
}

/// The blocks of a frame as text, a line each.
fn text<N: Serialize>(blocks: &[WireBlock<N>], bytes: &[u8]) -> serde_json::Result<Vec<u8>> {
    let mut text = Vec::new();
    let mut rest = bytes;
    for block in blocks {
        let size = block.size().unwrap_or(usize::MAX);
        let (own, behind) = rest.split_at_checked(size).unwrap_or((rest, &[]));
        rest = behind;
        let (numbers, _) = own.as_chunks::<NUMBER>();
        let logged = |number: &[u8; NUMBER]| match block.kind {
            BlockType::Real => Logged::Real(Written {
                value: f64::from_le_bytes(*number),
                numbers: Numbers::Decimal,
            }),
            BlockType::Integer => Logged::Integer(i64::from_le_bytes(*number)),
            BlockType::Natural => Logged::Natural(u64::from_le_bytes(*number)),
        };
        let line = Line {
            block: &block.name,
            values: numbers.iter().map(logged).collect(),
        };
        serde_json::to_writer(&mut text, &line)?;
        text.push(b'\n');
    }
    Ok(text)
}

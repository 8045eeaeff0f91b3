//! Types of numbers, and their bytes.

use super::{Memory, Trouble, refused};
use std::io::{self, Read};

/// Which byte of a number comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ByteOrder {
    /// The least significant.
    Little,
    /// The most significant.
    Big,
}

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NumberType {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

/// What numbers are kept as.
pub(crate) trait Held: Copy {
    /// The number, which is known to be one of these.
    fn of(value: f64) -> Self;
}

impl Held for f32 {
    #[allow(clippy::cast_possible_truncation)]
    fn of(value: f64) -> f32 {
        value as f32
    }
}

impl Held for f64 {
    fn of(value: f64) -> f64 {
        value
    }
}

impl NumberType {
    /// How many bytes one takes.
    pub(crate) fn bytes(self) -> usize {
        match self {
            NumberType::U8 | NumberType::I8 => 1,
            NumberType::U16 | NumberType::I16 => 2,
            NumberType::U32 | NumberType::I32 | NumberType::F32 => 4,
            NumberType::U64 | NumberType::I64 | NumberType::F64 => 8,
        }
    }

    /// Whether each of them is a number of binary32.
    pub(crate) fn is_single(self) -> bool {
        self == NumberType::F32 || self.bytes() <= 2
    }

    /// So many numbers, as they come.
    pub(crate) fn numbers<T: Held>(
        self,
        source: &mut dyn Read,
        order: ByteOrder,
        count: usize,
        memory: Memory,
    ) -> Result<Vec<T>, Trouble> {
        let mut numbers = memory.array(count)?;
        let into = &mut numbers;
        match self {
            NumberType::U8 => each(source, order, count, into, |[byte]| Some(f64::from(byte))),
            NumberType::I8 => each(source, order, count, into, |bytes| {
                Some(f64::from(i8::from_le_bytes(bytes)))
            }),
            NumberType::U16 => each(source, order, count, into, |bytes| {
                Some(f64::from(u16::from_le_bytes(bytes)))
            }),
            NumberType::I16 => each(source, order, count, into, |bytes| {
                Some(f64::from(i16::from_le_bytes(bytes)))
            }),
            NumberType::U32 => each(source, order, count, into, |bytes| {
                Some(f64::from(u32::from_le_bytes(bytes)))
            }),
            NumberType::I32 => each(source, order, count, into, |bytes| {
                Some(f64::from(i32::from_le_bytes(bytes)))
            }),
            NumberType::U64 => each(source, order, count, into, |bytes| {
                exact(u64::from_le_bytes(bytes).into())
            }),
            NumberType::I64 => each(source, order, count, into, |bytes| {
                exact(i64::from_le_bytes(bytes).into())
            }),
            NumberType::F32 => each(source, order, count, into, |bytes| {
                Some(f64::from(f32::from_le_bytes(bytes)))
            }),
            NumberType::F64 => each(source, order, count, into, |bytes| {
                Some(f64::from_le_bytes(bytes))
            }),
        }?;
        Ok(numbers)
    }

    /// The number that a word of text is.
    fn said(self, word: &str) -> Option<f64> {
        match self {
            NumberType::F64 => word.parse().ok(),
            // The nearest of binary32, not the nearest of the nearest of binary64.
            NumberType::F32 => word.parse::<f32>().ok().map(f64::from),
            _ => exact(word.parse().ok()?).filter(|_| self.holds(word)),
        }
    }

    /// Whether an integer is one of these.
    fn holds(self, word: &str) -> bool {
        match self {
            NumberType::U8 => word.parse::<u8>().is_ok(),
            NumberType::I8 => word.parse::<i8>().is_ok(),
            NumberType::U16 => word.parse::<u16>().is_ok(),
            NumberType::I16 => word.parse::<i16>().is_ok(),
            NumberType::U32 => word.parse::<u32>().is_ok(),
            NumberType::I32 => word.parse::<i32>().is_ok(),
            NumberType::U64 => word.parse::<u64>().is_ok(),
            NumberType::I64 => word.parse::<i64>().is_ok(),
            NumberType::F32 | NumberType::F64 => true,
        }
    }
}

/// An integer of binary64.
#[allow(clippy::cast_possible_truncation)]
fn exact(value: i128) -> Option<f64> {
    let near = value as f64;
    (near as i128 == value).then_some(near)
}

fn each<T: Held, const N: usize>(
    source: &mut dyn Read,
    order: ByteOrder,
    count: usize,
    into: &mut Vec<T>,
    number: impl Fn([u8; N]) -> Option<f64>,
) -> Result<(), Trouble> {
    let mut buffer = [0; 1 << 14];
    while into.len() < count {
        let wanted = ((count - into.len()) * N).min(buffer.len());
        let have = fill(source, &mut buffer[..wanted])?;
        if have < wanted {
            return Err(Trouble::Size {
                have: (into.len() * N + have) as u64,
                need: (count * N) as u64,
            });
        }
        for bytes in buffer[..wanted].chunks_exact(N) {
            let mut one = [0; N];
            one.copy_from_slice(bytes);
            if order == ByteOrder::Big {
                one.reverse();
            }
            let value = number(one).ok_or_else(|| beyond(into.len()))?;
            into.push(T::of(value));
        }
    }
    Ok(())
}

fn beyond(place: usize) -> Trouble {
    refused(
        format!("the integer at place {place} of the data is no number of binary64"),
        "integers up to 2^53, and larger ones with zeros at the end",
    )
}

/// As many bytes as there are, up to the length of the buffer.
fn fill(source: &mut dyn Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut have = 0;
    while have < buffer.len() {
        match source.read(&mut buffer[have..]) {
            Ok(0) => break,
            Ok(more) => have += more,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(have)
}

/// So many numbers of a text.
pub(crate) fn ascii<T: Held>(
    text: &str,
    kind: NumberType,
    count: usize,
    memory: Memory,
) -> Result<Vec<T>, Trouble> {
    // Each takes a character and a space at least: a short text is refused before memory is taken.
    let most = text.len() / 2 + 1;
    let mut numbers = memory.array(count.min(most))?;
    for word in text.split_ascii_whitespace() {
        if numbers.len() == count {
            return Err(refused(
                format!("more than {count} numbers"),
                format!("{count}, as its header says"),
            ));
        }
        let value = kind.said(word).ok_or_else(|| {
            let shown: String = word.chars().take(40).collect();
            refused(
                format!(
                    "'{}' at place {} of the data",
                    shown.escape_debug(),
                    numbers.len()
                ),
                "numbers of the type that its header says, integers up to 2^53",
            )
        })?;
        numbers.push(T::of(value));
    }
    if numbers.len() == count {
        return Ok(numbers);
    }
    Err(refused(
        format!("{} numbers", numbers.len()),
        format!("{count}, as its header says"),
    ))
}

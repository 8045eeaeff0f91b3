//! The header of `.npy`: a dictionary as Python writes it, with three keys.

use super::{ByteOrder, Bytes, NumberType, Trouble, refused};
use std::io::Read;

/// The longest header; that of an array of numbers has a few hundred bytes.
const MOST: usize = 1 << 16;

/// What the header of an array of numbers says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NpyHeader {
    pub(crate) kind: NumberType,
    pub(crate) order: ByteOrder,
    /// Whether the first axis is the fastest.
    pub(crate) fortran: bool,
    pub(crate) shape: Vec<usize>,
}

impl NpyHeader {
    /// Reads it; the data follow.
    pub(crate) fn read(file: &mut Bytes) -> Result<NpyHeader, Trouble> {
        let none = || refused("no header of .npy", "a file that numpy.save writes");
        let mut start = [0; 8];
        file.read_exact(&mut start).map_err(|_| none())?;
        let [magic @ .., major, _] = start;
        if magic != *b"\x93NUMPY" {
            return Err(none());
        }
        let mut length = [0; 4];
        let bytes = if major == 1 { 2 } else { 4 };
        file.read_exact(&mut length[..bytes]).map_err(|_| none())?;
        let length = u32::from_le_bytes(length) as usize;
        if !(1..=3).contains(&major) || length > MOST {
            return Err(none());
        }
        let mut text = vec![0; length];
        file.read_exact(&mut text).map_err(|_| none())?;
        let text = String::from_utf8(text).map_err(|_| none())?;
        NpyHeader::said(&text)
    }

    fn said(text: &str) -> Result<NpyHeader, Trouble> {
        let missing = |key: &str| {
            refused(
                format!("no '{key}' in its header"),
                "'descr' of one type of number, 'fortran_order' and 'shape'",
            )
        };
        let value = |key: &str| {
            let (_, rest) = text.split_once(&format!("'{key}':"))?;
            Some(rest.trim_start())
        };
        let descr = value("descr")
            .and_then(quoted)
            .ok_or_else(|| missing("descr"))?;
        let (kind, order) = number_type(descr).ok_or_else(|| {
            refused(
                format!("numbers of the type '{}'", descr.escape_debug()),
                "integers of 8, 16, 32 and 64 bits, binary32 and binary64: |u1, |i1, <u2 … <i8, <f4, <f8, and with > for <",
            )
        })?;
        let order_of_axes = value("fortran_order").ok_or_else(|| missing("fortran_order"))?;
        let fortran = match order_of_axes {
            text if text.starts_with("True") => true,
            text if text.starts_with("False") => false,
            _ => return Err(missing("fortran_order")),
        };
        let shape = value("shape")
            .and_then(|text| text.strip_prefix('(')?.split_once(')'))
            .and_then(|(sizes, _)| {
                let sizes = sizes
                    .split(',')
                    .map(str::trim)
                    .filter(|size| !size.is_empty());
                sizes.map(|size| size.parse().ok()).collect()
            })
            .ok_or_else(|| missing("shape"))?;
        Ok(NpyHeader {
            kind,
            order,
            fortran,
            shape,
        })
    }

    /// Its bytes, as numpy writes them: the data begin at a multiple of 64.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let kind = match self.kind {
            NumberType::F32 => "<f4",
            _ => "<f8",
        };
        let sizes: Vec<_> = self.shape.iter().map(ToString::to_string).collect();
        let shape = sizes.join(", ");
        let mut text =
            format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
        let unpadded = 10 + text.len() + 1;
        text.extend(std::iter::repeat_n(
            ' ',
            unpadded.next_multiple_of(64) - unpadded,
        ));
        text.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        let length = u16::try_from(text.len()).unwrap_or(u16::MAX);
        bytes.extend(length.to_le_bytes());
        bytes.extend(text.as_bytes());
        bytes
    }
}

fn quoted(text: &str) -> Option<&str> {
    text.strip_prefix('\'')?
        .split_once('\'')
        .map(|(in_quotes, _)| in_quotes)
}

fn number_type(descr: &str) -> Option<(NumberType, ByteOrder)> {
    let (order, kind) = descr.split_at_checked(1)?;
    let kind = match kind {
        "u1" => NumberType::U8,
        "i1" => NumberType::I8,
        "u2" => NumberType::U16,
        "i2" => NumberType::I16,
        "u4" => NumberType::U32,
        "i4" => NumberType::I32,
        "u8" => NumberType::U64,
        "i8" => NumberType::I64,
        "f4" => NumberType::F32,
        "f8" => NumberType::F64,
        _ => return None,
    };
    match order {
        "<" => Some((kind, ByteOrder::Little)),
        ">" => Some((kind, ByteOrder::Big)),
        "|" if kind.bytes() == 1 => Some((kind, ByteOrder::Little)),
        _ => None,
    }
}

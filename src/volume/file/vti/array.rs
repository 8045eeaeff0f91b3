//! The numbers of a `DataArray`: as text, in base64, or appended; plain, or compressed in blocks.

use super::super::{inflated, said};
use super::document::{Document, Node};
use super::{byte_order, value};
use crate::binary::{Base64, ByteOrder, Memory, NumberType, Trouble, refused};
use crate::volume::Samples;
use flate2::read::ZlibDecoder;
use std::io::{self, Read};

/// What the bytes of an array are.
struct Layout {
    kind: NumberType,
    order: ByteOrder,
    /// Bytes of a number in headers.
    wide: bool,
    compressed: bool,
    count: usize,
}

/// The samples that a source has behind a header.
fn behind_header(
    source: &mut dyn Read,
    layout: &Layout,
    left: u64,
    memory: Memory,
) -> Result<Samples, Trouble> {
    let need = (layout.count as u64).saturating_mul(layout.kind.bytes() as u64);
    let (kind, order, count) = (layout.kind, layout.order, layout.count);
    if layout.compressed {
        if need > inflated(left) {
            return Err(Trouble::Size {
                have: inflated(left),
                need,
            });
        }
        let mut blocks = Blocks::read(source, layout, need)?;
        return super::super::samples(&mut blocks, kind, order, count, memory);
    }
    let have = layout.number(source)?;
    if have != need {
        return Err(Trouble::Size { have, need });
    }
    // In base64 there are fewer bytes than characters, which the numbers themselves find out.
    if left < need {
        return Err(Trouble::Size { have: left, need });
    }
    super::super::samples(source, kind, order, count, memory)
}

impl Layout {
    /// A number of a header.
    fn number(&self, source: &mut dyn Read) -> Result<u64, Trouble> {
        let mut bytes = [0; 8];
        let part = &mut bytes[..if self.wide { 8 } else { 4 }];
        source.read_exact(part)?;
        if self.order == ByteOrder::Big {
            part.reverse();
        }
        Ok(u64::from_le_bytes(bytes))
    }
}

/// Blocks of zlib, one after the other.
struct Blocks<'a> {
    source: &'a mut dyn Read,
    sizes: std::vec::IntoIter<u64>,
    /// What is left of the block that is being read, uncompressed.
    block: io::Cursor<Vec<u8>>,
    longest: u64,
}

impl<'a> Blocks<'a> {
    /// The header: how many blocks, how long each and the last are, and how long each is compressed.
    fn read(source: &'a mut dyn Read, layout: &Layout, need: u64) -> Result<Blocks<'a>, Trouble> {
        let count = layout.number(source)?;
        let whole = layout.number(source)?;
        let last = layout.number(source)?;
        let full = if last == 0 {
            count
        } else {
            count.saturating_sub(1)
        };
        let have = full.saturating_mul(whole).saturating_add(last);
        if have != need {
            return Err(Trouble::Size { have, need });
        }
        if whole > 1 << 30 || count > 1 << 24 {
            return Err(refused(
                format!("{count} compressed blocks of {whole} bytes"),
                "blocks of at most 2^30 bytes, at most 2^24 of them",
            ));
        }
        let sizes: Result<Vec<u64>, Trouble> = (0..count).map(|_| layout.number(source)).collect();
        Ok(Blocks {
            source,
            sizes: sizes?.into_iter(),
            block: io::Cursor::new(Vec::new()),
            longest: whole.max(last),
        })
    }
}

impl Read for Blocks<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let read = self.block.read(buffer)?;
            if read > 0 || buffer.is_empty() {
                return Ok(read);
            }
            let Some(size) = self.sizes.next() else {
                return Ok(0);
            };
            let mut block = std::mem::take(&mut self.block).into_inner();
            block.clear();
            // A whole block is taken from the source whatever its stream says of its end.
            let mut compressed = (&mut self.source).take(size);
            ZlibDecoder::new(&mut compressed)
                .take(self.longest)
                .read_to_end(&mut block)?;
            io::copy(&mut compressed, &mut io::sink())?;
            if block.is_empty() {
                return Ok(0);
            }
            self.block = io::Cursor::new(block);
        }
    }
}

/// The samples of an array.
pub(super) fn samples(
    document: &mut Document,
    root: Node<'_, '_>,
    array: Node<'_, '_>,
    count: usize,
    memory: Memory,
) -> Result<Samples, Trouble> {
    let kind = number_type(array)?;
    let format = array.attribute("format").unwrap_or("ascii");
    let text = array.text().unwrap_or_default();
    if format == "ascii" {
        return said(text, kind, count, memory);
    }
    let layout = Layout {
        kind,
        order: byte_order(root)?,
        wide: match root.attribute("header_type") {
            None | Some("UInt32") => false,
            Some("UInt64") => true,
            Some(other) => return Err(value("VTKFile", "header_type", other, "UInt32 or UInt64")),
        },
        compressed: match root.attribute("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let allowed = "vtkZLibDataCompressor, or none";
                return Err(value("VTKFile", "compressor", other, allowed));
            }
        },
        count,
    };
    if format == "binary" {
        let mut source = Base64::new(text.as_bytes());
        return behind_header(&mut source, &layout, text.len() as u64, memory);
    }
    if format != "appended" {
        return Err(value(
            "DataArray",
            "format",
            format,
            "ascii, binary or appended",
        ));
    }
    let offset = array.attribute("offset").unwrap_or_default();
    let start = offset.parse().ok().zip(document.appended);
    let Some((offset, start)) = start else {
        return Err(value(
            "DataArray",
            "offset",
            offset,
            "a number of bytes, into AppendedData",
        ));
    };
    let file = &mut document.file;
    file.go_to(u64::saturating_add(start, offset))?;
    let left = file.left();
    let appended = root
        .children()
        .find(|node| node.has_tag_name("AppendedData"));
    match appended.and_then(|data| data.attribute("encoding")) {
        Some("raw") => behind_header(file, &layout, left, memory),
        None | Some("base64") => behind_header(&mut Base64::new(file), &layout, left, memory),
        Some(other) => Err(value("AppendedData", "encoding", other, "raw or base64")),
    }
}

fn number_type(array: Node<'_, '_>) -> Result<NumberType, Trouble> {
    Ok(match array.attribute("type").unwrap_or_default() {
        "UInt8" => NumberType::U8,
        "Int8" => NumberType::I8,
        "UInt16" => NumberType::U16,
        "Int16" => NumberType::I16,
        "UInt32" => NumberType::U32,
        "Int32" => NumberType::I32,
        "UInt64" => NumberType::U64,
        "Int64" => NumberType::I64,
        "Float32" => NumberType::F32,
        "Float64" => NumberType::F64,
        other => {
            let allowed =
                "UInt8, Int8, UInt16, Int16, UInt32, Int32, UInt64, Int64, Float32 or Float64";
            return Err(value("DataArray", "type", other, allowed));
        }
    })
}

//! NRRD: `.nrrd`, and `.nhdr` with its data in another file.

mod header;
mod place;

use super::geometry::{text, transposed};
use super::{inflated, raw, said, samples, write_samples};
use crate::binary::{ByteOrder, Memory, NumberType, Trouble, open, product, refused};
use crate::input;
use crate::volume::{Grid, Samples};
use flate2::bufread::MultiGzDecoder;
use header::{Header, value};
use std::io::{BufReader, Read, Write};
use std::path::Path;

pub(super) fn read(path: &Path, memory: Memory) -> Result<Grid, Trouble> {
    let mut file = open(path)?;
    let header = Header::read(&mut file)?;
    let dimensions = header.dimensions()?;
    let place = place::of(&header)?;
    super::geometry::place(place.origin, place.spacing, place.direction)?;
    let count = product(&dimensions)?;
    let samples = data(path, file, &header, count, memory)?;
    Ok(Grid {
        dimensions,
        origin: place.origin,
        spacing: place.spacing,
        direction: place.direction,
        samples,
    })
}

fn data(
    path: &Path,
    attached: crate::binary::Bytes,
    header: &Header,
    count: usize,
    memory: Memory,
) -> Result<Samples, Trouble> {
    let mut file = match header.get("data file") {
        None => attached,
        Some(name) if name.starts_with("LIST") || name.contains('%') => {
            return Err(value("data file", name, "the name of one file"));
        }
        Some(name) => {
            let beside = path.with_file_name(name);
            open(&beside).map_err(|trouble| {
                refused(
                    format!("its data file {}: {trouble}", beside.display()),
                    "a file of data beside it",
                )
            })?
        }
    };
    for _ in 0..header.count("line skip")?.unwrap_or(0) {
        if file.line(1 << 20)?.is_none() {
            break;
        }
    }
    let kind = header.number_type()?;
    let need = (count as u64).saturating_mul(kind.bytes() as u64);
    let encoding = header.get("encoding").unwrap_or_default();
    let is_raw = encoding.eq_ignore_ascii_case("raw");
    let skip = match header.get("byte skip") {
        Some("-1") if is_raw => {
            file.at_least(need)?;
            file.left() - need
        }
        Some("-1") => {
            return Err(value(
                "byte skip",
                "-1",
                "0 or more; -1 of the encoding raw only",
            ));
        }
        _ => header.count("byte skip")?.unwrap_or(0),
    };
    let order = || match header.get("endian").map(str::to_ascii_lowercase).as_deref() {
        Some("little") => Ok(ByteOrder::Little),
        Some("big") => Ok(ByteOrder::Big),
        None if kind.bytes() == 1 => Ok(ByteOrder::Little),
        other => Err(value("endian", other.unwrap_or("nothing"), "little or big")),
    };
    match encoding.to_ascii_lowercase().as_str() {
        "raw" => {
            file.go_to(file.at().saturating_add(skip))?;
            raw(&mut file, kind, order()?, count, memory)
        }
        "ascii" | "txt" | "text" => {
            file.go_to(file.at().saturating_add(skip))?;
            memory.check(usize::try_from(file.left()).unwrap_or(usize::MAX), 1)?;
            let bytes = input::bytes(file, memory.most());
            let bytes =
                bytes.map_err(|error| refused(error.to_string(), "a file that can be read"))?;
            let text = std::str::from_utf8(&bytes)
                .map_err(|_| refused("data that are no text", "numbers in ASCII"))?;
            said(text, kind, count, memory)
        }
        "gzip" | "gz" => {
            if need > inflated(file.left()) {
                return Err(Trouble::Size {
                    have: inflated(file.left()),
                    need,
                });
            }
            let mut source = MultiGzDecoder::new(BufReader::new(file));
            // Skipped of what comes out, not of what is compressed.
            let skipped = std::io::copy(&mut (&mut source).take(skip), &mut std::io::sink())?;
            if skipped < skip {
                return Err(Trouble::Size {
                    have: skipped,
                    need: skip,
                });
            }
            let samples = samples(&mut source, kind, order()?, count, memory)?;
            super::meta_image::at_end(&mut source, need)?;
            Ok(samples)
        }
        other => Err(value("encoding", other, "raw, ascii or gzip")),
    }
}

pub(super) fn write(file: &mut dyn Write, grid: &Grid) -> Result<(), Trouble> {
    let [width, height, depth] = grid.dimensions;
    let kind = match grid.samples {
        Samples::F32(_) => "float",
        Samples::F64(_) => "double",
    };
    let columns = transposed(grid.direction);
    let vector = |numbers: [f64; 3]| format!("({})", text(&numbers).replace(' ', ","));
    let steps = [0, 1, 2].map(|axis| vector(columns[axis].map(|part| part * grid.spacing[axis])));
    write!(
        file,
        "NRRD0004\n\
         type: {kind}\n\
         dimension: 3\n\
         space: left-posterior-superior\n\
         sizes: {width} {height} {depth}\n\
         space directions: {steps}\n\
         kinds: domain domain domain\n\
         endian: little\n\
         encoding: raw\n\
         space origin: {origin}\n\n",
        steps = steps.join(" "),
        origin = vector(grid.origin),
    )?;
    write_samples(file, &grid.samples)
}

/// A type by any of its names.
fn number_type(name: &str) -> Option<NumberType> {
    Some(match name {
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => NumberType::U8,
        "signed char" | "int8" | "int8_t" => NumberType::I8,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => {
            NumberType::U16
        }
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => {
            NumberType::I16
        }
        "uint" | "unsigned int" | "uint32" | "uint32_t" => NumberType::U32,
        "int" | "signed int" | "int32" | "int32_t" => NumberType::I32,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => {
            NumberType::U64
        }
        "longlong"
        | "long long"
        | "long long int"
        | "signed long long"
        | "signed long long int"
        | "int64"
        | "int64_t" => NumberType::I64,
        "float" => NumberType::F32,
        "double" => NumberType::F64,
        _ => return None,
    })
}

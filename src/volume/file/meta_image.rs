//! MetaImage: `.mha`, and `.mhd` with its data in another file.

use super::geometry::{nine, text, three, transposed};
use super::{Turned, inflated, raw, samples, write_samples};
use crate::binary::{ByteOrder, Bytes, Memory, NumberType, Trouble, open, product, refused};
use crate::volume::{Grid, Samples};
use flate2::read::ZlibDecoder;
use std::collections::HashMap;
use std::io::{Read, Write};
use std::path::Path;

/// The longest line of a header.
const LINE: usize = 1 << 16;
/// The most lines of one.
const LINES: usize = 1 << 12;

/// `Key = Value`, by key.
struct Header(HashMap<String, String>);

pub(super) fn read(path: &Path, memory: Memory) -> Result<Grid, Trouble> {
    let mut file = open(path)?;
    let header = Header::read(&mut file)?;
    header.supported()?;
    let dimensions = header.dimensions()?;
    let kind = header.number_type()?;
    let spacing = (header.get("ElementSpacing")).or(header.get("ElementSize"));
    let spacing = spacing.map_or(Ok([1.0; 3]), |text| numbers("ElementSpacing", text, three))?;
    let origin = header.one_of(&["Origin", "Position", "Offset"])?;
    let origin = origin.map_or(Ok([0.0; 3]), |text| numbers("Offset", text, three))?;
    let matrix = header.one_of(&["TransformMatrix", "Rotation", "Orientation"])?;
    // Each triple is the direction of an axis.
    let direction = matrix.map_or(Ok(Grid::ALONG_AXES), |text| {
        numbers("TransformMatrix", text, nine).map(transposed)
    })?;
    super::geometry::place(origin, spacing, direction)?;
    let samples = header.samples(path, file, kind, product(&dimensions)?, memory)?;
    Ok(Grid {
        dimensions,
        origin,
        spacing,
        direction,
        samples,
    })
}

fn numbers<T>(key: &str, text: &str, read: fn(&str) -> Option<T>) -> Result<T, Trouble> {
    read(text).ok_or_else(|| value(key, text, "three numbers, or nine of a matrix"))
}

/// A value that is not taken.
fn value(key: &str, said: &str, allowed: &str) -> Trouble {
    let shown: String = said.chars().take(80).collect();
    refused(format!("{key} = {}", shown.escape_debug()), allowed)
}

impl Header {
    fn read(file: &mut Bytes) -> Result<Header, Trouble> {
        let mut keys = HashMap::new();
        for _ in 0..LINES {
            let Some(line) = file.line(LINE)? else { break };
            if line.trim().is_empty() {
                continue;
            }
            let Some((key, said)) = line.split_once('=') else {
                return Err(value(
                    "header",
                    &line,
                    "lines of 'Key = Value', the last of them ElementDataFile",
                ));
            };
            let (key, said) = (key.trim().to_owned(), said.trim().to_owned());
            let last = key == "ElementDataFile";
            if keys
                .insert(key.clone(), said.clone())
                .is_some_and(|old| old != said)
            {
                return Err(value(&key, &said, "each key once"));
            }
            if last {
                return Ok(Header(keys));
            }
        }
        Err(refused(
            "no ElementDataFile in its header",
            "a header that ends with ElementDataFile",
        ))
    }

    fn get(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(String::as_str)
    }

    /// The value of keys that mean the same.
    fn one_of(&self, keys: &[&str]) -> Result<Option<&str>, Trouble> {
        let mut said = keys
            .iter()
            .filter_map(|key| self.get(key).map(|said| (key, said)));
        let Some((_, first)) = said.next() else {
            return Ok(None);
        };
        match said.find(|(_, other)| *other != first) {
            Some((key, other)) => {
                let allowed = format!(
                    "the same as of the keys that mean the same: {}",
                    keys.join(", ")
                );
                Err(value(key, other, &allowed))
            }
            None => Ok(Some(first)),
        }
    }

    fn is_true(&self, key: &str) -> Result<Option<bool>, Trouble> {
        match self.get(key) {
            None => Ok(None),
            Some(said) if said.eq_ignore_ascii_case("true") || said == "1" => Ok(Some(true)),
            Some(said) if said.eq_ignore_ascii_case("false") || said == "0" => Ok(Some(false)),
            Some(said) => Err(value(key, said, "True or False")),
        }
    }

    /// Whether it is an image of one component in bytes.
    fn supported(&self) -> Result<(), Trouble> {
        if let Some(said) = self
            .get("ObjectType")
            .filter(|said| !said.eq_ignore_ascii_case("image"))
        {
            return Err(value("ObjectType", said, "Image"));
        }
        if let Some(said) = self
            .get("ElementNumberOfChannels")
            .filter(|said| *said != "1")
        {
            return Err(value(
                "ElementNumberOfChannels",
                said,
                "1: one number a sample",
            ));
        }
        if self.is_true("BinaryData")? == Some(false) {
            return Err(value(
                "BinaryData",
                "False",
                "True: data as text are not read",
            ));
        }
        Ok(())
    }

    fn dimensions(&self) -> Result<[usize; 3], Trouble> {
        let said = self.get("DimSize").unwrap_or_default();
        let sizes: Option<Vec<usize>> = said
            .split_whitespace()
            .map(|word| word.parse().ok())
            .collect();
        if let Some(sizes) = sizes
            && let Ok(dimensions) = <[usize; 3]>::try_from(sizes)
            && self.get("NDims").is_none_or(|many| many == "3")
        {
            return Ok(dimensions);
        }
        let many = self.get("NDims").unwrap_or("3");
        Err(value(
            "NDims, DimSize",
            &format!("{many}, {said}"),
            "3, and three whole numbers",
        ))
    }

    fn number_type(&self) -> Result<NumberType, Trouble> {
        Ok(match self.get("ElementType").unwrap_or_default() {
            "MET_UCHAR" => NumberType::U8,
            "MET_CHAR" => NumberType::I8,
            "MET_USHORT" => NumberType::U16,
            "MET_SHORT" => NumberType::I16,
            "MET_UINT" => NumberType::U32,
            "MET_INT" => NumberType::I32,
            "MET_ULONG_LONG" => NumberType::U64,
            "MET_LONG_LONG" => NumberType::I64,
            "MET_FLOAT" => NumberType::F32,
            "MET_DOUBLE" => NumberType::F64,
            long @ ("MET_LONG" | "MET_ULONG") => {
                return Err(value(
                    "ElementType",
                    long,
                    "MET_INT or MET_LONG_LONG: ITK has 4 bytes for it, VTK 8",
                ));
            }
            other => {
                return Err(value(
                    "ElementType",
                    other,
                    "MET_UCHAR, MET_CHAR, MET_USHORT, MET_SHORT, MET_UINT, MET_INT, MET_ULONG_LONG, MET_LONG_LONG, MET_FLOAT or MET_DOUBLE",
                ));
            }
        })
    }

    fn samples(
        &self,
        path: &Path,
        header: Bytes,
        kind: NumberType,
        count: usize,
        memory: Memory,
    ) -> Result<Samples, Trouble> {
        let big = match self.is_true("BinaryDataByteOrderMSB")? {
            Some(big) => big,
            None => self.is_true("ElementByteOrderMSB")?.unwrap_or(false),
        };
        let order = if big {
            ByteOrder::Big
        } else {
            ByteOrder::Little
        };
        let name = self.get("ElementDataFile").unwrap_or_default();
        let mut file = match name {
            "LOCAL" | "Local" | "local" => header,
            list if list.starts_with("LIST") || list.contains('%') => {
                return Err(value(
                    "ElementDataFile",
                    list,
                    "LOCAL, or the name of one file",
                ));
            }
            name => {
                let beside = path.with_file_name(name);
                open(&beside).map_err(|trouble| {
                    refused(
                        format!("its data file {}: {trouble}", beside.display()),
                        "a file of data beside it",
                    )
                })?
            }
        };
        let need = (count as u64).saturating_mul(kind.bytes() as u64);
        let start = file.at();
        match self
            .get("HeaderSize")
            .map(|said| (said, said.parse::<i64>()))
        {
            None => {}
            Some((_, Ok(-1))) => {
                file.at_least(need)?;
                file.go_to(start + file.left() - need)?;
            }
            Some((said, skip)) => {
                let skip = skip.ok().and_then(|skip| u64::try_from(skip).ok());
                let skip =
                    skip.ok_or_else(|| value("HeaderSize", said, "-1, or a number of bytes"))?;
                file.go_to(start.saturating_add(skip))?;
            }
        }
        if self.is_true("CompressedData")? != Some(true) {
            return raw(&mut file, kind, order, count, memory);
        }
        let compressed = match self.get("CompressedDataSize") {
            None => file.left(),
            Some(said) => said
                .parse()
                .map_err(|_| value("CompressedDataSize", said, "a number of bytes"))?,
        };
        file.exactly(compressed)?;
        if need > inflated(compressed) {
            return Err(Trouble::Size {
                have: inflated(compressed),
                need,
            });
        }
        let mut source = ZlibDecoder::new(file);
        let samples = samples(&mut source, kind, order, count, memory)?;
        at_end(&mut source, need)?;
        Ok(samples)
    }
}

/// Whether nothing follows the bytes that were needed.
pub(super) fn at_end(source: &mut dyn Read, need: u64) -> Result<(), Trouble> {
    match source.read(&mut [0])? {
        0 => Ok(()),
        more => Err(Trouble::Size {
            have: need + more as u64,
            need,
        }),
    }
}

pub(super) fn write(file: &mut dyn Write, grid: &Grid, turned: Turned) -> Result<(), Trouble> {
    let along = grid.direction == Grid::ALONG_AXES;
    if !along && turned == Turned::Refused {
        return Err(refused(
            "a direction other than along the axes, which VTK reads transposed from a MetaImage",
            ".vti or .nrrd, or a MetaImage that is said to be for ITK",
        ));
    }
    let [width, height, depth] = grid.dimensions;
    let kind = match grid.samples {
        Samples::F32(_) => "MET_FLOAT",
        Samples::F64(_) => "MET_DOUBLE",
    };
    write!(
        file,
        "ObjectType = Image\n\
         NDims = 3\n\
         BinaryData = True\n\
         BinaryDataByteOrderMSB = False\n\
         CompressedData = False\n\
         TransformMatrix = {matrix}\n\
         Offset = {origin}\n\
         ElementSpacing = {spacing}\n\
         DimSize = {width} {height} {depth}\n\
         ElementType = {kind}\n\
         ElementDataFile = LOCAL\n",
        matrix = text(&transposed(grid.direction).concat()),
        origin = text(&grid.origin),
        spacing = text(&grid.spacing),
    )?;
    write_samples(file, &grid.samples)
}

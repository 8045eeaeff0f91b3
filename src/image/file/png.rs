//! PNG of 8 or 16 bits: integers; chunks that say of which curve of brightness they are change nothing.

use super::names;
use crate::binary::{ByteOrder, Memory, NumberType, Trouble, product, refused};
use crate::image::Image;
use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

pub(super) fn read(path: &Path, memory: Memory) -> Result<(Image, Option<f64>), Trouble> {
    let file = BufReader::new(File::open(path)?);
    let limit = usize::try_from(memory.most()).unwrap_or(usize::MAX);
    let mut decoder = Decoder::new_with_limits(file, Limits { bytes: limit });
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(trouble)?;
    let info = reader.info();
    let (width, height) = (info.width as usize, info.height as usize);
    let many = match info.color_type {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb => 3,
        ColorType::Rgba => 4,
        ColorType::Indexed => return Err(refused("a palette", "grey or RGB")),
    };
    let (kind, largest) = match info.bit_depth {
        BitDepth::Eight => (NumberType::U8, 255.0),
        BitDepth::Sixteen => (NumberType::U16, 65535.0),
        other => {
            return Err(refused(
                format!("{} bits a channel", other as u8),
                "8 or 16",
            ));
        }
    };
    if info.trns.is_some() {
        return Err(refused(
            "a colour that is transparent (tRNS)",
            "a channel of alpha, or none",
        ));
    }
    let count = product(&[width, height, many])?;
    memory.check(count, size_of::<f64>() + kind.bytes())?;
    let size = count * kind.bytes();
    let mut bytes: Vec<u8> = memory.array(size)?;
    bytes.resize(size, 0);
    reader.next_frame(&mut bytes).map_err(trouble)?;
    // All chunks up to the end, so that a file that breaks off is found to.
    reader.finish().map_err(trouble)?;
    let mut values: Vec<f64> =
        kind.numbers(&mut bytes.as_slice(), ByteOrder::Big, count, memory)?;
    for value in &mut values {
        *value /= largest;
    }
    let image = Image {
        width,
        height,
        channels: names(many),
        values,
    };
    Ok((image, Some(1.0 / largest)))
}

fn trouble(error: DecodingError) -> Trouble {
    match error {
        DecodingError::IoError(error) => error.into(),
        other => refused(other.to_string(), "a PNG that fits the memory"),
    }
}

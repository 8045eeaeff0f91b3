//! Pictures as `.npy`: an array of (rows, columns), or of (rows, columns, channels).

use super::names;
use crate::binary::{ByteOrder, Memory, NpyHeader, NumberType, Trouble, open, product, refused};
use crate::image::Image;
use std::io::Write;
use std::path::Path;

pub(super) fn read(path: &Path, memory: Memory) -> Result<(Image, Option<f64>), Trouble> {
    let mut file = open(path)?;
    let header = NpyHeader::read(&mut file)?;
    let (height, width, many) = match *header.shape.as_slice() {
        [height, width] => (height, width, 1),
        [height, width, channels] => (height, width, channels),
        _ => {
            return Err(refused(
                format!("an array of the shape {:?}", header.shape),
                "(rows, columns) or (rows, columns, channels)",
            ));
        }
    };
    if header.fortran {
        return Err(refused(
            "an array in Fortran's order",
            "C's order: numpy.save(name, numpy.ascontiguousarray(picture))",
        ));
    }
    if !matches!(header.kind, NumberType::F32 | NumberType::F64) {
        return Err(refused(
            "an array of integers, which do not say what is 1",
            "binary32 or binary64",
        ));
    }
    let count = product(&header.shape)?;
    // Names take more than a value each: a picture of few values has few of them.
    if many > 1 << 16 {
        return Err(refused(
            format!("{many} channels"),
            format!("up to {}", 1 << 16),
        ));
    }
    file.exactly((count as u64).saturating_mul(header.kind.bytes() as u64))?;
    let values = header
        .kind
        .numbers(&mut file, header.order, count, memory)?;
    let image = Image {
        width,
        height,
        channels: names(many),
        values,
    };
    Ok((image, None))
}

pub(super) fn write(file: &mut dyn Write, image: &Image) -> Result<(), Trouble> {
    let mut shape = vec![image.height, image.width];
    if image.channels.len() > 1 {
        shape.push(image.channels.len());
    }
    let header = NpyHeader {
        kind: NumberType::F64,
        order: ByteOrder::Little,
        fortran: false,
        shape,
    };
    file.write_all(&header.bytes())?;
    for value in &image.values {
        file.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}

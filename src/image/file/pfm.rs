//! PFM: three lines of text, then binary32, the lowest row first.

use super::{names, single};
use crate::binary::{ByteOrder, Memory, NumberType, Trouble, open, product, refused};
use crate::image::Image;
use std::io::Write;
use std::path::Path;

pub(super) fn read(path: &Path, memory: Memory) -> Result<(Image, Option<f64>), Trouble> {
    let mut file = open(path)?;
    let mut line = || file.line(100).map(Option::unwrap_or_default);
    let many = match line()?.trim_end() {
        "PF" => 3,
        "Pf" => 1,
        other => {
            return Err(refused(
                format!("no PFM: it begins with '{}'", other.escape_debug()),
                "PF or Pf in a line of its own",
            ));
        }
    };
    let sizes = line()?;
    let numbers: Vec<Option<usize>> = sizes
        .split_whitespace()
        .map(|word| word.parse().ok())
        .collect();
    let &[Some(width), Some(height)] = numbers.as_slice() else {
        return Err(refused(
            format!("sizes '{}'", sizes.escape_debug()),
            "width and height in a line of their own",
        ));
    };
    let scale = line()?;
    let order = match scale.trim().parse::<f64>() {
        Ok(-1.0) => ByteOrder::Little,
        Ok(1.0) => ByteOrder::Big,
        _ => {
            return Err(refused(
                format!("a scale of '{}'", scale.escape_debug()),
                "-1 or 1: programs multiply, divide or do nothing by others",
            ));
        }
    };
    let count = product(&[width, height, many])?;
    file.exactly((count as u64).saturating_mul(4))?;
    let mut values: Vec<f64> = NumberType::F32.numbers(&mut file, order, count, memory)?;
    turn(&mut values, width * many);
    let image = Image {
        width,
        height,
        channels: names(many),
        values,
    };
    Ok((image, None))
}

/// The lowest row first becomes the highest first.
fn turn(values: &mut [f64], row: usize) {
    let rows = values.len() / row;
    for upper in 0..rows / 2 {
        let (above, below) = values.split_at_mut((rows - 1 - upper) * row);
        above[upper * row..][..row].swap_with_slice(&mut below[..row]);
    }
}

pub(super) fn write(file: &mut dyn Write, image: &Image) -> Result<(), Trouble> {
    let magic = match image.channels.len() {
        1 => "Pf",
        3 => "PF",
        many => return Err(refused(format!("{many} channels in a PFM"), "one or three")),
    };
    write!(file, "{magic}\n{} {}\n-1.0\n", image.width, image.height)?;
    for row in image
        .values
        .rchunks_exact(image.width * image.channels.len())
    {
        for &value in row {
            file.write_all(&single(value)?.to_le_bytes())?;
        }
    }
    Ok(())
}

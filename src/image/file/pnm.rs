//! PPM and PGM in bytes (P6, P5): integers of which the header says the largest.

use super::names;
use crate::binary::{ByteOrder, Bytes, Memory, NumberType, Trouble, open, product, refused};
use crate::image::Image;
use std::io::Read;
use std::path::Path;

/// The longest header, with its comments.
const HEADER: usize = 1 << 16;

pub(super) fn read(path: &Path, memory: Memory) -> Result<(Image, Option<f64>), Trouble> {
    let mut file = open(path)?;
    let many = match word(&mut file)?.as_str() {
        "P6" => 3,
        "P5" => 1,
        other => {
            return Err(refused(
                format!(
                    "no PPM or PGM in bytes: it begins with '{}'",
                    other.escape_debug()
                ),
                "P6 or P5",
            ));
        }
    };
    let mut number = |name: &str| {
        let word = word(&mut file)?;
        let said = word.parse::<usize>();
        said.map_err(|_| {
            refused(
                format!("{name} '{}'", word.escape_debug()),
                "a whole number",
            )
        })
    };
    let (width, height, largest) = (number("width")?, number("height")?, number("maxval")?);
    if !(1..=65535).contains(&largest) {
        return Err(refused(format!("maxval {largest}"), "1 to 65535"));
    }
    let count = product(&[width, height, many])?;
    let kind = if largest > 255 {
        NumberType::U16
    } else {
        NumberType::U8
    };
    file.exactly((count as u64).saturating_mul(kind.bytes() as u64))?;
    let mut values: Vec<f64> = kind.numbers(&mut file, ByteOrder::Big, count, memory)?;
    let largest = largest as f64;
    for value in &mut values {
        if *value > largest {
            return Err(refused(
                format!("a value of {value} above maxval"),
                format!("up to {largest}"),
            ));
        }
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

/// A word of the header and the one white space behind it; comments go to the ends of their lines.
fn word(file: &mut Bytes) -> Result<String, Trouble> {
    let mut word = String::new();
    let mut byte = [0];
    for _ in 0..HEADER {
        if file.read(&mut byte)? == 0 {
            break;
        }
        match byte[0] {
            b'#' if word.is_empty() => {
                file.line(HEADER)?;
            }
            space if space.is_ascii_whitespace() => {
                if !word.is_empty() {
                    return Ok(word);
                }
            }
            other => word.push(char::from(other)),
        }
        if word.len() > 20 {
            break;
        }
    }
    Err(refused(
        format!("a header with '{}'", word.escape_debug()),
        "P6 or P5, width, height and maxval, each behind white space",
    ))
}

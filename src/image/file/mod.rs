//! Files of pictures: OpenEXR, `.npy` and PFM to read and to write; PNG, PPM and PGM to read.
//!
//! A picture is written only where its numbers come back: as numbers of binary64 in `.npy`, rounded to binary32 in the
//! others.

mod exr;
mod npy;
mod pfm;
mod png;
mod pnm;

pub use crate::binary::{FileError, Trouble};

use super::Image;
use crate::binary::{Memory, refused};
use crate::output;
use std::path::Path;

/// A picture of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// The picture, as its file has it: nothing is divided by an alpha, and no curve of brightness is taken off.
    pub image: Image,
    /// What values are multiples of, where they are integers in the file: 1 over the largest, which is 1 here.
    pub quantum: Option<f64>,
    /// How many values are NaN.
    pub nan: usize,
}

/// How to read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reading {
    /// The most bytes of memory; by default what is free, where the system tells.
    pub memory: Option<u64>,
}

/// The picture of a file, as the ending of its name says.
///
/// Channels are `y` of one, `r`, `g`, `b` of three, and `a` behind them of two and four; those of OpenEXR keep their names, but
/// for Y, R, G, B and A, which are small, and come in that order, others by the alphabet.
///
/// # Errors
/// [`FileError`] where it cannot be read, does not hold what it says, would not fit the memory, or holds what programs read
/// in different ways.
pub fn read(path: &Path) -> Result<Read, FileError> {
    read_with(path, Reading::default())
}

/// [`read`], with what is to be known beside the file.
///
/// # Errors
/// As of [`read`].
pub fn read_with(path: &Path, reading: Reading) -> Result<Read, FileError> {
    let memory = Memory::up_to(reading.memory);
    let read = match ending(path).as_str() {
        "exr" => exr::read(path, memory),
        "npy" => npy::read(path, memory),
        "pfm" => pfm::read(path, memory),
        "png" => png::read(path, memory),
        "ppm" | "pgm" => pnm::read(path, memory),
        other => Err(Trouble::Ending {
            ending: other.to_owned(),
            allowed: ".exr, .npy, .pfm, .png, .ppm or .pgm",
        }),
    };
    let (image, quantum) = read.map_err(|trouble| trouble.at(path))?;
    let nan = image.values.iter().filter(|value| value.is_nan()).count();
    Ok(Read {
        image,
        quantum,
        nan,
    })
}

/// Writes a picture in the format that the ending of the name says; an old file is replaced once all is written.
///
/// # Errors
/// [`FileError`] where it cannot be written, or its numbers would not come back: beyond binary32 in others than `.npy`, in a
/// PFM of other than one or three channels, or as integers.
pub fn write(path: &Path, image: &Image) -> Result<(), FileError> {
    let written = || {
        let count = crate::binary::product(&[image.width, image.height, image.channels.len()])?;
        if image.values.len() != count {
            return Err(refused(
                format!("{} values", image.values.len()),
                format!("{count}, of all channels of all pixels"),
            ));
        }
        match ending(path).as_str() {
            "exr" => {
                let bytes = exr::bytes(image)?;
                output::replace(path, |file| Ok(file.write_all(&bytes)?))
            }
            "npy" => output::replace(path, |file| npy::write(file, image)),
            "pfm" => output::replace(path, |file| pfm::write(file, image)),
            other => Err(Trouble::Ending {
                ending: other.to_owned(),
                allowed: ".exr, .npy or .pfm: others hold no numbers, only their nearest of a few",
            }),
        }
    };
    written().map_err(|trouble: Trouble| trouble.at(path))
}

fn ending(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default();
    ending.to_string_lossy().to_ascii_lowercase()
}

/// The names of so many channels, where a file has none.
fn names(count: usize) -> Vec<String> {
    let known: &[&str] = match count {
        1 => &["y"],
        2 => &["y", "a"],
        3 => &["r", "g", "b"],
        4 => &["r", "g", "b", "a"],
        _ => return (0..count).map(|channel| format!("c{channel}")).collect(),
    };
    known.iter().map(|&name| name.to_owned()).collect()
}

/// The nearest of binary32, unless it is beyond all of them.
#[allow(clippy::cast_possible_truncation)]
fn single(value: f64) -> Result<f32, Trouble> {
    let near = value as f32;
    if near.is_infinite() && value.is_finite() {
        return Err(refused(
            format!("a value of {value:e}"),
            "up to 3.4e38 in binary32; any in .npy",
        ));
    }
    Ok(near)
}

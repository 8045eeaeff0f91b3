//! Files of volumes: VTK's ImageData (`.vti`), NRRD (`.nrrd`, `.nhdr`), MetaImage (`.mha`, `.mhd`) and `.npy`; transfer
//! functions and cameras as JSON.
//!
//! A grid is read as its format says, so that every sample stands where it stood: what programs understand in different
//! ways is refused, with what to write instead. Integers of 8 and 16 bits and binary32 are kept in binary32, all others in
//! binary64, in which an integer that rounds is refused.

mod camera;
mod color_map;
mod geometry;
mod gltf;
mod meta_image;
mod npy;
mod nrrd;
mod text;
mod transfer;
mod vti;

pub use crate::binary::{FileError, Trouble};
pub use camera::{CameraFile, OrthographicFile, PerspectiveFile, read_camera, write_camera};
pub use color_map::ColorMap;
pub use gltf::{ReadCamera, View, read_gltf_camera, write_gltf_camera};
pub use transfer::{PointFile, TransferFile, read_transfer, write_transfer};

use super::{Grid, Samples};
use crate::binary::{Bytes, Memory, NumberType};
use crate::output;
use std::io::{self, Write};
use std::path::Path;

/// What is known of volumes, for messages.
const ENDINGS: &str =
    ".vti, .nrrd, .nhdr, .mha, .mhd or .npy to read, .vti, .nrrd, .mha or .npy to write";

/// How to read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reading<'a> {
    /// Which array of a file that may hold several (`.vti`); by default the only one, or the one that it says is active.
    pub array: Option<&'a str>,
    /// The most bytes of memory; by default what is free, where the system tells.
    pub memory: Option<u64>,
}

/// What of a grid's geometry a file holds.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// Origin, spacing and direction.
    Written,
    /// None of it: reading gives origin 0 and spacing 1.
    LeftOut,
}

/// What becomes of a direction other than along the axes in a MetaImage, whose `TransformMatrix` ITK reads as an axis's
/// direction in each triple, and VTK transposed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turned {
    /// It is refused.
    #[default]
    Refused,
    /// It is written for ITK, and for [`read`].
    ForItk,
}

/// The volume of a file, as the ending of its name says.
///
/// # Errors
/// [`FileError`] where it cannot be read, does not hold what it says, would not fit the memory, or holds what a [`Grid`]
/// is not: several components, cells, mirrored or sheared axes, a spacing that is not above 0.
pub fn read(path: &Path) -> Result<Grid, FileError> {
    read_with(path, Reading::default())
}

/// [`read`], with what is to be known beside the file.
///
/// # Errors
/// As of [`read`].
pub fn read_with(path: &Path, reading: Reading<'_>) -> Result<Grid, FileError> {
    let memory = Memory::up_to(reading.memory);
    let grid = match ending(path).as_str() {
        "vti" => vti::read(path, reading.array, memory),
        "nrrd" | "nhdr" => nrrd::read(path, memory),
        "mha" | "mhd" => meta_image::read(path, memory),
        "npy" => npy::read(path, memory),
        other => Err(unknown(other)),
    };
    grid.and_then(|grid| geometry::check(&grid).map(|()| grid))
        .map_err(|trouble| trouble.at(path))
}

/// Writes a volume in the format that the ending of the name says, its samples as they are held; an old file is replaced
/// once all is written.
///
/// # Errors
/// [`FileError`] where it cannot be written, or the format cannot say it: see [`Turned`].
pub fn write(path: &Path, grid: &Grid, turned: Turned) -> Result<Geometry, FileError> {
    let written = || {
        geometry::check(grid)?;
        match ending(path).as_str() {
            "vti" => output::replace(path, |file| vti::write(file, grid)),
            "nrrd" => output::replace(path, |file| nrrd::write(file, grid)),
            "mha" => output::replace(path, |file| meta_image::write(file, grid, turned)),
            "npy" => {
                output::replace(path, |file| npy::write(file, grid))?;
                return Ok(Geometry::LeftOut);
            }
            other => Err(unknown(other)),
        }?;
        Ok(Geometry::Written)
    };
    written().map_err(|trouble: Trouble| trouble.at(path))
}

fn ending(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default();
    ending.to_string_lossy().to_ascii_lowercase()
}

fn unknown(ending: &str) -> Trouble {
    Trouble::Ending {
        ending: ending.to_owned(),
        allowed: ENDINGS,
    }
}

/// The samples that follow in a file, of which these are the last bytes.
fn raw(
    file: &mut Bytes,
    kind: NumberType,
    order: crate::binary::ByteOrder,
    count: usize,
    memory: Memory,
) -> Result<Samples, Trouble> {
    file.exactly((count as u64).saturating_mul(kind.bytes() as u64))?;
    samples(file, kind, order, count, memory)
}

/// The samples that come out of a source, in what they are kept as.
fn samples(
    source: &mut dyn io::Read,
    kind: NumberType,
    order: crate::binary::ByteOrder,
    count: usize,
    memory: Memory,
) -> Result<Samples, Trouble> {
    Ok(if kind.is_single() {
        Samples::F32(kind.numbers(source, order, count, memory)?)
    } else {
        Samples::F64(kind.numbers(source, order, count, memory)?)
    })
}

/// The samples of a text, in what they are kept as.
fn said(text: &str, kind: NumberType, count: usize, memory: Memory) -> Result<Samples, Trouble> {
    Ok(if kind.is_single() {
        Samples::F32(crate::binary::ascii(text, kind, count, memory)?)
    } else {
        Samples::F64(crate::binary::ascii(text, kind, count, memory)?)
    })
}

/// The samples as they are held, the least significant byte first.
fn write_samples(file: &mut dyn Write, samples: &Samples) -> Result<(), Trouble> {
    match samples {
        Samples::F32(values) => values
            .iter()
            .try_for_each(|v| file.write_all(&v.to_le_bytes())),
        Samples::F64(values) => values
            .iter()
            .try_for_each(|v| file.write_all(&v.to_le_bytes())),
    }?;
    Ok(())
}

/// How many samples a zlib stream of so many bytes can hold at most, as bytes: its shortest code stands for 258 bytes in two
/// bits.
fn inflated(bytes: u64) -> u64 {
    bytes.saturating_mul(1032).saturating_add(1032)
}

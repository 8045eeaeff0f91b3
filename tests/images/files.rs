//! Files of volumes, transfer functions, cameras and pictures: what is written comes back, files of other programs' shapes
//! are read, and others refused with a word of what is wrong. `make formats` has the other programs themselves.

mod broken;
mod cameras;
mod color_maps;
mod pictures;
mod refused;
mod round_trip;
mod shapes;

use std::path::PathBuf;
use tempfile::TempDir;
use volver::volume::file::{FileError, read};
use volver::volume::{Grid, Samples};

/// A folder with one file.
struct Folder(TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(TempDir::new().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn with(self, name: &str, contents: impl AsRef<[u8]>) -> Folder {
        std::fs::write(self.path(name), contents).unwrap();
        self
    }
}

/// The volume of a file with these bytes.
fn volume(name: &str, contents: impl AsRef<[u8]>) -> Result<Grid, FileError> {
    let folder = Folder::new().with(name, contents);
    read(&folder.path(name))
}

/// Bits, for which NaN is NaN.
fn bits(samples: &Samples) -> Vec<u64> {
    match samples {
        Samples::F32(values) => values.iter().map(|v| v.to_bits().into()).collect(),
        Samples::F64(values) => values.iter().map(|v| v.to_bits()).collect(),
    }
}

/// A zlib stream that compresses nothing.
fn zlib(data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(data.len()).unwrap();
    let mut bytes = vec![0x78, 0x01, 0x01];
    bytes.extend(length.to_le_bytes());
    bytes.extend((!length).to_le_bytes());
    bytes.extend(data);
    let (a, b) = data.iter().fold((1_u32, 0_u32), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65521;
        (a, (b + a) % 65521)
    });
    bytes.extend((b << 16 | a).to_be_bytes());
    bytes
}

/// The checksum of PNG and gzip.
fn crc32(data: &[u8]) -> u32 {
    !data.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 {
                crc >> 1 ^ 0xedb8_8320
            } else {
                crc >> 1
            }
        })
    })
}

//! Files with a byte changed or cut off: an error or a reading, and never a stop.

use super::Folder;
use quickcheck::quickcheck;
use std::path::Path;
use volver::image::{Image, file as image};
use volver::volume::file::{Turned, read, write};
use volver::volume::{Grid, Samples};

fn volumes(folder: &Folder) -> Vec<String> {
    let grid = Grid {
        dimensions: [3, 2, 2],
        origin: [0.25, 1.0, -1.0],
        spacing: [0.5, 1.0, 2.0],
        direction: Grid::ALONG_AXES,
        samples: Samples::F32((0_u8..12).map(f32::from).collect()),
    };
    let names = ["a.vti", "a.nrrd", "a.mha", "a.npy"];
    for name in names {
        let _ = write(&folder.path(name), &grid, Turned::Refused).unwrap();
    }
    names.map(str::to_owned).to_vec()
}

fn pictures(folder: &Folder) -> Vec<String> {
    let mut picture = Image::new(5, 40, ["r", "g", "b"].map(str::to_owned).to_vec());
    for (i, value) in (0_u16..).zip(&mut picture.values) {
        *value = f64::from(i % 17);
    }
    let names = ["p.exr", "p.npy", "p.pfm"];
    for name in names {
        image::write(&folder.path(name), &picture).unwrap();
    }
    names.map(str::to_owned).to_vec()
}

fn changed(path: &Path, at: usize, to: u8) {
    let mut bytes = std::fs::read(path).unwrap();
    let length = bytes.len();
    bytes[at % length] = to;
    std::fs::write(path, bytes).unwrap();
}

quickcheck! {
    fn a_changed_byte_stops_nothing(at: usize, to: u8) -> bool {
        let folder = Folder::new();
        // Headers are short, and most that can go wrong is in them.
        for name in volumes(&folder) {
            changed(&folder.path(&name), at % 400, to);
            if let Err(error) = read(&folder.path(&name)) {
                assert!(error.to_string().contains("(allowed: "), "{error}");
            }
        }
        for name in pictures(&folder) {
            changed(&folder.path(&name), at % 700, to);
            if let Err(error) = image::read(&folder.path(&name)) {
                assert!(error.to_string().contains("(allowed: "), "{error}");
            }
        }
        true
    }
}

#[test]
fn no_part_of_a_file_is_one() {
    let folder = Folder::new();
    let cut = |name: &str, is_read: &dyn Fn(&Path) -> bool| {
        let path = folder.path(name);
        let whole = std::fs::read(&path).unwrap();
        // The ends of a .vti are XML behind its last sample.
        let end = if name.ends_with("vti") {
            whole.len() - 34
        } else {
            whole.len() - 1
        };
        assert!(is_read(&path), "{name}");
        for length in (0..=end).rev().step_by(1 + end / 150) {
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(
                !is_read(&path),
                "{name} of {length} bytes of {}",
                whole.len()
            );
        }
    };
    for name in volumes(&folder) {
        cut(&name, &|path| read(path).is_ok());
    }
    for name in pictures(&folder) {
        cut(&name, &|path| image::read(path).is_ok());
    }
}

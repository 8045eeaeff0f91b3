//! What is written comes back.

use super::{Folder, bits};
use quickcheck::{Arbitrary, Gen, quickcheck};
use volver::image::{Image, file as image};
use volver::volume::file::{Geometry, Turned, read, write};
use volver::volume::{Grid, Samples};

#[derive(Clone, Debug)]
struct Any(Grid);

fn number(g: &mut Gen) -> f64 {
    f64::from(i32::arbitrary(g)) / 7.0
}

/// Of a quaternion of integers, so that no rotation is left out.
fn rotation(g: &mut Gen) -> [[f64; 3]; 3] {
    let [x, y, z, w] = [0; 4].map(|_| f64::from(i8::arbitrary(g)) + 0.5);
    let two = 2.0 / (x * x + y * y + z * z + w * w);
    [
        [
            1.0 - two * (y * y + z * z),
            two * (x * y - w * z),
            two * (x * z + w * y),
        ],
        [
            two * (x * y + w * z),
            1.0 - two * (x * x + z * z),
            two * (y * z - w * x),
        ],
        [
            two * (x * z - w * y),
            two * (y * z + w * x),
            1.0 - two * (x * x + y * y),
        ],
    ]
}

impl Arbitrary for Any {
    fn arbitrary(g: &mut Gen) -> Any {
        let dimensions = [0; 3].map(|_| 1 + usize::arbitrary(g) % 6);
        let count = dimensions.iter().product();
        // Any bits: NaN, infinities, subnormals, zeros with signs.
        let samples = if bool::arbitrary(g) {
            Samples::F32(
                (0..count)
                    .map(|_| f32::from_bits(u32::arbitrary(g)))
                    .collect(),
            )
        } else {
            Samples::F64(
                (0..count)
                    .map(|_| f64::from_bits(u64::arbitrary(g)))
                    .collect(),
            )
        };
        Any(Grid {
            dimensions,
            origin: [0; 3].map(|_| number(g)),
            spacing: [0; 3].map(|_| number(g).abs() + 1e-9),
            direction: rotation(g),
            samples,
        })
    }
}

/// Quiet bits of NaN are all that binary64 keeps of a NaN of binary32.
fn same(a: &Samples, b: &Samples) -> bool {
    std::mem::discriminant(a) == std::mem::discriminant(b)
        && a.len() == b.len()
        && (0..a.len()).all(|i| {
            let (a, b) = (a.at(i), b.at(i));
            a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
        })
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| (a - b).abs() <= 4e-16 * b.abs().max(1.0))
}

quickcheck! {
    fn volumes_come_back(any: Any) -> bool {
        let grid = any.0;
        let folder = Folder::new();
        ["volume.vti", "volume.nrrd", "volume.mha"].iter().all(|name| {
            let path = folder.path(name);
            assert_eq!(write(&path, &grid, Turned::ForItk).unwrap(), Geometry::Written);
            let again = read(&path).unwrap();
            // An NRRD holds spacing times direction.
            let place = if *name == "volume.nrrd" {
                near(again.spacing, grid.spacing)
                    && (0..3).all(|row| near(again.direction[row], grid.direction[row]))
            } else {
                again.spacing == grid.spacing && again.direction == grid.direction
            };
            place && again.origin == grid.origin && again.dimensions == grid.dimensions && same(&again.samples, &grid.samples)
        })
    }

    fn arrays_come_back(any: Any) -> bool {
        let grid = any.0;
        let folder = Folder::new();
        let path = folder.path("volume.npy");
        assert_eq!(write(&path, &grid, Turned::Refused).unwrap(), Geometry::LeftOut);
        let again = read(&path).unwrap();
        again.dimensions == grid.dimensions && same(&again.samples, &grid.samples) && again.spacing == [1.0; 3]
    }

    fn pictures_come_back(width: u8, height: u8, many: u8, values: Vec<f64>) -> bool {
        let (width, height) = (1 + usize::from(width % 9), 1 + usize::from(height % 9));
        let channels: Vec<String> = match many % 5 {
            0 => vec!["y".into()],
            1 => vec!["r".into(), "g".into(), "b".into()],
            2 => vec!["r".into(), "g".into(), "b".into(), "a".into()],
            3 => vec!["y".into(), "a".into()],
            _ => (0..5).map(|i| format!("c{i}")).collect(),
        };
        let mut picture = Image::new(width, height, channels);
        for (to, from) in picture.values.iter_mut().zip(values.iter().cycle()) {
            *to = *from;
        }
        let folder = Folder::new();
        let alike = |name: &str, wanted: &Image| {
            let again = image::read(&folder.path(name)).unwrap();
            assert_eq!(again.quantum, None);
            assert_eq!(again.nan, wanted.values.iter().filter(|value| value.is_nan()).count());
            again.image.channels == wanted.channels
                && (again.image.width, again.image.height) == (width, height)
                && again.image.values.iter().zip(&wanted.values).all(|(a, b)| a == b || (a.is_nan() && b.is_nan()))
        };
        image::write(&folder.path("picture.npy"), &picture).unwrap();
        let exact = alike("picture.npy", &picture);
        // Within binary32 the others hold all.
        #[allow(clippy::cast_possible_truncation)]
        for value in &mut picture.values {
            *value = f64::from((*value / 1e300) as f32);
        }
        image::write(&folder.path("picture.exr"), &picture).unwrap();
        let mut all = exact && alike("picture.exr", &picture);
        if picture.channels.len() % 2 == 1 && picture.channels.len() < 5 {
            image::write(&folder.path("picture.pfm"), &picture).unwrap();
            all &= alike("picture.pfm", &picture);
        }
        all
    }
}

#[test]
fn what_cannot_be_written_leaves_the_old_file() {
    let folder = Folder::new()
        .with("a.mha", "old")
        .with("a.pfm", "old")
        .with("a.exr", "old");
    let mut grid = Grid {
        dimensions: [2, 1, 1],
        origin: [0.0; 3],
        spacing: [1.0; 3],
        direction: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        samples: Samples::F32(vec![1.0, 2.0]),
    };
    let turned = write(&folder.path("a.mha"), &grid, Turned::Refused).unwrap_err();
    assert!(
        turned.to_string().contains("VTK reads transposed"),
        "{turned}"
    );
    grid.direction[0] = [0.0, 1.0, 0.0];
    for name in ["b.vti", "b.nrrd", "a.mha", "b.npy"] {
        let mirrored = write(&folder.path(name), &grid, Turned::ForItk).unwrap_err();
        assert!(mirrored.to_string().contains("mirrored"), "{mirrored}");
    }
    let mut picture = Image::new(1, 2, vec!["y".into()]);
    picture.values[0] = 1e39;
    for name in ["a.pfm", "a.exr"] {
        let beyond = image::write(&folder.path(name), &picture).unwrap_err();
        assert!(
            beyond.to_string().contains("in binary32; any in .npy"),
            "{beyond}"
        );
    }
    let quantised = image::write(&folder.path("b.png"), &picture).unwrap_err();
    assert!(
        quantised.to_string().contains("hold no numbers"),
        "{quantised}"
    );
    let mut left: Vec<_> = std::fs::read_dir(folder.path(""))
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    left.sort();
    assert_eq!(left, ["a.exr", "a.mha", "a.pfm"]);
    for name in left {
        assert_eq!(
            std::fs::read(folder.path(&name.to_string_lossy())).unwrap(),
            b"old"
        );
    }
}

#[test]
fn binary32_keeps_its_bits() {
    let values = [f32::MIN_POSITIVE, -0.0, f32::from_bits(1), f32::INFINITY];
    let grid = Grid {
        dimensions: [1, 4, 1],
        origin: [0.0; 3],
        spacing: [1.0; 3],
        direction: Grid::ALONG_AXES,
        samples: Samples::F32(values.to_vec()),
    };
    let folder = Folder::new();
    for name in ["a.vti", "a.nrrd", "a.mha", "a.npy"] {
        let _ = write(&folder.path(name), &grid, Turned::Refused).unwrap();
        assert_eq!(
            bits(&read(&folder.path(name)).unwrap().samples),
            bits(&grid.samples),
            "{name}"
        );
    }
}

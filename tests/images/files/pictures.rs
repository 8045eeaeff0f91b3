//! Pictures as other programs write them, by hand, and those that are not read.

use super::{Folder, crc32, zlib};
use volver::image::file::{Read, Reading, read, read_with};

fn picture(name: &str, contents: impl AsRef<[u8]>) -> Result<Read, String> {
    let folder = Folder::new().with(name, contents);
    read(&folder.path(name)).map_err(|error| error.trouble.to_string())
}

/// A PNG of 2 pixels by 2, without filters.
fn png(depth: u8, color: u8, rows: &[u8], more: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let head = [0, 0, 0, 2, 0, 0, 0, 2, depth, color, 0, 0, 0];
    let data = zlib(rows);
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let chunks = [(b"IHDR", &head[..])]
        .into_iter()
        .chain(more.iter().copied());
    for (name, contents) in chunks.chain([(b"IDAT", &data[..]), (b"IEND", &[][..])]) {
        let named = [&name[..], contents].concat();
        bytes.extend(u32::try_from(contents.len()).unwrap().to_be_bytes());
        bytes.extend(&named);
        bytes.extend(crc32(&named).to_be_bytes());
    }
    bytes
}

#[test]
fn png_integers_are_parts_of_the_largest() {
    // Grey of 16 bits, the most significant byte first; gAMA changes nothing.
    let rows = [0, 0, 1, 255, 255, 0, 0x12, 0x34, 0, 0];
    let read = picture(
        "a.png",
        png(16, 0, &rows, &[(b"gAMA", &[0, 0, 0xb1, 0x8f])]),
    )
    .unwrap();
    assert_eq!(
        read.image.values,
        [1.0 / 65535.0, 1.0, f64::from(0x1234) / 65535.0, 0.0]
    );
    assert_eq!(
        (read.quantum, read.image.channels),
        (Some(1.0 / 65535.0), vec!["y".to_owned()])
    );
    // RGB and alpha of 8 bits: nothing is multiplied.
    let rows = [0, 51, 102, 0, 255, 1, 2, 3, 0, 0, 9, 9, 9, 9, 8, 8, 8, 8];
    let read = picture("a.png", png(8, 6, &rows, &[])).unwrap();
    assert_eq!(
        read.image.pixel(1, 0),
        [1.0 / 255.0, 2.0 / 255.0, 3.0 / 255.0, 0.0]
    );
    assert_eq!(read.image.pixel(0, 0), [0.2, 0.4, 0.0, 1.0]);
    assert_eq!(read.image.channels, ["r", "g", "b", "a"]);
    for (bytes, word) in [
        (
            png(1, 0, &[0, 0, 0, 0], &[]),
            "1 bits a channel (allowed: 8 or 16)",
        ),
        (
            png(8, 3, &[0; 6], &[(b"PLTE", &[0; 3])]),
            "a palette (allowed: grey or RGB)",
        ),
        (png(8, 0, &[0; 6], &[(b"tRNS", &[0, 0])]), "(tRNS)"),
    ] {
        let said = picture("a.png", bytes).unwrap_err();
        assert!(said.contains(word), "{said}");
    }
    let mut broken = png(8, 0, &[0; 6], &[]);
    let middle = broken.len() - 20;
    broken[middle] ^= 1;
    assert!(picture("a.png", broken).is_err());
}

#[test]
fn pnm_integers_are_parts_of_maxval() {
    let read = picture("a.pgm", b"P5\n# of 99\n2 1 99\n\x00\x63").unwrap();
    assert_eq!(
        (read.image.values, read.quantum),
        (vec![0.0, 1.0], Some(1.0 / 99.0))
    );
    let read = picture("a.ppm", b"P6 1 1 1023\n\x03\xff\x00\x01\x00\x00").unwrap();
    assert_eq!(
        (read.image.values, read.quantum),
        (vec![1.0, 1.0 / 1023.0, 0.0], Some(1.0 / 1023.0))
    );
    for (bytes, word) in [
        (&b"P3 1 1 255 0 0 0"[..], "P6 or P5"),
        (b"P5 1 1 0\n\x00", "maxval 0 (allowed: 1 to 65535)"),
        (b"P5 1 1 65536\n\x00\x00", "maxval 65536"),
        (b"P5 2 1 255\n\x00", "1 bytes of data (allowed: 2"),
        (b"P5 1 1 255\n\x00\x00", "2 bytes of data (allowed: 1"),
        (b"P5 1 1 99\n\x64", "a value of 100 above maxval"),
        (b"P5 0 1 99\n", "1 or more along every axis"),
        (b"P5 -1 1 99\n", "width '-1'"),
        (b"P5 1", "each behind white space"),
    ] {
        let said = picture("a.pgm", bytes).unwrap_err();
        assert!(said.contains(word) && said.contains("(allowed: "), "{said}");
    }
}

#[test]
fn pfm_begins_with_its_lowest_row() {
    let data: Vec<u8> = [1.0_f32, 2.0, f32::NAN, 4.0, 5.0, 6.0]
        .iter()
        .flat_map(|value| value.to_be_bytes())
        .collect();
    let file = |head: &[u8]| [head, &data].concat();
    let read = picture("a.pfm", file(b"Pf\n2 3\n1.0\n")).unwrap();
    assert_eq!(read.image.pixel(0, 0), [5.0]);
    assert_eq!(read.image.pixel(1, 2), [2.0]);
    assert_eq!((read.nan, read.quantum), (1, None));
    let read = picture("a.pfm", file(b"PF\n1 2\n1\n")).unwrap();
    assert_eq!(read.image.pixel(0, 0), [4.0, 5.0, 6.0]);
    for (head, word) in [
        (&b"Pf\n2 3\n2.0\n"[..], "-1 or 1"),
        (b"Pf\n2 3\n0\n", "-1 or 1"),
        (b"Pf\n2\n1.0\n", "width and height"),
        (b"P5\n2 3\n1.0\n", "PF or Pf"),
        (b"Pf\n2 4\n1.0\n", "24 bytes of data (allowed: 32"),
    ] {
        let said = picture("a.pfm", file(head)).unwrap_err();
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn pictures_that_do_not_fit_are_refused() {
    let folder = Folder::new()
        .with("a.png", png(8, 0, &[0; 6], &[]))
        .with("a.pgm", b"P5 2 1 255\n\x00\x00")
        .with("a.raw", "");
    for name in ["a.png", "a.pgm"] {
        let said = read_with(&folder.path(name), Reading { memory: Some(9) })
            .unwrap_err()
            .to_string();
        assert!(
            said.contains("of memory") || said.contains("limit"),
            "{said}"
        );
        assert!(said.contains("(allowed: "), "{said}");
    }
    let said = read(&folder.path("a.raw")).unwrap_err().to_string();
    assert!(
        said.ends_with(
            "a name that ends with 'raw' (allowed: .exr, .npy, .pfm, .png, .ppm or .pgm)"
        ),
        "{said}"
    );
}

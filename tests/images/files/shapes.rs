//! Volumes as other programs write them, by hand.

use super::{Folder, crc32, volume, zlib};
use volver::volume::file::{Reading, read, read_with};
use volver::volume::{Grid, Samples};

/// Base64, as RFC 4648 has it.
fn base64(data: &[u8]) -> String {
    let digits: Vec<char> = ('A'..='Z')
        .chain('a'..='z')
        .chain('0'..='9')
        .chain(['+', '/'])
        .collect();
    let mut text = String::new();
    for group in data.chunks(3) {
        let bits = (0..3).fold(0_usize, |bits, i| {
            bits << 8 | usize::from(*group.get(i).unwrap_or(&0))
        });
        for place in 0..4 {
            let digit = digits[bits >> (18 - 6 * place) & 63];
            text.push(if place <= group.len() { digit } else { '=' });
        }
    }
    text
}

const VALUES: [i16; 6] = [1, -2, 300, -32768, 32767, 0];

fn big() -> Vec<u8> {
    VALUES
        .iter()
        .flat_map(|value| value.to_be_bytes())
        .collect()
}

fn vti(head: &str, array: &str, appended: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" {head}>\n<ImageData WholeExtent=\"1 3 0 1 -2 -2\" \
         Origin=\"10 20 30\" Spacing=\"0.5 2 4\" Direction=\"0 -1 0 1 0 0 0 0 1\"><Piece Extent=\"1 3 0 1 -2 -2\">\
         <PointData>{array}</PointData></Piece></ImageData>{appended}</VTKFile>"
    )
}

/// The first index is (1, 0, −2): x along +y, y along −x.
fn is_right(grid: &Grid) {
    assert_eq!(grid.dimensions, [3, 2, 1]);
    assert_eq!(grid.origin, [10.0, 20.5, 22.0]);
    assert_eq!(grid.spacing, [0.5, 2.0, 4.0]);
    assert_eq!(grid.place([1.0, 1.0, 0.0]), [8.0, 21.0, 22.0]);
    assert_eq!(grid.samples, Samples::F32(VALUES.map(f32::from).to_vec()));
}

#[test]
fn arrays_of_vti_in_every_form() {
    let head = "version=\"1.0\" byte_order=\"BigEndian\" header_type=\"UInt32\"";
    let inline = |data: &str| {
        format!("<DataArray type=\"Int16\" Name=\"a\" format=\"binary\">\n  {data}\n</DataArray>")
    };
    let length = 12_u32.to_be_bytes();
    // One text, as VTK has it, and a text for the header and one for the data.
    let whole = base64(&[&length[..], &big()].concat());
    let parted = base64(&length) + &base64(&big());
    assert_ne!(whole, parted);
    for text in [whole.clone(), parted] {
        is_right(&volume("a.vti", vti(head, &inline(&text), "")).unwrap());
    }
    // In blocks of 8 bytes, of which the last has 4; and in whole blocks, of which none is the last.
    for (size, last) in [(8, 4), (6, 0)] {
        let blocks: Vec<_> = big().chunks(size).map(zlib).collect();
        let numbers = [blocks.len(), size, last]
            .into_iter()
            .chain(blocks.iter().map(Vec::len));
        let header: Vec<u8> = numbers
            .flat_map(|n| u32::try_from(n).unwrap().to_be_bytes())
            .collect();
        let head = format!("{head} compressor=\"vtkZLibDataCompressor\"");
        let text = base64(&header) + &base64(&blocks.concat());
        is_right(&volume("a.vti", vti(&head, &inline(&text), "")).unwrap());
    }
    let array = "<DataArray type=\"Int16\" Name=\"a\" format=\"appended\" offset=\"3\"/>";
    let appended = format!("<AppendedData encoding=\"base64\">\n   _AAA{whole}</AppendedData>");
    is_right(&volume("a.vti", vti(head, array, &appended)).unwrap());
    let mut raw = vti(head, array, "<AppendedData encoding=\"raw\">_<>&").into_bytes();
    raw.truncate(raw.len() - "</VTKFile>".len());
    raw.extend(length);
    raw.extend(big());
    raw.extend(b"</AppendedData></VTKFile>");
    is_right(&volume("a.vti", raw).unwrap());
    let text = VALUES.map(|value| value.to_string()).join("\n ");
    let ascii = format!("<DataArray type=\"Int16\" Name=\"a\" format=\"ascii\">{text}</DataArray>");
    is_right(&volume("a.vti", vti("", &ascii, "")).unwrap());
}

/// A file is read in pieces of 2^20 bytes until the tag of appended data is found, wherever the piece ends.
#[test]
fn a_tag_that_two_pieces_share() {
    let array = "<DataArray type=\"Int16\" Name=\"a\" format=\"appended\" offset=\"0\"/>";
    let head = "byte_order=\"BigEndian\"";
    let data = base64(&[&12_u32.to_be_bytes()[..], &big()].concat());
    let text = vti(
        head,
        array,
        &format!("<AppendedData encoding=\"base64\">   _{data}</AppendedData>"),
    );
    let (before, after) = text.split_once("<AppendedData").unwrap();
    for cut in [0, 1, 7, 12, 13, 20, 34, 36, 37] {
        let padding = " ".repeat((1 << 20) - before.len() - cut);
        is_right(&volume("a.vti", format!("{before}{padding}<AppendedData{after}")).unwrap());
    }
}

#[test]
fn the_array_that_is_meant() {
    let array = |name: &str, value: u8| {
        format!("<DataArray type=\"UInt8\" Name=\"{name}\">{value} 0 0 0 0 0</DataArray>")
    };
    let both = array("a", 1) + &array("b", 2);
    let text = vti("", &both, "");
    let folder = Folder::new().with("none.vti", &text).with(
        "b.vti",
        text.replace("<PointData>", "<PointData Scalars=\"b\">"),
    );
    let undecided = read(&folder.path("none.vti")).unwrap_err().to_string();
    assert!(
        undecided.ends_with("2 arrays of points, none of them active (allowed: one of a, b)"),
        "{undecided}"
    );
    assert_eq!(read(&folder.path("b.vti")).unwrap().samples.at(0), 2.0);
    let asked = Reading {
        array: Some("a"),
        ..Reading::default()
    };
    assert_eq!(
        read_with(&folder.path("b.vti"), asked)
            .unwrap()
            .samples
            .at(0),
        1.0
    );
}

#[test]
fn nrrd_places_and_data() {
    let head = "NRRD0005\n# a comment\nkey:=a: value\ntype: short\ndimension: 3\nsizes: 3 2 1\nendian: big\n";
    let values = Samples::F32(VALUES.map(f32::from).to_vec());
    let raw = |fields: &str| {
        let mut bytes = format!("{head}encoding: raw\n{fields}\n").into_bytes();
        bytes.extend(big());
        volume("a.nrrd", bytes).unwrap()
    };
    // RAS: x and y change their signs; columns are directions times spacing.
    let grid = raw(
        "space: right-anterior-superior\nspace directions: (0,-0.5,0) (2,0,0) (0,0,4)\nspace origin: (1,2,3)\n",
    );
    assert_eq!(grid.origin, [-1.0, -2.0, 3.0]);
    assert_eq!(grid.spacing, [0.5, 2.0, 4.0]);
    assert_eq!(
        grid.direction,
        [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    );
    assert_eq!(grid.samples, values);
    let grid = raw("spacings: 1 2 4\naxis mins: 10 20 30\ncenterings: cell node cell\n");
    assert_eq!(grid.origin, [10.5, 20.0, 32.0]);
    let grid =
        raw("byte skip: -1\nspace dimension: 3\nspace origin: (1e-3, 2, 3)\nspacings: 1 1 1\n");
    assert_eq!(grid.origin, [1e-3, 2.0, 3.0]);
    // gzip: a stored block, its checksum and its length.
    let mut gzip = format!("{head}encoding: gzip\n\n").into_bytes();
    gzip.extend([0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 255]);
    let stream = zlib(&big());
    gzip.extend(&stream[2..stream.len() - 4]);
    gzip.extend(crc32(&big()).to_le_bytes());
    gzip.extend(12_u32.to_le_bytes());
    assert_eq!(volume("a.nrrd", gzip).unwrap().samples, values);
    let text = VALUES.map(|value| value.to_string()).join(" ");
    let ascii = format!("{head}encoding: ascii\n\n{text}\n");
    assert_eq!(volume("a.nrrd", ascii).unwrap().samples, values);
    // Detached: two lines and a byte before the data.
    let header = format!("{head}encoding: raw\ndata file: a.raw\nline skip: 2\nbyte skip: 1\n");
    let folder = Folder::new()
        .with("a.nhdr", header)
        .with("a.raw", [b"x\ny\nz", &big()[..]].concat());
    assert_eq!(read(&folder.path("a.nhdr")).unwrap().samples, values);
}

#[test]
fn meta_image_places_and_data() {
    let head = "ObjectType = Image\nNDims = 3\nDimSize = 3 2 1\nElementType = MET_SHORT\nElementSize = 9 9 9\n\
                ElementSpacing = 0.5 2 4\nElementByteOrderMSB = False\nBinaryDataByteOrderMSB = True\nPosition = 1 2 3\n\
                Rotation = 0 1 0 -1 0 0 0 0 1\nCenterOfRotation = 7 7 7\n";
    let wanted = Grid {
        dimensions: [3, 2, 1],
        origin: [1.0, 2.0, 3.0],
        spacing: [0.5, 2.0, 4.0],
        // The first triple is where x goes: +y.
        direction: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        samples: Samples::F32(VALUES.map(f32::from).to_vec()),
    };
    let local = [
        format!("{head}ElementDataFile = LOCAL\n").as_bytes(),
        &big(),
    ]
    .concat();
    assert_eq!(volume("a.mha", local).unwrap(), wanted);
    let packed = zlib(&big());
    let size = packed.len();
    let header = format!(
        "{head}CompressedData = True\nCompressedDataSize = {size}\nElementDataFile = a.zraw\r\n"
    );
    let folder = Folder::new().with("a.mhd", header).with("a.zraw", packed);
    assert_eq!(read(&folder.path("a.mhd")).unwrap(), wanted);
    let header = format!("{head}HeaderSize = -1\nElementDataFile = a.raw\n");
    let folder = Folder::new()
        .with("a.mhd", header)
        .with("a.raw", [b"header", &big()[..]].concat());
    assert_eq!(read(&folder.path("a.mhd")).unwrap(), wanted);
}

//! Volumes that are not read, and the word that each is refused with.

use super::{Folder, volume};
use volver::volume::file::{Reading, Trouble, read, read_with};

const VTI: &str = "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 0 0 0\"><Piece Extent=\"0 1 0 0 0 0\"><PointData>\
                   <DataArray type=\"Float32\" Name=\"a\">1 2</DataArray></PointData></Piece></ImageData></VTKFile>";
const NRRD: &str = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n";
const META: &str = "NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\n";

fn message(name: &str, contents: &str) -> String {
    match volume(name, contents) {
        Ok(grid) => panic!("{name} was read: {grid:?}\n{contents}"),
        Err(error) => error.trouble.to_string(),
    }
}

#[test]
fn the_files_that_the_others_differ_from_are_read() {
    assert_eq!(volume("a.vti", VTI).unwrap().samples.at(1), 2.0);
    assert_eq!(
        volume("a.nrrd", format!("{NRRD}\nab"))
            .unwrap()
            .samples
            .at(1),
        f64::from(b'b')
    );
    assert_eq!(
        volume("a.mha", format!("{META}ElementDataFile = LOCAL\nab"))
            .unwrap()
            .samples
            .at(1),
        f64::from(b'b')
    );
}

#[test]
fn vti() {
    for (from, to, word) in [
        (
            "ImageData\">",
            "RectilinearGrid\">",
            "type=\"RectilinearGrid\" (allowed: ImageData)",
        ),
        (
            "<ImageData ",
            "<ImageData Spacing=\"1 0 1\" ",
            "a spacing of [1.0, 0.0, 1.0]",
        ),
        (
            "<ImageData ",
            "<ImageData Spacing=\"1 -1 1\" ",
            "programs disagree",
        ),
        (
            "<ImageData ",
            "<ImageData Spacing=\"1 nan 1\" ",
            "finite numbers above 0",
        ),
        (
            "<ImageData ",
            "<ImageData Spacing=\"1 1\" ",
            "Spacing=\"1 1\"",
        ),
        (
            "<ImageData ",
            "<ImageData Origin=\"inf 0 0\" ",
            "an origin of",
        ),
        (
            "<ImageData ",
            "<ImageData Direction=\"1 0 0 0 -1 0 0 0 1\" ",
            "mirrored",
        ),
        (
            "<ImageData ",
            "<ImageData Direction=\"1 0.1 0 0 1 0 0 0 1\" ",
            "sheared",
        ),
        (
            "<ImageData ",
            "<ImageData Direction=\"2 0 0 0 1 0 0 0 1\" ",
            "sheared or not of length 1",
        ),
        (
            "Extent=\"0 1 0 0 0 0\">",
            "Extent=\"0 1 0 -1 0 0\">",
            "sizes [2, 0, 1]",
        ),
        (
            "WholeExtent=\"0 1",
            "WholeExtent=\"0 2",
            "one Piece, of the whole extent",
        ),
        ("</Piece>", "</Piece><Piece/>", "one Piece"),
        (
            "PointData",
            "CellData",
            "data of cells (allowed: data of points",
        ),
        (
            "Name=",
            "NumberOfComponents=\"3\" Name=",
            "1: one number a sample",
        ),
        ("Float32", "String", "type=\"String\""),
        (">1 2<", ">1<", "1 numbers (allowed: 2, as its header says)"),
        (">1 2<", ">1 2 3<", "more than 2 numbers"),
        (">1 2<", ">1 x<", "'x' at place 1 of the data"),
        (
            ">1 2<",
            " format=\"binary\">AAAA<",
            "data that end too early",
        ),
        (
            ">1 2<",
            " format=\"binary\">A?AA<",
            "a character that base64 has not",
        ),
        (
            ">1 2<",
            " format=\"binary\">BAAAAAAA<",
            "4 bytes of data (allowed: 8, as its header says)",
        ),
        (
            ">1 2<",
            " format=\"appended\" offset=\"0\"><",
            "into AppendedData",
        ),
        ("</VTKFile>", "", "no XML"),
    ] {
        let contents = VTI.replace(from, to);
        assert_ne!(contents, VTI);
        let said = message("a.vti", &contents);
        assert!(said.contains(word), "{said}\n{contents}");
    }
}

#[test]
fn bytes_of_vti() {
    let bytes = VTI.replace(">1 2<", " format=\"binary\">CAAAAAAAgD8AAABA<");
    assert_eq!(volume("a.vti", &bytes).unwrap().samples.at(1), 2.0);
    for (attribute, word) in [
        ("byte_order=\"Middle\"", "LittleEndian or BigEndian"),
        ("header_type=\"UInt16\"", "UInt32 or UInt64"),
        (
            "compressor=\"vtkLZ4DataCompressor\"",
            "vtkZLibDataCompressor, or none",
        ),
    ] {
        let contents = bytes.replace("<VTKFile ", &format!("<VTKFile {attribute} "));
        let said = message("a.vti", &contents);
        assert!(said.contains(word), "{said}");
    }
    // What other files a text may name is not opened.
    let entity = format!(
        "<!DOCTYPE a [<!ENTITY b SYSTEM \"/etc/hostname\">]>{}",
        VTI.replace(">1 2<", ">&b;<")
    );
    assert!(message("a.vti", &entity).contains("no XML"));
}

#[test]
fn nrrd() {
    for (fields, word) in [
        ("dimension: 4", "each field once"),
        ("bytes: 4", "fields that NRRD defines"),
        ("no field", "lines of 'field: value'"),
        ("kinds: domain vector domain", "kinds: vector"),
        ("spacings: 1 -1 1", "programs disagree"),
        ("spacings: 1 nan 1", "a spacing of"),
        ("axis mins: 0 0 0", "with spacings beside them"),
        ("axis maxs: 0 0 0", "with spacings beside them"),
        (
            "spacings: 1 1 1\naxis mins: 0 0 0",
            "node or cell for each axis",
        ),
        (
            "space directions: (1,0,0) (0,1,0) (0,0,1)",
            "without a space",
        ),
        (
            "space: LPS\nspace directions: (1,0,0) none (0,0,1)",
            "three vectors",
        ),
        (
            "space: LPS\nspace directions: (1,0,0) (0,0,0) (0,0,1)",
            "a spacing of",
        ),
        (
            "space: LPS\nspace directions: (1,0,0) (1,1,0) (0,0,1)",
            "sheared",
        ),
        (
            "space: LPS\nspace directions: (1,0,0) (0,-1,0) (0,0,1)",
            "mirrored",
        ),
        (
            "space: LAS\nspace directions: (1,0,0) (0,1,0) (0,0,1)",
            "mirrored",
        ),
        ("space: RAS\nspacings: 1 1 1", "space directions there"),
        ("space: 3D-left-handed", "programs disagree on others"),
        (
            "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspacings: 1 1 1",
            "which hold them",
        ),
        ("data file: LIST", "the name of one file"),
        ("data file: none.raw", "its data file"),
        ("line skip: -1", "0 or more"),
    ] {
        let said = message("a.nrrd", &format!("{NRRD}{fields}\n\nab"));
        assert!(said.contains(word), "{said}\n{fields}");
    }
    for (from, to, word) in [
        ("NRRD0004", "NRRD0009", "NRRD0001 to NRRD0005"),
        ("dimension: 3", "dimension: 2", "dimension: 2 (allowed: 3)"),
        ("sizes: 2 1 1", "sizes: 2 1", "three whole numbers"),
        ("sizes: 2 1 1", "sizes: 2 0 1", "1 or more along every axis"),
        (
            "sizes: 2 1 1",
            "sizes: 4294967296 4294967296 4294967296",
            "than a machine can address",
        ),
        (
            "sizes: 2 1 1",
            "sizes: 3 1 1",
            "2 bytes of data (allowed: 3, as its header says)",
        ),
        (
            "sizes: 2 1 1",
            "sizes: 1 1 1",
            "2 bytes of data (allowed: 1, as its header says)",
        ),
        ("type: uchar", "type: short", "little or big"),
        ("type: uchar", "type: block", "type: block"),
        ("encoding: raw", "encoding: bzip2", "raw, ascii or gzip"),
        ("encoding: raw", "encoding: gzip", "data that end too early"),
    ] {
        let said = message("a.nrrd", &format!("{NRRD}\nab").replace(from, to));
        assert!(said.contains(word), "{said}\n{to}");
    }
}

#[test]
fn meta_image() {
    for (from, to, word) in [
        (
            "NDims = 3",
            "NDims = 2",
            "2, 2 1 1 (allowed: 3, and three whole numbers)",
        ),
        (
            "NDims = 3",
            "ObjectType = Tube",
            "ObjectType = Tube (allowed: Image)",
        ),
        (
            "NDims = 3",
            "ElementNumberOfChannels = 3",
            "one number a sample",
        ),
        (
            "NDims = 3",
            "BinaryData = False",
            "data as text are not read",
        ),
        ("NDims = 3", "CompressedData = Maybe", "True or False"),
        (
            "NDims = 3",
            "CompressedData = True",
            "corrupt deflate stream",
        ),
        (
            "NDims = 3",
            "CompressedData = True\nCompressedDataSize = 9",
            "2 bytes of data (allowed: 9",
        ),
        ("NDims = 3", "ElementSpacing = 1 0 1", "a spacing of"),
        (
            "NDims = 3",
            "Offset = 1 2 3\nOrigin = 3 2 1",
            "the same as of the keys that mean the same: Origin",
        ),
        ("NDims = 3", "Offset = 1 2", "three numbers"),
        (
            "NDims = 3",
            "TransformMatrix = 1 0 0 0 1 0 0 0 -1",
            "mirrored",
        ),
        ("NDims = 3", "HeaderSize = -2", "-1, or a number of bytes"),
        ("MET_UCHAR", "MET_LONG", "ITK has 4 bytes for it, VTK 8"),
        ("MET_UCHAR", "MET_STRING", "MET_STRING"),
        ("MET_UCHAR", "MET_SHORT", "2 bytes of data (allowed: 4"),
        ("LOCAL", "LIST", "the name of one file"),
        ("ElementDataFile = LOCAL\n", "", "no ElementDataFile"),
        (
            "DimSize = 2 1 1",
            "DimSize = 2 1 1\nDimSize = 1 1 1",
            "each key once",
        ),
    ] {
        let contents = format!("{META}ElementDataFile = LOCAL\nab").replace(from, to);
        let contents = contents.trim_end_matches(if to.is_empty() { "ab" } else { "\0" });
        let said = message("a.mha", contents);
        assert!(said.contains(word), "{said}\n{contents}");
    }
}

#[test]
fn npy() {
    let file = |header: &str, data: &[u8]| {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    };
    let right = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 1, 2), }\n";
    assert_eq!(
        volume("a.npy", file(right, b"ab")).unwrap().dimensions,
        [2, 1, 1]
    );
    for (from, to, word) in [
        ("(1, 1, 2)", "(2,)", "three axes: (z, y, x)"),
        (
            "(1, 1, 2)",
            "(1, 1, 18446744073709551615)",
            "than a machine can address",
        ),
        ("(1, 1, 2)", "(1, 1, -2)", "no 'shape'"),
        ("(1, 1, 2)", "(1, 1, 3)", "2 bytes of data (allowed: 3"),
        ("False", "True", "ascontiguousarray"),
        ("|u1", "|O", "numbers of the type '|O'"),
        ("|u1", "<c8", "numbers of the type '<c8'"),
        ("'descr'", "'type'", "no 'descr'"),
    ] {
        let error = volume("a.npy", file(&right.replace(from, to), b"ab"))
            .unwrap_err()
            .to_string();
        assert!(error.contains(word), "{error}");
    }
    // 2^53 + 1 lies between two numbers of binary64.
    let whole = right.replace("|u1", "<u8").replace("1, 2", "1, 1");
    let error = volume("a.npy", file(&whole, &((1_u64 << 53) + 1).to_le_bytes()))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("at place 0 of the data is no number of binary64"),
        "{error}"
    );
    assert!(volume("a.npy", file(&whole, &((1_u64 << 53) + 2).to_le_bytes())).is_ok());
    assert!(message("a.npy", "no array").contains("no header of .npy"));
}

#[test]
fn more_memory_than_there_is() {
    // Two bytes of a file become two numbers of four bytes each.
    let folder = Folder::new().with("a.nrrd", format!("{NRRD}\nab"));
    let most = |memory| {
        read_with(
            &folder.path("a.nrrd"),
            Reading {
                memory: Some(memory),
                ..Reading::default()
            },
        )
    };
    assert!(most(8).is_ok());
    let error = most(7).unwrap_err();
    assert!(
        matches!(error.trouble, Trouble::Memory { need: 8, most: 7 }),
        "{error}"
    );
    // A sparse file of 2^50 bytes takes no place, and its samples more memory than any machine of ours has.
    let path = folder.path("large.nrrd");
    std::fs::write(&path, NRRD.replace("2 1 1", "1048576 1048576 1024") + "\n").unwrap();
    let large = std::fs::File::options().write(true).open(&path).unwrap();
    let header = large.metadata().unwrap().len();
    if large.set_len(header + (1 << 43)).is_ok() {
        std::fs::write(
            folder.path("b.nhdr"),
            NRRD.replace("2 1 1", "1048576 1048576 8") + "data file: large.nrrd\nbyte skip: -1\n",
        )
        .unwrap();
        let error = read(&folder.path("b.nhdr")).unwrap_err();
        assert!(matches!(error.trouble, Trouble::Memory { .. }), "{error}");
    }
}

#[test]
fn names_and_devices() {
    let ending = message("a.raw", "");
    assert!(
        ending.contains("ends with 'raw' (allowed: .vti, .nrrd"),
        "{ending}"
    );
    let folder = Folder::new();
    let missing = read(&folder.path("none.vti")).unwrap_err().to_string();
    assert!(
        missing.contains("none.vti: ") && missing.contains("(allowed: a file that can be opened"),
        "{missing}"
    );
    std::fs::create_dir(folder.path("folder.vti")).unwrap();
    let directory = read(&folder.path("folder.vti")).unwrap_err().to_string();
    assert!(directory.contains("(allowed: a file"), "{directory}");
}

//! Arrays and tables beside a scene: what is read of them, and what is refused.

use std::path::Path;
use volver::scene::{SceneError, read};

#[test]
fn arrays_of_every_allowed_type_are_read() {
    use npyz::WriterBuilder;
    fn write<T: npyz::AutoSerialize + Copy>(path: &Path, values: &[T]) {
        write_shaped(path, values, &[values.len() as u64]);
    }
    fn write_shaped<T: npyz::AutoSerialize + Copy>(path: &Path, values: &[T], shape: &[u64]) {
        let mut bytes = Vec::new();
        let mut writer = npyz::WriteOptions::new()
            .default_dtype()
            .shape(shape)
            .writer(&mut bytes)
            .begin_nd()
            .unwrap();
        writer.extend(values.iter().copied()).unwrap();
        writer.finish().unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("s.npy");
    let text = "[[media]]\nfrom = 0\nto = 1\nkind = 'sampled'\nsamples = 's.npy'\nextinction = 's'";
    let read_back = |write: &dyn Fn(&Path)| {
        write(&file);
        read(text, directory.path()).map(|scene| scene.fingerprint().to_string())
    };
    let expected = read_back(&|p| write(p, &[1.0_f64, 2.0, 3.0])).unwrap();
    assert_eq!(
        read_back(&|p| write(p, &[1.0_f32, 2.0, 3.0])).unwrap(),
        expected
    );
    assert_eq!(read_back(&|p| write(p, &[1_u8, 2, 3])).unwrap(), expected);
    assert_eq!(read_back(&|p| write(p, &[1_i16, 2, 3])).unwrap(), expected);
    let said = |result: Result<String, SceneError>| result.unwrap_err().to_string();
    let wide = said(read_back(&|p| write(p, &[1_i64, 2])));
    assert!(
        wide.contains("numbers of type") && wide.contains("<f4"),
        "{wide}"
    );
    let single = said(read_back(&|p| write(p, &[1.0_f64])));
    assert!(single.contains("1 samples (allowed: 2 to"), "{single}");
    let nan = said(read_back(&|p| write(p, &[1.0_f64, f64::NAN])));
    assert!(nan.contains("sample 1 is NaN"), "{nan}");
    let square = said(read_back(&|p| {
        write_shaped(p, &[1.0_f64, 2.0, 3.0, 4.0], &[2, 2]);
    }));
    assert!(square.contains("2 dimensions"), "{square}");
    // Big-endian, cut off, and no array at all.
    write(&file, &[1.0_f64, 2.0, 3.0]);
    let bytes = std::fs::read(&file).unwrap();
    let with = |from: &str, to: &str| {
        let mut changed = bytes.clone();
        let at = changed
            .windows(from.len())
            .position(|w| w == from.as_bytes())
            .unwrap();
        changed[at..at + from.len()].copy_from_slice(to.as_bytes());
        changed
    };
    let damaged = [
        (with("<f8", ">f8"), "big-endian"),
        (
            bytes[..bytes.len() - 5].to_vec(),
            "ends before its 3 numbers",
        ),
        (b"1,2,3".to_vec(), "no .npy"),
    ];
    for (bytes, what) in damaged {
        std::fs::write(&file, bytes).unwrap();
        let error = read(text, directory.path()).unwrap_err();
        assert_eq!(error.line, 5);
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn tables_out_of_order_single_or_negative_are_refused_with_their_line() {
    let directory = tempfile::tempdir().unwrap();
    let text = "[[media]]\nfrom = 0\nto = 1\nkind = 'sampled'\nsamples = [0, 1]\ntable = 't.csv'";
    let cases = [
        (
            "s,extinction,emission\n0,1,1\n0,2,1\n",
            "line 3: s = 0 comes after 0",
        ),
        (
            "s,extinction,emission\n0,1,1\n-1,2,1\n",
            "line 3: s = -1 comes after 0",
        ),
        ("s,extinction,emission\n0,1,1\n", "1 entries"),
        ("s,extinction\n0,1\n1,1\n", "no column 'emission'"),
        (
            "s,extinction,emission\n0,1,1\n1,-2,1\n",
            "line 3: extinction = -2 is negative",
        ),
        (
            "s,extinction,emission\n0,1,1\n1,nan,1\n",
            "line 3: 'nan' is no number",
        ),
        (
            "s,extinction,emission\n0,1,1\n1,1\n",
            "found record with 2 fields",
        ),
    ];
    for (table, what) in cases {
        std::fs::write(directory.path().join("t.csv"), table).unwrap();
        let error = read(text, directory.path()).unwrap_err();
        assert_eq!(error.line, 6);
        assert!(error.to_string().contains(what), "{error}\n{what}");
    }
    std::fs::remove_file(directory.path().join("t.csv")).unwrap();
    let error = read(text, directory.path()).unwrap_err().to_string();
    assert!(error.contains("t.csv"), "{error}");
}

//! Scenes read from text.

use super::{Form, Kind, Scene, SceneProblem, read};
use rug::Rational;
use std::path::Path;

fn media(text: &str) -> Result<Scene, SceneProblem> {
    read(text, Path::new(".")).map_err(|error| error.problem)
}

fn medium(body: &str) -> Result<Scene, SceneProblem> {
    media(&format!("[[media]]\nfrom = 0\nto = 2\n{body}\n"))
}

#[test]
fn what_is_constant_or_linear_is_known_to_be() {
    let form = |body: &str| medium(body).unwrap().media()[0].pieces[0].form.clone();
    let expression = |tau: &str, c: &str| {
        form(&format!(
            "kind = 'expression'\nextinction = '{tau}'\nemission = '{c}'"
        ))
    };
    assert!(matches!(expression("0", "5"), Form::Vacuum));
    assert!(matches!(
        expression("(lambda - lambda)*3", "1"),
        Form::Vacuum
    ));
    assert!(matches!(expression("2 + 1/3", "1"), Form::Constant(_)));
    assert!(matches!(expression("1 + lambda", "1"), Form::Linear { .. }));
    assert!(matches!(
        expression("1", "(1 + lambda)*2"),
        Form::Linear { .. }
    ));
    assert!(matches!(
        expression("1 + lambda^2", "1"),
        Form::Smooth { .. }
    ));
    let ends = form("kind = 'linear'\nextinction = {front = 1, back = 3}\nemission = 0.5");
    let Form::Linear { front, back } = ends else {
        panic!("{ends:?}");
    };
    assert_eq!(front[0].extinction, 1);
    assert_eq!(back[0].extinction, 3);
    // An exact decimal, not the nearest binary64.
    assert_eq!(
        form("kind = 'constant'\nextinction = 0.1"),
        form("kind = 'constant'\nextinction = '1/10'")
    );
    assert!(matches!(
        form("kind = 'linear'\nextinction = 2\nemission = 1"),
        Form::Constant(_)
    ));
}

impl PartialEq for Form {
    fn eq(&self, other: &Form) -> bool {
        format!("{self:?}") == format!("{other:?}")
    }
}

#[test]
fn media_are_cut_where_they_are_not_analytic() {
    let scene = medium(
        "kind = 'expression'\nextinction = 'piecewise(lambda < 1/3, 1, 2)'\nemission = 'abs(lambda^2 - 2)'",
    )
    .unwrap();
    let pieces = &scene.media()[0].pieces;
    assert_eq!(pieces.len(), 3);
    assert_eq!(pieces[0].to, Rational::from((1, 3)));
    // √2, to hundreds of bits.
    let square: Rational = Rational::from(pieces[1].to.square_ref()) - 2;
    assert!(square.to_f64().abs() < 1e-100);
    assert_eq!(scene.media()[0].blur, 0.0);
}

#[test]
fn fields_are_put_into_the_transfer_functions() {
    let scene = medium(
        "kind = 'expression'\nfield = '2*lambda'\nextinction = 'max(s, 1)'\nemission = 's/4'",
    )
    .unwrap();
    let pieces = &scene.media()[0].pieces;
    assert_eq!(pieces.len(), 2);
    assert_eq!(pieces[0].to, Rational::from((1, 2)));
    let Form::Linear { back, .. } = &pieces[1].form else {
        panic!("{pieces:?}");
    };
    assert_eq!(
        (back[0].extinction.to_f64(), back[0].emission.to_f64()),
        (4.0, 1.0)
    );
}

#[test]
fn samples_are_linear_between_or_nearest() {
    let samples = |how: &str| {
        medium(&format!(
            "kind = 'sampled'\nsamples = [0, 1, 0.5]\ninterpolation = '{how}'\nextinction = 's'\nemission = '1'"
        ))
        .unwrap()
    };
    let places = |scene: &Scene| -> Vec<f64> {
        let pieces = scene.media()[0].pieces.iter();
        pieces.map(|piece| piece.to.to_f64()).collect()
    };
    assert_eq!(places(&samples("linear")), [1.0, 2.0]);
    assert_eq!(places(&samples("nearest")), [0.5, 1.5, 2.0]);
    let nearest = samples("nearest");
    let forms: Vec<_> = nearest.media()[0].pieces.iter().map(|p| &p.form).collect();
    assert!(matches!(
        forms[..],
        [Form::Vacuum, Form::Constant(_), Form::Constant(_)]
    ));
}

#[test]
fn a_table_cuts_cells_where_the_field_passes_its_entries() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(
        directory.path().join("t.csv"),
        "s,extinction,emission\n0,0,1\n0.5,1,0\n1,4,2\n",
    )
    .unwrap();
    let scene = |lookup: &str| {
        let text = format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = 'sampled'\nsamples = [1, 0]\ntable = 't.csv'\ntable-interpolation = '{lookup}'"
        );
        read(&text, directory.path()).unwrap()
    };
    let linear = scene("linear");
    let pieces = &linear.media()[0].pieces;
    assert_eq!(pieces.len(), 2);
    let Form::Linear { front, back } = &pieces[0].form else {
        panic!("{pieces:?}");
    };
    assert_eq!(
        (front[0].extinction.to_f64(), back[0].extinction.to_f64()),
        (4.0, 1.0)
    );
    // Halfway between entries: s = 3/4 and 1/4.
    let nearest = scene("nearest");
    let places: Vec<f64> = nearest.media()[0]
        .pieces
        .iter()
        .map(|p| p.to.to_f64())
        .collect();
    assert_eq!(places, [0.25, 0.75, 1.0]);
}

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
    let said = |result: Result<String, super::SceneError>| result.unwrap_err().to_string();
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

#[test]
fn media_leave_no_gap_and_do_not_overlap() {
    let two = |from: &str, to: &str| {
        media(&format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = 'vacuum'\n[[media]]\nfrom = {from}\nto = {to}\nkind = 'vacuum'"
        ))
    };
    assert!(two("1", "2").is_ok());
    assert_eq!(
        two("1.5", "2").unwrap_err(),
        SceneProblem::Gap {
            end: 1.0,
            from: 1.5
        }
    );
    assert_eq!(
        two("0.5", "2").unwrap_err(),
        SceneProblem::Overlap {
            end: 1.0,
            from: 0.5
        }
    );
    assert_eq!(
        two("1", "1").unwrap_err(),
        SceneProblem::Order { from: 1.0, to: 1.0 }
    );
    assert_eq!(media("name = 'none'").unwrap_err(), SceneProblem::Empty);
}

#[test]
fn negative_and_undefined_values_are_refused_where_they_are() {
    let expression = |tau: &str, c: &str| {
        medium(&format!(
            "kind = 'expression'\nextinction = '{tau}'\nemission = '{c}'"
        ))
        .unwrap_err()
    };
    let SceneProblem::Value { what, at, value } = expression("1 - lambda", "1") else {
        panic!("not refused as negative");
    };
    assert_eq!(what, "extinction");
    assert!(at > 1.0 && at <= 2.0 && value.unwrap() < 0.0);
    assert!(matches!(
        expression("1", "ln(lambda - 1)"),
        SceneProblem::Value {
            what: "emission",
            ..
        }
    ));
    assert!(matches!(
        expression("1/(lambda - 1)", "1"),
        SceneProblem::Value {
            what: "extinction",
            ..
        }
    ));
    for (body, value) in [
        ("kind = 'constant'\nextinction = -1", -1.0),
        (
            "kind = 'linear'\nextinction = {front = 1, back = -0.5}",
            -0.5,
        ),
    ] {
        let SceneProblem::Value { value: found, .. } = medium(body).unwrap_err() else {
            panic!("{body}");
        };
        assert_eq!(found, Some(value));
    }
    for number in ["nan", "inf", "-inf"] {
        let error = medium(&format!("kind = 'constant'\nextinction = {number}")).unwrap_err();
        assert!(matches!(error, SceneProblem::Number { .. }), "{error}");
    }
}

#[test]
fn what_the_model_lacks_is_refused_with_the_reason() {
    let top = |features: &str| {
        media(&format!(
            "features = {features}\n[[media]]\nfrom = 0\nto = 1\nkind = 'constant'\nextinction = 1\nemission = 1"
        ))
    };
    assert!(top("['emission', 'absorption']").is_ok());
    let SceneProblem::Feature { feature, reason } =
        top("['emission', 'absorption', 'scattering']").unwrap_err()
    else {
        panic!("scattering was not refused");
    };
    assert_eq!(feature, "scattering");
    assert!(reason.contains("changes its direction"));
    assert_eq!(top("['absorption']").unwrap_err(), SceneProblem::Undeclared);
    assert!(matches!(
        top("['emission']").unwrap_err(),
        SceneProblem::Feature { .. }
    ));
    for key in ["scattering = 0.5", "albedo = 1", "phase = 'isotropic'"] {
        let error = medium(&format!("kind = 'constant'\nextinction = 1\n{key}")).unwrap_err();
        assert!(
            matches!(error, SceneProblem::Feature { .. }),
            "{key}: {error}"
        );
    }
}

#[test]
fn keys_belong_to_their_kinds() {
    for (body, what) in [
        (
            "kind = 'vacuum'\nextinction = 1",
            "'extinction' in a medium of kind 'vacuum'",
        ),
        ("kind = 'constant'", "without 'extinction'"),
        (
            "kind = 'constant'\nextinction = 1\nfield = 'lambda'",
            "'field' in a medium",
        ),
        ("kind = 'sampled'\nextinction = 's'", "without 'samples'"),
        ("kind = 'sampled'\nsamples = [1, 2]", "without 'table'"),
        (
            "kind = 'sampled'\nsamples = [1, 2]\nextinction = 's'\ntable = 'x'",
            "'extinction' in a medium of kind 'sampled'",
        ),
        (
            "kind = 'sampled'\nsamples = [1]\nextinction = 's'",
            "1 samples",
        ),
        (
            "kind = 'sampled'\nsamples = [1, 2, 3]\nspacing = 0.5\nextinction = 's'",
            "3 samples at a spacing of 0.5 are 1 long",
        ),
        (
            "kind = 'expression'\nextinction = 's'",
            "'s' has no value (allowed: lambda)",
        ),
        ("kind = 'expression'\nextinction = '1 +'", "'1 +': "),
        ("kind = 'fog'\nextinction = 1", "allowed: "),
        (
            "kind = 'constant'\nextinction = [1, 2]",
            "2 values for 1 channels",
        ),
    ] {
        let error = medium(body).unwrap_err().to_string();
        assert!(error.contains(what), "{error}\n{what}");
        assert!(error.contains("(allowed: "), "{error}");
    }
}

#[test]
fn channels_have_their_own_values_and_fingerprints_tell_scenes_apart() {
    let text = |c: &str| {
        format!(
            "channels = ['r', 'g']\nbackground = [0, 1]\n[[media]]\nfrom = 0\nto = 1\nkind = 'constant'\nextinction = [1, 2]\nemission = {c}"
        )
    };
    let scene = media(&text("[3, 4]")).unwrap();
    assert_eq!(scene.media()[0].kind, Kind::Constant);
    let Form::Constant(values) = &scene.media()[0].pieces[0].form else {
        panic!("not constant");
    };
    assert_eq!(
        (&values[1].extinction, &values[1].emission),
        (&2.into(), &4.into())
    );
    assert_ne!(
        scene.fingerprint(),
        media(&text("[3, 5]")).unwrap().fingerprint()
    );
    assert_eq!(
        scene.fingerprint(),
        media(&text("[3, 4]")).unwrap().fingerprint()
    );
    for names in ["[]", "['a', 'a']", "['s']", "['a b']"] {
        let text = format!("channels = {names}\n[[media]]\nfrom = 0\nto = 1\nkind = 'vacuum'");
        assert!(
            matches!(media(&text), Err(SceneProblem::ChannelNames { .. })),
            "{names}"
        );
    }
}

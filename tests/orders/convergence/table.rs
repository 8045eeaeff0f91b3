//! Tables as text: their layouts, floors and errors.

use rug::Float;
use volver::convergence::table::{FloorSource, Levels, Reading, Table, read};

fn errors(text: &str) -> Vec<(f64, f64)> {
    match read(text, &Reading::default()).unwrap().levels {
        Levels::Errors(samples) | Levels::Uncertain(samples, _) => {
            samples.iter().map(|s| (s.step, s.error.to_f64())).collect()
        }
        other @ Levels::Values(_) => panic!("{other:?}"),
    }
}

fn exact(x: u32) -> Reading {
    Reading {
        exact: Some(Float::with_val(53, x)),
        ..Reading::default()
    }
}

fn floors(table: &Table) -> Vec<f64> {
    match &table.levels {
        Levels::Errors(samples) | Levels::Uncertain(samples, _) => {
            samples.iter().map(|s| s.floor.to_f64()).collect()
        }
        Levels::Values(values) => values.iter().map(|v| v.floor.to_f64()).collect(),
    }
}

#[test]
fn every_layout_reads_the_same() {
    let expected = [(0.5, -0.25), (0.25, 0.0625)];
    for text in [
        "0.5,-0.25\n0.25,0.0625\n",
        "0.25;0.0625\n0.5;-0.25",
        "0.5\t-0.25\r\n0.25\t0.0625\r\n",
        "  0.5   -2.5e-1\n\n.25 625e-4  # half again\n",
        "# measured on a Monday\nh,error\n0.5,-0.25\n0.25,0.0625",
        "\u{feff}\"Step\" ; \"ERR\"\n\"0.5\" ; \"-0.25\"\n\"0.25\";0.0625",
        "e,dx\n-0.25,0.5\n0.0625,0.25\n",
        "d e\n0.5 -0.25\n0.25 0.0625\n",
        "N,Error\n4,0.0625\n2,-0.25\n",
    ] {
        assert_eq!(errors(text), expected, "{text:?}");
    }
}

#[test]
fn numbers_of_segments_are_kept() {
    let Levels::Errors(samples) = read("n,e\n8,1\n1e3,0.1", &Reading::default())
        .unwrap()
        .levels
    else {
        panic!("values");
    };
    assert_eq!([samples[0].n, samples[1].n], [Some(8), Some(1000)]);
    assert_eq!(samples[1].step, 1e-3);
}

#[test]
fn values_become_errors_where_the_exact_one_is_known() {
    for text in ["0.5,2.25\n0.25,2.0625", "h,q\n0.5,2.25\n0.25,2.0625"] {
        let Levels::Errors(samples) = read(text, &exact(2)).unwrap().levels else {
            panic!("values");
        };
        assert_eq!(samples[0].error, 0.25);
        assert_eq!(samples[1].error, 0.0625);
    }
}

#[test]
fn values_stay_values_otherwise() {
    let differences = Reading {
        differences: true,
        ..Reading::default()
    };
    for (text, reading) in [
        ("h,result\n.5,3\n.25,2", Reading::default()),
        (".25,2\n.5,3", differences),
    ] {
        let Levels::Values(values) = read(text, &reading).unwrap().levels else {
            panic!("errors");
        };
        assert_eq!(values[0].value, 3);
        assert_eq!(values[1].step, 0.25);
    }
}

#[test]
fn cancelling_digits_beyond_binary64_survive() {
    let digits = "1.00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000";
    let text = format!("0.5,{digits}4\n0.25,{digits}1");
    let Levels::Errors(samples) = read(&text, &exact(1)).unwrap().levels else {
        panic!("values");
    };
    let ratio = Float::with_val(200, &samples[0].error / &samples[1].error).to_f64();
    assert!((ratio - 4.0).abs() < 1e-15);
    assert!(samples[1].error < 1e-98 && samples[1].error > 1e-100);
}

#[test]
fn floors_come_from_the_column_the_reading_or_the_digits() {
    let given = Reading {
        floor: Some(Float::with_val(53, 0.125)),
        ..exact(1)
    };
    for (text, reading, source, expected) in [
        (
            "h,e,floor\n1,1,0.5\n.5,1,.25",
            Reading::default(),
            FloorSource::Column,
            [0.5, 0.25],
        ),
        ("1,1\n.5,1", given, FloorSource::Given, [0.125, 0.125]),
        (
            "1,1.5\n.5,1.25",
            exact(1),
            FloorSource::Digits,
            [0.005, 0.005],
        ),
        (
            "1,12e2\n.5,1.3e3",
            exact(1),
            FloorSource::Digits,
            [50.0, 50.0],
        ),
        (
            "h,e\n1,1\n.5,1",
            Reading::default(),
            FloorSource::Unknown,
            [0.0, 0.0],
        ),
    ] {
        let table = read(text, &reading).unwrap();
        assert_eq!(table.floor_source, source);
        assert_eq!(floors(&table), expected, "{text:?}");
    }
}

#[test]
fn bad_text_is_named_with_line_column_and_what_is_allowed() {
    const NAMES: &str =
        "(allowed: h, d, dx, step or n; error, err, e, value, v, q or result; floor; stderr or se)";
    for (text, message) in [
        ("", "no rows of numbers (allowed: two or more rows of step and error or value)".to_string()),
        ("# nothing\n\n", "no rows of numbers (allowed: two or more rows of step and error or value)".into()),
        ("h,e\n", "no rows of numbers (allowed: two or more rows of step and error or value)".into()),
        ("\n1,2", "line 2: a single row has no order (allowed: two or more rows)".into()),
        ("1,2,3\n", "line 1: 3 fields (allowed: 2)".into()),
        ("h,e\n1,2\n1", "line 3: 1 fields (allowed: 2)".into()),
        ("1,2\n0.5,x", "line 2, error: 'x' is not allowed (allowed: finite decimal numbers)".into()),
        ("h,v,floor\n1,2,0\n0.5,1,NaN", "line 3, floor: 'NaN' is not allowed (allowed: finite decimal numbers)".into()),
        ("1,1e99999999999\n2,1", "line 1, error: '1e99999999999' is not allowed (allowed: finite decimal numbers)".into()),
        ("nan,nan\n2,1", "line 1, h: 'nan' is not allowed (allowed: finite decimal numbers)".into()),
        ("1,\n2,1", "line 1, error: '' is not allowed (allowed: finite decimal numbers)".into()),
        ("0,5;0,1\n1;2", "line 1, h: '0,5' is not allowed (allowed: finite decimal numbers)".into()),
        ("0,1\n2,1", "line 1, h: step '0' is not allowed (allowed: above 0, within binary64's range)".into()),
        ("-1,1\n2,1", "line 1, h: step '-1' is not allowed (allowed: above 0, within binary64's range)".into()),
        ("1e-400,1\n2,1", "line 1, h: step '1e-400' is not allowed (allowed: above 0, within binary64's range)".into()),
        ("1e400,1\n2,1", "line 1, h: step '1e400' is not allowed (allowed: above 0, within binary64's range)".into()),
        ("n,e\n0,1\n2,1", "line 2, n: '0' segments are not allowed (allowed: whole numbers, 1 to 2^53)".into()),
        ("n,e\n1.5,1\n2,1", "line 2, n: '1.5' segments are not allowed (allowed: whole numbers, 1 to 2^53)".into()),
        ("n,e\n9007199254740993,1\n2,1", "line 2, n: '9007199254740993' segments are not allowed (allowed: whole numbers, 1 to 2^53)".into()),
        ("h,e,floor\n1,1,-1e-9\n2,1,0", "line 2, floor: '-1e-9' is not allowed (allowed: 0 or above)".into()),
        ("1,1\n2,1\n1.0,3", "line 3: step '1.0' stands in line 1 already (allowed: each step once)".into()),
        ("h,time\n1,1\n2,1", "line 1: unknown column 'time' ".to_string() + NAMES),
        ("h,n,e\n1,1,1\n2,1,1", "line 1: column 'n' is one too many (allowed: one step or n, one error or value, one floor, one standard error)".into()),
        ("h,error,value\n1,1,1\n2,1,1", "line 1: column 'value' is one too many (allowed: one step or n, one error or value, one floor, one standard error)".into()),
        ("error\n1\n2", "line 1: the header has no step ".to_string() + NAMES),
        ("h,floor\n1,1\n2,1", "line 1: the header has no error or value ".to_string() + NAMES),
    ] {
        let error = read(text, &Reading::default()).unwrap_err();
        assert_eq!(error.to_string(), message, "{text:?}");
    }
}

#[test]
fn a_header_of_errors_contradicts_a_reading_of_values() {
    let differences = Reading {
        differences: true,
        ..Reading::default()
    };
    for reading in [exact(1), differences] {
        let error = read("h,err\n1,2\n2,3", &reading).unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 1: column 'err' holds errors (allowed with an exact value or differences: value, v, q, result)"
        );
    }
    let twice = Reading {
        floor: Some(Float::new(53)),
        ..Reading::default()
    };
    assert_eq!(
        read("h,e,Floor\n1,2,3\n2,3,4", &twice)
            .unwrap_err()
            .to_string(),
        "line 1: column 'Floor' and a common floor exclude each other (allowed: one of them)"
    );
}

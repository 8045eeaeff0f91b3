//! `volver fit`, driven for real.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use std::cell::Cell;
use std::io::Write;
use volver::convergence::Pair;
use volver::convergence::table::{MAX_ROWS, Reading, read};
use volver::report::fit::by_level;

const SECOND_ORDER: &str = "0.4,8e-2\n0.2,2e-2\n0.1,5e-3\n0.05,1.25e-3\n";

fn volver(arguments: &[&str], input: &str) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.args(arguments).write_stdin(input.to_string());
    command
}

/// The single JSON document of a fit.
fn json(arguments: &[&str], input: &str) -> Value {
    let output = volver(arguments, input).arg("--json").output().unwrap();
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// A line that names something, in a column as wide as the names, and says this of it.
fn says(name: &str, what: &str) -> impl Predicate<str> {
    let (name, what) = (name.to_string(), what.to_string());
    predicate::function(move |text: &str| {
        let behind = text.lines().filter_map(|line| line.strip_prefix(&name));
        let mut said = behind.filter_map(|rest| rest.strip_prefix(' '));
        said.any(|rest| format!("{}\n", rest.trim_start()).starts_with(&what))
    })
}

/// Exit code 2, nothing on standard output, exactly this line on standard error.
fn refuses(arguments: &[&str], input: &str, message: &str) {
    volver(arguments, input)
        .assert()
        .code(2)
        .stdout("")
        .stderr(format!("volver: {message}\n"));
}

#[test]
fn a_table_on_standard_input_is_fitted() {
    volver(&["fit", "-"], SECOND_ORDER)
        .assert()
        .code(0)
        .stderr("")
        .stdout(
            "order     2.0000 ± 0.0000\n\
         window    step 4.0000e-1 to 5.0000e-2, 4 levels, pairwise orders within 0.02\n\
         constant  5.0000e-1 in |e| = c d^p\n\
         floor     unknown\n\
         verdict   Fitted\n\
         \n\
         \x20 level  n       step      error   order\n\
         \x20     0  -  4.0000e-1  8.0000e-2       -  window\n\
         \x20     1  -  2.0000e-1  2.0000e-2  2.0000  window\n\
         \x20     2  -  1.0000e-1  5.0000e-3  2.0000  window\n\
         \x20     3  -  5.0000e-2  1.2500e-3  2.0000  window\n",
        );
}

#[test]
fn a_file_gives_the_same_as_standard_input() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(SECOND_ORDER.as_bytes()).unwrap();
    let path = file.path().to_str().unwrap();
    let from_file = volver(&["fit", path], "").output().unwrap();
    let from_input = volver(&["fit", "-"], SECOND_ORDER).output().unwrap();
    assert_eq!(from_file, from_input);
}

#[test]
fn an_expectation_makes_it_a_check() {
    for (expected, verdict, code) in [
        ("2", "Confirmed", 0),
        ("3", "TooLow", 1),
        ("1", "TooHigh", 1),
        ("-1", "TooHigh", 1),
        ("exact", "TooLow", 1),
    ] {
        volver(&["fit", "-", "--expect", expected], SECOND_ORDER)
            .assert()
            .code(code)
            .stdout(says(
                "verdict",
                &format!("{verdict} (expected {expected})\n"),
            ));
    }
    let zeros = "4,0\n2,0\n1,0\n0.5,0";
    volver(&["fit", "-", "--expect", "exact"], zeros)
        .assert()
        .code(0);
    volver(&["fit", "-", "--expect", "2"], zeros)
        .assert()
        .code(1);
}

#[test]
fn what_is_inconclusive_does_not_pass() {
    for (table, verdict) in [
        ("4,1\n2,.25\n1,.0625", "TooFewLevels"),
        ("8,1\n4,2\n2,4\n1,8", "Diverged"),
        ("8,1\n4,1\n2,1\n1,1", "Stalled"),
        ("8,1\n4,-.25\n2,.0625\n1,-.015625", "Oscillatory"),
        ("8,1\n4,.5\n2,.125\n1,.015", "PreAsymptotic"),
        (
            "h,e,floor\n8,1,.01\n4,.4,.01\n2,.1,.01\n1,.01,.01",
            "FloorLimited",
        ),
    ] {
        for arguments in [&["fit", "-", "--expect", "2"][..], &["fit", "-"]] {
            let code = i32::from(arguments.len() > 2);
            volver(arguments, table)
                .assert()
                .code(code)
                .stdout(says("verdict", verdict));
        }
    }
}

#[test]
fn json_holds_everything_under_its_names() {
    let table = "n,error,floor\n8,.25,1e-9\n16,-.0315,1e-9\n32,-.0079,1e-9\n64,-.00197,1e-9\n128,-.000492,1e-9\n256,1e-9,1e-9\n";
    let document = json(&["fit", "-", "--expect", "2"], table);
    assert_eq!(document["verdict"], "Confirmed");
    assert_eq!(document["passes"], true);
    assert_eq!(document["expected"], 2.0);
    assert_eq!(document["source"], "errors");
    assert_eq!(document["floor_source"], "column");
    assert!((number(&document["order"]) - 2.0).abs() < 0.01);
    assert!(number(&document["half_width"]) < 0.05);
    assert_eq!(document["window"]["coarsest_n"], 16);
    assert_eq!(document["window"]["finest_n"], 128);
    assert_eq!(document["cut"]["level"], 5);
    assert_eq!(document["pairs"].as_array().unwrap().len(), 5);
    assert_eq!(document["notes"][0]["note"], "sign-change");
    assert_eq!(document["samples"][1]["error"], -0.0315);
    let free = json(&["fit", "-"], table);
    assert_eq!(
        (&free["passes"], &free["expected"]),
        (&Value::Null, &Value::Null)
    );
    assert_eq!(
        json(&["fit", "-", "--expect", "exact"], table)["expected"],
        "exact"
    );
}

#[test]
fn errors_below_binary64_are_strings_in_json_and_count_all_the_same() {
    let table = "8,64e-2000\n4,16e-2000\n2,4e-2000\n1,1e-2000\n";
    let document = json(&["fit", "-", "--expect", "2"], table);
    assert_eq!(document["verdict"], "Confirmed");
    assert_eq!(document["samples"][3]["error"], "1.0000000000000000e-2000");
    volver(&["fit", "-"], table)
        .assert()
        .stdout(contains("constant  1.0000e-2000 in |e| = c d^p\n"));
}

#[test]
fn exact_values_and_floors_are_taken_from_the_options() {
    let table = "n,value\n4,1.0100\n8,1.0025\n16,1.000625\n32,1.00015625\n";
    let document = json(&["fit", "-", "--exact", "1", "--expect", "2"], table);
    assert_eq!(document["verdict"], "Confirmed");
    assert_eq!(document["source"], "exact");
    assert_eq!(document["floor"], 5e-9);
    assert_eq!(document["floor_source"], "digits");
    let coarse = json(&["fit", "-", "--exact", "1", "--floor", "1e-3"], table);
    assert_eq!(coarse["verdict"], "FloorLimited");
    assert_eq!(coarse["floor_source"], "given");
    let negative = json(
        &["fit", "-", "--exact", "-1"],
        "n,v\n4,1.00\n8,1.00\n16,1.00\n32,1.00\n",
    );
    assert_eq!(negative["verdict"], "Stalled");
    assert_eq!(negative["samples"][0]["error"], 2.0);
}

/// 1/3 + 7·10⁻⁹⁰/4ᵏ with 110 digits: binary64 sees one and the same value.
fn hundred_digits() -> (String, String) {
    use rug::{Float, ops::Pow};
    let third = Float::with_val(500, 1) / 3_u32;
    let digits = |x: &Float| format!("{x:.110}");
    let mut table = String::from("n,value\n");
    for k in 0..6_u32 {
        let value = third.clone() + Float::with_val(500, 10).pow(-90_i32) * 7_u32 / 4_u32.pow(k);
        table.push_str(&[(8_u32 << k).to_string(), digits(&value)].join(","));
        table.push('\n');
    }
    (table, digits(&third))
}

#[test]
fn a_hundred_digits_are_used() {
    let (table, exact) = hundred_digits();
    let document = json(&["fit", "-", "--exact", &exact, "--expect", "2"], &table);
    assert_eq!(document["verdict"], "Confirmed");
    assert!((number(&document["samples"][0]["error"]) - 7e-90).abs() < 1e-99);
    let document = json(&["fit", "-", "--expect", "2"], &table);
    assert_eq!(document["verdict"], "Confirmed");
    assert_eq!(document["source"], "differences");
    assert!((number(&document["samples"][0]["error"]) / 7e-90 - 1.0).abs() < 1e-6);
}

#[test]
fn differences_are_fitted_on_request_and_by_header() {
    // 1 + h, in steps of changing ratio.
    let rows = "8,9.0000000\n5,6\n4,5\n2,3\n1,2\n.3,1.3\n.2,1.2\n";
    for (arguments, table) in [
        (
            &["fit", "-", "--expect", "1", "--richardson"][..],
            rows.to_string(),
        ),
        (&["fit", "-", "--expect", "1"], format!("h,v\n{rows}")),
    ] {
        volver(arguments, &table)
            .assert()
            .code(0)
            .stdout(contains("verdict   Confirmed (expected 1)\n"))
            .stdout(contains(
                "note      from differences alone: the limit itself may be wrong\n",
            ));
    }
}

#[test]
fn bad_tables_are_named_in_one_line() {
    let fit = &["fit", "-"][..];
    for (table, message) in [
        (
            "",
            "-: no rows of numbers (allowed: two or more rows of step and error or value)",
        ),
        (
            "1,2\n",
            "-: line 1: a single row has no order (allowed: two or more rows)",
        ),
        ("1,2\n2\n", "-: line 2: 1 fields (allowed: 2)"),
        (
            "1,2\n2,1e\n",
            "-: line 2, error: '1e' is not allowed (allowed: finite decimal numbers)",
        ),
        (
            "1,2\nnan,1\n",
            "-: line 2, h: 'nan' is not allowed (allowed: finite decimal numbers)",
        ),
        (
            "h,e,se\n2,2,1\n1,1,0\n",
            "-: line 3, se: '0' is not allowed (allowed: standard errors above 0)",
        ),
        (
            "h,e,stderr\n2,2,-1e-3\n1,1,1\n",
            "-: line 2, stderr: '-1e-3' is not allowed (allowed: standard errors above 0)",
        ),
        (
            "h,e,se\n2,2,nan\n1,1,1\n",
            "-: line 2, se: 'nan' is not allowed (allowed: finite decimal numbers)",
        ),
        ("h,e,se\n2,2,1\n1,1\n", "-: line 3: 2 fields (allowed: 3)"),
        (
            "h,v,se\n2,2,1\n1,1,1\n",
            "-: line 1: column 'se' needs errors (allowed: a column of errors, or values with an exact value)",
        ),
        (
            "h,e,se,stderr\n2,2,1,1\n1,1,1,1\n",
            "-: line 1: column 'stderr' is one too many (allowed: one step or n, one error or value, one floor, one standard error)",
        ),
        (
            "h,e\n1,2\n2,two\n",
            "-: line 3, e: 'two' is not allowed (allowed: finite decimal numbers)",
        ),
        (
            "1,2\n-2,3\n",
            "-: line 2, h: step '-2' is not allowed (allowed: above 0, within binary64's range)",
        ),
        (
            "1,2\n1,3\n",
            "-: line 2: step '1' stands in line 1 already (allowed: each step once)",
        ),
    ] {
        refuses(fit, table, message);
    }
    refuses(
        &["fit", "-", "--exact", "1"],
        "h,err\n1,2\n2,3\n",
        "-: line 1: column 'err' holds errors (allowed with an exact value or differences: value, v, q, result)",
    );
    refuses(
        &["fit", "-", "--richardson", "--expect", "exact"],
        "1,2\n2,3\n",
        "-: an exact method cannot be told from differences of values (allowed: an expected order, or an exact value)",
    );
}

#[test]
fn unreadable_files_are_named_in_one_line() {
    refuses(
        &["fit", "no/such/file.csv"],
        "",
        "no/such/file.csv: No such file or directory (os error 2) (allowed: a readable file of at most 67108864 bytes)",
    );
    let mut binary = cargo_bin_cmd!("volver");
    binary.args(["fit", "-"]).write_stdin(vec![0xff_u8, 0xfe]);
    binary.assert().code(2).stderr(
        "volver: -: byte 1 is not UTF-8 (allowed: a text in UTF-8, of at most 67108864 bytes)\n",
    );
}

#[test]
fn colours_show_on_request_only() {
    volver(&["fit", "-"], SECOND_ORDER)
        .assert()
        .stdout(says("verdict", "Fitted\n"));
    volver(&["fit", "-", "--color", "never"], SECOND_ORDER)
        .assert()
        .stdout(contains("\x1b").not());
    for (expected, painted) in [
        ("2", "\x1b[32mverdict   Confirmed (expected 2)\x1b[0m\n"),
        ("3", "\x1b[31mverdict   TooLow (expected 3)\x1b[0m\n"),
    ] {
        volver(
            &["fit", "-", "--color", "always", "--expect", expected],
            SECOND_ORDER,
        )
        .assert()
        .stdout(contains(painted));
    }
    volver(&["fit", "-", "--color", "always"], "2,4\n1,1\n")
        .assert()
        .stdout(contains("\x1b[33mverdict  TooFewLevels\x1b[0m\n"));
}

#[test]
fn output_fits_eighty_columns() {
    let tiny = "n,e,floor\n4194304,-1e-2000,1e-2100\n8388608,1.2345678e-2001,1e-2100\n16777216,1e-2100,1e-2100\n";
    for (arguments, table) in [
        (&["fit", "-"][..], tiny),
        (
            &["fit", "-", "--richardson"],
            "8,9.00000\n4,5\n2,3\n1,2\n.5,1.5\n",
        ),
        (&["fit", "-"], "8,1\n4,0\n2,1\n1,2\n"),
        (&["fit", "-"], "8,1\n4,1\n2,1\n1,1\n"),
        (
            &["fit", "-", "--exact", "0"],
            "8,9.000000\n4,4.500000\n2,2.250000\n1,1.125000\n.5,.000001\n",
        ),
    ] {
        let output = volver(arguments, table).output().unwrap();
        for line in String::from_utf8(output.stdout).unwrap().lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}

/// Looking at a pair is what is counted: once each, and once beyond the last, however many levels there are.
#[test]
fn a_table_of_levels_looks_at_each_pair_once() {
    let pair = |coarse| Pair {
        coarse,
        order: 2.0,
        above_floor: true,
        in_window: false,
        sign_change: false,
    };
    let levels = 100_000;
    // Neighbours of levels without an error have no pair.
    let pairs: Vec<Pair> = (0..levels - 1).filter(|c| c % 7 > 1).map(pair).collect();
    let looks = Cell::new(0);
    let counted = pairs
        .iter()
        .copied()
        .inspect(|_| looks.set(looks.get() + 1));
    let found: Vec<Option<Pair>> = by_level(levels, counted).collect();
    assert_eq!(looks.get(), pairs.len());
    assert_eq!(found.len(), levels);
    for (level, found) in found.iter().enumerate() {
        let expected = level.checked_sub(1).filter(|coarse| coarse % 7 > 1);
        assert_eq!(found.map(|pair| pair.coarse), expected);
    }
}

#[test]
fn a_table_has_as_many_rows_as_any_ladder_has() {
    let rows = "1,1\n".repeat(MAX_ROWS + 1);
    let error = read(&format!("n,e\n{rows}"), &Reading::default()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 1048578: a row too many (allowed: up to 1048576 rows)"
    );
}

#[test]
fn of_very_many_levels_the_finest_are_shown() {
    let row = |n: u32| format!("{n},{}e-9", 20_000 - n);
    let rows: Vec<String> = (1..=10_003).map(row).collect();
    let table = format!("n,e\n{}\n", rows.join("\n"));
    volver(&["fit", "-"], &table)
        .assert()
        .stdout(contains(
            "The finest 10000 of 10003 levels; --json has all of them.",
        ))
        .stdout(contains("\n      3      4  "))
        .stdout(contains("\n      2      3  ").not())
        .stdout(contains("\n  10002  10003  "));
    let all = json(&["fit", "-"], &table);
    assert_eq!(all["samples"].as_array().unwrap().len(), 10_003);
}

#[test]
fn at_least_asks_for_the_lower_end_of_the_interval() {
    for (least, code, said) in [
        ("1.9", 0, "1.9: yes\n"),
        ("-1", 0, "-1: yes\n"),
        ("2.1", 1, "2.1: no\n"),
    ] {
        volver(&["fit", "-", "--at-least", least], SECOND_ORDER)
            .assert()
            .code(code)
            .stdout(says("at least", said));
        let document = json(&["fit", "-", "--at-least", least], SECOND_ORDER);
        assert_eq!(document["passes"], code == 0);
        assert_eq!(number(&document["at_least"]), least.parse::<f64>().unwrap());
    }
    // 2.01 ± 0.02 or so: the upper end does not count.
    let rough = "8,1\n4,.2482\n2,.0624\n1,.01549\n.5,.00387\n";
    volver(&["fit", "-", "--at-least", "2"], rough)
        .assert()
        .code(1);
    volver(&["fit", "-", "--at-least", "1.9"], rough)
        .assert()
        .code(0);
    // Without an order, no order is reached; both checks have to pass.
    let growing = "8,1\n4,2\n2,4\n1,8";
    volver(&["fit", "-", "--at-least", "-3"], growing)
        .assert()
        .code(1);
    volver(
        &["fit", "-", "--at-least", "1", "--expect", "3"],
        SECOND_ORDER,
    )
    .assert()
    .code(1);
    volver(
        &["fit", "-", "--at-least", "1", "--expect", "2"],
        SECOND_ORDER,
    )
    .assert()
    .code(0);
    let mut refused = volver(&["fit", "-", "--at-least", "nan"], SECOND_ORDER);
    refused
        .assert()
        .code(2)
        .stdout("")
        .stderr(predicate::function(|text: &str| text.lines().count() == 1));
}

#[test]
fn errors_have_standard_errors_where_a_column_says_so() {
    // Within its standard errors this is order 1; without them no order shows.
    let rows = [
        (8, 8.3, 0.3),
        (4, 3.9, 0.15),
        (2, 2.05, 0.07),
        (1, 0.98, 0.04),
    ];
    let uncertain = rows.map(|(h, error, size)| format!("{h},{error},{size}\n"));
    let table = format!("h,error,stderr\n{}", uncertain.concat());
    let bare = rows.map(|(h, error, _)| format!("{h},{error}\n")).concat();
    let with = json(&["fit", "-"], &table);
    let without = json(&["fit", "-"], &bare);
    assert!((number(&with["order"]) - 1.0).abs() < number(&with["half_width"]));
    assert_eq!(with["window"]["first"], 0);
    // Three levels leave no room for a next power.
    assert!(number(&with["half_width"]) > 0.1);
    assert_ne!(without["half_width"], with["half_width"]);
    // They go with values, too, where the exact one is known.
    let values = "n,v,se\n4,1.25,1e-6\n8,1.125,1e-6\n16,1.0625,1e-6\n32,1.03125,1e-6\n";
    let document = json(&["fit", "-", "--exact", "1", "--expect", "1"], values);
    assert_eq!(document["verdict"], "Confirmed");
    assert_eq!(document["source"], "exact");
}

#[test]
fn numbers_that_are_none_are_a_verdict() {
    for bad in ["nan", "NaN", "inf", "-inf"] {
        let table = format!("8,64\n4,16\n2,{bad}\n1,1\n.5,.25\n");
        volver(&["fit", "-"], &table)
            .assert()
            .code(0)
            .stdout(says("verdict", "NotFinite\n"));
        volver(&["fit", "-", "--expect", "2"], &table)
            .assert()
            .code(1);
        let document = json(&["fit", "-", "--at-least", "1"], &table);
        assert_eq!(
            (&document["verdict"], &document["passes"]),
            (&Value::from("NotFinite"), &Value::from(false))
        );
    }
    let values = "n,v\n4,nan\n8,nan\n16,nan\n32,nan\n";
    volver(&["fit", "-"], values)
        .assert()
        .code(0)
        .stdout(says("verdict", "NotFinite\n"));
}

#[test]
fn without_a_window_no_order_and_no_constant_is_printed() {
    let table = "8,1\n4,.5\n2,.125\n1,.015";
    volver(&["fit", "-"], table)
        .assert()
        .stdout(says("order", "none\n"))
        .stdout(contains("constant").not())
        .stdout(contains("±").not());
    let document = json(&["fit", "-"], table);
    for name in ["order", "half_width", "log2_constant", "window"] {
        assert_eq!(document[name], Value::Null, "{name}");
    }
}

#[test]
fn remarks_are_put_in_words() {
    let rows: Vec<String> = (0..10)
        .map(|k| {
            let h = 0.5_f64.powi(k);
            format!("{h:e},{:e}\n", h * h + h / 64.0)
        })
        .collect();
    volver(&["fit", "-"], &rows.concat()).assert().stdout(says(
        "note",
        "order 2 gives way to order 1 at step 1.5625e-2\n",
    ));
}

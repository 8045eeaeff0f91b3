//! What is written and read between two processes, to the last bit.

use super::fixture::subject;
use rug::Float;
use serde_json::{Value, json};
use std::num::NonZeroU64;
use std::sync::LazyLock;
use volver::inside::kernel::{
    Array, Numbers, Trouble, Written, quoted, read_answer, read_greeting,
};
use volver::kernel::process::schema;
use volver::kernel::{
    Data, Declaration, FormKind, KernelError, Rendering, Sampling, Subject, Task,
};
use volver::real::FormatName;
use volver::symbolic::code::Language;

static SUBJECT: LazyLock<Subject> = LazyLock::new(|| subject("homogeneous"));

/// The results in the answer to a request of id 7 for one task.
fn results(line: &[u8], bits: u32) -> Result<Vec<Result<Rendering, KernelError>>, Trouble> {
    let task = Task {
        subject: &*SUBJECT,
        step: 1.0,
        segments: 2,
        seed: 0,
        data: Data::Function,
    };
    read_answer(line, 7, &[&task], bits)
}

/// The radiance that an answer gives as `json`, to at least that many bits.
fn read(json: &str, bits: u32) -> Option<Float> {
    let line = format!(r#"{{"type":"radiance","id":7,"results":[{{"radiance":[{json}]}}]}}"#);
    let mut rendering = results(line.as_bytes(), bits).ok()?.pop()?.unwrap();
    rendering.radiance.pop()
}

fn number(json: &str) -> Float {
    read(json, 53).unwrap()
}

#[test]
fn numbers_are_read_to_the_last_bit() {
    for value in [0.1, -1e-310, f64::MAX, 5e-324, 2.0_f64.powi(60), 0.3 * 3.0] {
        assert_eq!(number(&format!("{value:?}")), value);
        // Text is no subnormal: it has all its bits.
        assert_eq!(number(&format!("\"{value:?}\"")).to_f64(), value);
    }
    // Readers that round only nearly right are right for many numbers.
    for i in 1..1000_u64 {
        let mantissa = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 12;
        let value = f64::from_bits((1000 + i % 40) << 52 | mantissa);
        assert_eq!(number(&format!("{value:?}")), value);
    }
    for (text, value) in [
        ("1", 1.0),
        ("-3", -3.0),
        ("\"0x1.8p-3\"", 0.1875),
        ("\"-0X.8P+1\"", -1.0),
        ("\"0x1p-1074\"", 5e-324),
        ("\"0x10\"", 16.0),
        ("\"+1e2\"", 100.0),
        ("\".5\"", 0.5),
        ("\"5.\"", 5.0),
        ("\"-Infinity\"", f64::NEG_INFINITY),
        ("\"inf\"", f64::INFINITY),
    ] {
        assert_eq!(number(text), value, "{text}");
    }
    assert!(number("\"nan\"").is_nan() && number("\"-NaN\"").is_nan());
    // What nothing can hold.
    assert_eq!(number("\"-1e-99999999999999999999\""), 0.0);
    assert_eq!(number("\"1e99999999999999999999\""), f64::INFINITY);
    // What binary64 cannot hold.
    assert_eq!(number("\"1e-400\"").to_f64(), 0.0);
    assert!(number("\"1e-400\"") > 0);
    let sixty = format!("\"0.{}\"", "3".repeat(60));
    let error = Float::with_val(400, 1) / 3_u32 - number(&sixty);
    assert!(error.abs() < 1e-59);
    let exact = number("\"0x1.00000000000000000000000000001p0\"") - 1_u32;
    assert_eq!(exact, Float::with_val(53, Float::i_exp(1, -116)));
    // A short decimal means what the format of the kernel makes of it.
    assert_eq!(number("\"0.1\""), 0.1);
    let tenth = Float::with_val(200, Float::parse("0.1").unwrap());
    assert_eq!(read("\"0.1\"", 200), Some(tenth));
}

#[test]
fn what_is_no_number_is_refused() {
    for text in [
        "",
        "-",
        ".",
        "e5",
        "1e",
        "1e+",
        "0x",
        "0x.",
        "0x1p",
        "0x1p1.5",
        "0x1p999999999999",
        "1_0",
        " 1",
        "1 ",
        "--1",
        "+-1",
        "0x-1",
        "1e5e5",
        "1.2.3",
        "@nan@",
        "nanx",
        "infin",
        "1/2",
        "0b1",
        "٣",
    ] {
        assert_eq!(read(&Value::from(text).to_string(), 53), None, "{text}");
    }
    for json in ["null", "true", "[1]", "{}"] {
        assert_eq!(read(json, 53), None, "{json}");
    }
}

#[test]
fn numbers_are_written_to_the_last_bit() {
    let hexadecimal = |value| Written {
        value,
        numbers: Numbers::Hexadecimal,
    };
    for (value, text) in [
        (0.1875, "0x1.8p-3"),
        (1.0, "0x1p+0"),
        (-0.0, "-0x0p+0"),
        (0.1, "0x1.999999999999ap-4"),
        (5e-324, "0x0.0000000000001p-1022"),
        (f64::MAX, "0x1.fffffffffffffp+1023"),
        (f64::NAN, "nan"),
        (f64::NEG_INFINITY, "-inf"),
    ] {
        let written = serde_json::to_string(&hexadecimal(value)).unwrap();
        assert_eq!(written, format!("\"{text}\""));
        if value.is_finite() {
            assert_eq!(number(&written), value);
        }
    }
    let row = [0.1, 1e300, 2.0, f64::INFINITY];
    let row = serde_json::to_string(&Array::Here(&row, Numbers::Decimal)).unwrap();
    assert_eq!(row, "[0.1,1e+300,2.0,\"inf\"]");
}

#[test]
fn bare_nan_becomes_text_outside_texts_alone() {
    let quoted = |line: &str| Some(String::from_utf8(quoted(line.as_bytes())?).unwrap());
    assert_eq!(
        quoted(r#"{"NaN":[NaN,-Infinity,Infinity],"a\"NaN":1}"#).unwrap(),
        r#"{"NaN":["nan","-inf","inf"],"a\"NaN":1}"#
    );
    for line in [r#"{"a":"NaN"}"#, "", "\"", "\"\\", "[1]"] {
        assert_eq!(quoted(line), None);
    }
}

#[test]
fn greetings_say_all_that_a_declaration_holds() {
    let line = br#"{"type":"hello","protocol":1,"name":"nerf","form":"formula","language":"c","method":
        "front-to-back/front/subtraction","order":"2","format":"f32","quantum":0.5,"stochastic":true,
        "sampling":"ends","segments":{"multiple_of":2},"step":"divides","far_wall":true,"numbers":"hexadecimal","arrays":"npy"}"#;
    let greeting = read_greeting(line).unwrap();
    let declaration = Declaration {
        form: FormKind::Formula(Language::C),
        method: Some("front-to-back/front/subtraction".parse().unwrap()),
        order: Some(2.0),
        format: FormatName::F32,
        quantum: Some(0.5),
        stochastic: true,
        sampling: Some(Sampling::Ends),
        step_divides: true,
        multiple_of: NonZeroU64::new(2).unwrap(),
        far_wall: true,
        ..Declaration::new("nerf")
    };
    assert_eq!(greeting.declaration, declaration);
    assert_eq!(greeting.numbers, Numbers::Hexadecimal);
    let least = br#"{"type":"hello","protocol":1,"name":"a","form":"segments"}"#;
    let least = read_greeting(least).unwrap();
    assert_eq!(least.declaration, Declaration::new("a"));
    assert_eq!(
        greeting.changes(&least).len(),
        13,
        "every key is told apart"
    );
    assert!(least.changes(&least).is_empty());
}

#[test]
fn what_is_wrong_with_a_greeting_is_named_with_what_is_allowed() {
    let refused = |key: &str, value: Value| {
        let mut hello = json!({"type": "hello", "protocol": 1, "name": "a", "form": "segments"});
        hello[key] = value;
        match read_greeting(hello.to_string().as_bytes()) {
            Err(Trouble::Greeting { problem }) => problem,
            other => panic!("{other:?}"),
        }
    };
    for (key, value, words) in [
        ("protocol", json!(2), "protocol 2 (allowed: 1)"),
        ("protocol", json!("1"), "protocol \"1\" (allowed: 1)"),
        (
            "type",
            json!("radiance"),
            "unknown variant 'radiance' (allowed: 'hello')",
        ),
        ("name", json!(""), "name '' (allowed: 1 to 100 characters"),
        ("name", json!("a\u{1b}[2J"), "name 'a\\u{1b}[2J' (allowed: "),
        (
            "form",
            json!("function"),
            "unknown variant 'function' (allowed: 'segments', 'volume', 'formula')",
        ),
        (
            "form",
            json!("formula"),
            "no language of the formula (allowed: python, c, rust)",
        ),
        ("language", json!("c"), "a language without need (allowed: "),
        ("method", json!("nerf"), "method: "),
        ("order", json!(0), "order 0 (allowed: finite, above 0)"),
        ("order", json!("nan"), "order NaN (allowed: "),
        ("quantum", json!("-inf"), "quantum -inf (allowed: "),
        ("format", json!("float"), "format: "),
        (
            "segments",
            json!({"multiple_of": 0}),
            "segments: multiples of 0 (allowed: of 1 or more)",
        ),
        (
            "segments",
            json!(2),
            "invalid type: integer '2' (allowed: an object with the key multiple_of)",
        ),
        (
            "segments",
            json!({"multiples": 2}),
            "unknown key 'multiples' (allowed: 'multiple_of')",
        ),
        (
            "step",
            json!("fixed"),
            "unknown variant 'fixed' (allowed: 'divides')",
        ),
        (
            "sampling",
            json!("left"),
            "unknown variant 'left' (allowed: 'front', 'middle', ",
        ),
        (
            "stochastic",
            json!(1),
            "invalid type: integer '1' (allowed: a boolean)",
        ),
        (
            "metod",
            json!("x"),
            "unknown key 'metod' (allowed: 'type', 'protocol', 'name', ",
        ),
    ] {
        let said = refused(key, value);
        assert!(said.starts_with(words), "{said}");
    }
    for line in ["", "[]", "1", "{", "hello", "\u{0}"] {
        assert!(
            matches!(read_greeting(line.as_bytes()), Err(Trouble::Garbage { .. })),
            "{line}"
        );
    }
}

#[test]
fn any_bytes_are_an_answer_or_are_refused() {
    let line = br#"{"type":"radiance","id":7,"results":[{"radiance":["-0x1.8p-3"],"opacity":NaN,"step":"1e-5",
        "segments":4,"standard_error":[-Infinity]}]}"#;
    let rendering = results(line, 53).unwrap().pop().unwrap().unwrap();
    assert_eq!(rendering.radiance[0], -0.1875);
    let (mut answers, mut random) = (0, 1_u64);
    for _ in 0..20_000 {
        let mut line = line.to_vec();
        for _ in 0..2 {
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let place = (random >> 33) as usize % line.len();
            match random >> 62 {
                0 => line[place] = (random >> 20).to_le_bytes()[0],
                1 => line.truncate(place + 1),
                2 => line[place] = b"0123456789\"-+.ex[]{}"[(random >> 20) as usize % 20],
                _ => drop(line.remove(place)),
            }
        }
        answers += usize::from(results(&line, 53).is_ok());
    }
    // Some are hurt where it does not matter.
    assert!((20..10_000).contains(&answers), "{answers}");
}

#[test]
fn the_schema_kept_is_that_of_the_messages() {
    let kept = include_str!("../../../docs/protocol.schema.json");
    let now = serde_json::to_string_pretty(&schema()).unwrap() + "\n";
    assert_eq!(
        kept, now,
        "volver schema protocol > docs/protocol.schema.json"
    );
}

//! What is written and read between two processes, to the last bit.

use super::fixture::subject;
use rug::Float;
use serde_json::{Value, json};
use std::num::{NonZeroU64, NonZeroUsize};
use std::sync::LazyLock;
use volver::inside::kernel::{
    Array, Greeting, Numbers, Trouble, Written, quoted, read_answer, read_greeting,
};
use volver::kernel::process::schema;
use volver::kernel::{
    Data, Declaration, DepthWeights, FormKind, KernelError, Quantity, Quantum, Rendering, Samples,
    Sampling, Segments, Source, Subject, Task, UlpBound,
};
use volver::real::FormatName;
use volver::symbolic::code::Language;

static SUBJECT: LazyLock<Subject> = LazyLock::new(|| subject("homogeneous"));

/// A kernel of the first version that computes with so many bits.
fn greeting(bits: u32) -> Greeting {
    let hello = json!({"type": "hello", "protocol": 1, "name": "a", "form": "segments",
        "format": format!("mpfr:{bits}")});
    read_greeting(hello.to_string().as_bytes()).unwrap()
}

/// The results in the answer to a request of id 7 for one task.
fn results(line: &[u8], bits: u32) -> Result<Vec<Result<Rendering, KernelError>>, Trouble> {
    answered(line, &greeting(bits))
}

fn answered(
    line: &[u8],
    greeting: &Greeting,
) -> Result<Vec<Result<Rendering, KernelError>>, Trouble> {
    let task = Task {
        subject: &*SUBJECT,
        step: 1.0,
        segments: 2,
        seed: 0,
        data: Data::Function,
    };
    read_answer(line, 7, &[&task], greeting, false)
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
        quantum: Some(Quantum::Absolute(0.5)),
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
        "every key of the first version is told apart"
    );
    assert!(least.changes(&least).is_empty());
    let second = br#"{"type":"hello","protocol":2,"name":"a","form":"segments","background":true,
        "answers":["expected_depth","opacity"],"expected_depth":"by-opacity"}"#;
    let second = read_greeting(second).unwrap();
    let declaration = Declaration {
        background: true,
        answers: vec![Quantity::Opacity, Quantity::ExpectedDepth],
        expected_depth: DepthWeights::ByOpacity,
        ..Declaration::new("a")
    };
    assert_eq!(second.declaration, declaration);
    assert_eq!(
        second.changes(&least),
        ["protocol", "background", "answers", "expected_depth"]
    );
    let exact = br#"{"type":"hello","protocol":2,"name":"a","form":"segments","output":"f16","quantum":{"relative":"0x1p-8"},
        "exp_ulp":{"a":4,"b":1},"expm1_ulp":1.5,"pow_ulp":{"a":0.5},"subnormals":"lost","noise":1e-6,"channels":3,
        "emission":"positive","source":"length"}"#;
    let exact = read_greeting(exact).unwrap();
    let bound = |a, b| Some(UlpBound::new(a, b).unwrap());
    let declaration = Declaration {
        output: Some(FormatName::F16),
        quantum: Some(Quantum::Relative(1.0 / 256.0)),
        exp_ulp: bound(4.0, 1.0),
        expm1_ulp: bound(1.5, 0.0),
        pow_ulp: bound(0.5, 0.0),
        subnormals_lost: true,
        noise: Some(1e-6),
        channels: NonZeroUsize::new(3),
        positive_emission: true,
        source: Source::Length,
        ..Declaration::new("a")
    };
    assert_eq!(exact.declaration, declaration);
    assert_eq!(
        exact.changes(&least),
        [
            "protocol",
            "output",
            "quantum",
            "exp_ulp",
            "expm1_ulp",
            "pow_ulp",
            "subnormals",
            "noise",
            "channels",
            "emission",
            "source"
        ]
    );
    // What the second version need not say is as in the first.
    let least = br#"{"type":"hello","protocol":2,"name":"a","form":"segments"}"#;
    assert_eq!(
        read_greeting(least).unwrap().declaration,
        Declaration::new("a")
    );
}

/// A greeting of version 2 with these answers.
fn hello(answers: &str) -> Greeting {
    let hello = format!(
        r#"{{"type":"hello","protocol":2,"name":"a","form":"segments","answers":{answers}}}"#
    );
    read_greeting(hello.as_bytes()).unwrap()
}

/// An answer with one result.
fn line(tag: &str, result: &str) -> Vec<u8> {
    format!(r#"{{"type":"{tag}","id":7,"results":[{{{result}}}]}}"#).into_bytes()
}

const ALL: &str = r#"["radiance","opacity","optical_depth","expected_depth"]"#;
const WHOLE: &str =
    r#""radiance":[1],"opacity":"0x1p-1","optical_depth":"0.25","expected_depth":"inf""#;

#[test]
fn a_result_has_what_the_greeting_declares_and_no_more() {
    let all = hello(ALL);
    let read = answered(&line("answer", WHOLE), &all).unwrap().remove(0);
    let read = read.unwrap();
    let value = |quantity| read.of(quantity, 0).unwrap().to_f64();
    assert_eq!(
        Quantity::ALL.map(value),
        [1.0, 0.5, 0.25, f64::INFINITY],
        "{read:?}"
    );
    let projector = hello(r#"["optical_depth"]"#);
    let depth = answered(&line("answer", r#""optical_depth":2"#), &projector);
    let depth = depth.unwrap().remove(0).unwrap();
    assert_eq!(depth.optical_depth.unwrap(), 2.0);
    assert!(depth.radiance.is_empty());
    // No answer to this task; the kernel goes on.
    for (result, greeting, words) in [
        (
            r#""optical_depth":2,"opacity":0.5"#,
            &projector,
            "an undeclared 'opacity' (allowed: what the greeting declares, and all of it)",
        ),
        (
            r#""radiance":[1],"opacity":0.5,"optical_depth":2"#,
            &all,
            "no 'expected_depth' (allowed: what the greeting declares, and all of it)",
        ),
        (
            r#""radiance":[1,2],"opacity":0.5,"optical_depth":2,"expected_depth":1"#,
            &all,
            "2 radiances (allowed: 1, one a channel)",
        ),
        (
            r#""optical_depth":2,"edges":[0,0.5,0.25,1]"#,
            &projector,
            "edges really used: 0.5 at 1, then 0.25 (allowed: 2 to 1048577 that ascend, from 0 to the length of the ray)",
        ),
        (
            r#""optical_depth":2,"edges":[0,1],"step":1"#,
            &projector,
            "edges beside a step or a number of segments (allowed: one of them)",
        ),
    ] {
        let read = answered(&line("answer", result), greeting).unwrap();
        assert_eq!(read[0].as_ref().unwrap_err().to_string(), words);
    }
}

#[test]
fn a_result_that_is_no_message_of_the_protocol_is_garbage() {
    let all = hello(ALL);
    let projector = hello(r#"["optical_depth"]"#);
    let first = greeting(53);
    for (tag, result, greeting, words) in [
        (
            "radiance",
            WHOLE,
            &all,
            "another type of answer (allowed in protocol 2: 'answer')",
        ),
        (
            "answer",
            r#""radiance":[1]"#,
            &first,
            "another type of answer (allowed in protocol 1: 'radiance')",
        ),
        (
            "radiance",
            r#""radiance":[1],"optical_depth":1"#,
            &first,
            "a result with a depth (allowed: in protocol 2)",
        ),
        (
            "radiance",
            r#""radiance":[1],"edges":[0,1]"#,
            &first,
            "a result with edges (allowed: in protocol 2)",
        ),
        (
            "answer",
            r#""opacity":[0.5]"#,
            &all,
            "invalid type: sequence (allowed: a number",
        ),
        (
            "answer",
            r#""opacity":0.5,"error":"no""#,
            &all,
            "a result with an answer and 'error'",
        ),
        (
            "answer",
            "",
            &projector,
            "a result without an answer and 'error'",
        ),
    ] {
        match answered(&line(tag, result), greeting) {
            Err(Trouble::Garbage { problem, .. }) => {
                assert!(problem.starts_with(words), "{problem}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn greetings_of_other_versions_are_refused_with_what_they_lack() {
    for (more, words) in [
        (
            r#""protocol":3,"anything":[]"#,
            "protocol 3 (allowed: 1, 2)",
        ),
        (
            r#""protocol":1,"answers":["opacity"]"#,
            "answers in protocol 1 (allowed: in protocol 2)",
        ),
        (
            r#""protocol":1,"background":false"#,
            "background in protocol 1 (allowed: in protocol 2)",
        ),
        (
            r#""protocol":1,"noise":1e-6"#,
            "noise in protocol 1 (allowed: in protocol 2)",
        ),
        (
            r#""protocol":1,"quantum":{"relative":0.1}"#,
            "quantum of the largest emission in protocol 1 (allowed: in protocol 2)",
        ),
        (
            r#""protocol":2,"quantum":{"relative":0}"#,
            "quantum: relative 0 (allowed: finite, above 0)",
        ),
        (
            r#""protocol":2,"quantum":{"part":0.1}"#,
            "unknown key 'part' (allowed: 'relative')",
        ),
        (
            r#""protocol":2,"quantum":[1]"#,
            "invalid type: sequence (allowed: a number, or text such as \"0.1\", \"0x1.8p-3\", \"nan\", \"inf\")",
        ),
        (
            r#""protocol":2,"exp_ulp":-1"#,
            "exp_ulp: -1 + 0 |x| units in the last place (allowed: both finite, 0 or above)",
        ),
        (
            r#""protocol":2,"pow_ulp":{"a":1,"b":"inf"}"#,
            "pow_ulp: 1 + inf |x| units in the last place (allowed: both finite, 0 or above)",
        ),
        (
            r#""protocol":2,"output":"f12""#,
            "output: unknown format 'f12' (allowed: f16, bf16, f32, f64, f32-lanes, f64-lanes, tf32, fp8-e4m3, fp8-e5m2, ieee:BITS,EMIN,EMAX, \
             fixed:FRACTION, fixed:INTEGER.FRACTION, mpfr:BITS)",
        ),
        (
            r#""protocol":2,"subnormals":"kept""#,
            "unknown variant 'kept' (allowed: 'lost')",
        ),
        (
            r#""protocol":2,"emission":"negative""#,
            "unknown variant 'negative' (allowed: 'positive')",
        ),
        (
            r#""protocol":2,"channels":0"#,
            "channels 0 (allowed: 1 or more)",
        ),
        (
            r#""protocol":2,"source":"ray""#,
            "unknown variant 'ray' (allowed: 'depth' or 'length')",
        ),
        (
            r#""protocol":1,"source":"depth""#,
            "source in protocol 1 (allowed: in protocol 2)",
        ),
        (
            r#""protocol":2,"noise":-1"#,
            "noise -1 (allowed: finite, above 0)",
        ),
        (
            r#""protocol":2,"answers":[]"#,
            "no answers (allowed: one or more)",
        ),
        (
            r#""protocol":2,"answers":["opacity","opacity"]"#,
            "the same answer twice (allowed: each once)",
        ),
        (
            r#""protocol":2,"answers":["alpha"]"#,
            "unknown variant 'alpha' (allowed: 'radiance', 'opacity', 'optical_depth', 'expected_depth')",
        ),
        (
            r#""protocol":2,"expected_depth":"plain""#,
            "expected_depth without need (allowed: where it is among the answers)",
        ),
    ] {
        let hello = format!(r#"{{"type":"hello","name":"a","form":"segments",{more}}}"#);
        match read_greeting(hello.as_bytes()) {
            Err(Trouble::Greeting { problem }) => assert_eq!(problem, words),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_greeting_says_how_many_rays_go_at_once_or_is_refused() {
    let read = |more: &str| {
        let hello = format!(r#"{{"type":"hello","name":"a",{more}}}"#);
        read_greeting(hello.as_bytes())
    };
    for count in [1, 4096, 1_000_000] {
        let greeting = read(&format!(
            r#""protocol":2,"form":"segments","batch":{count}"#
        ))
        .unwrap();
        let batch = greeting.declaration.batch.map(std::num::NonZeroUsize::get);
        assert_eq!(batch, Some(count));
        let none = read(r#""protocol":2,"form":"segments","batch":null"#).unwrap();
        assert_eq!(none.declaration.batch, None);
        assert_eq!(greeting.changes(&none), ["batch"]);
    }
    let second = r#""protocol":2,"form":"segments""#;
    for (more, words) in [
        (
            r#""protocol":1,"form":"segments","batch":8"#.into(),
            "batch in protocol 1 (allowed: in protocol 2)",
        ),
        (
            r#""protocol":2,"form":"volume","batch":8"#.into(),
            "batch of another form (allowed: with the form segments)",
        ),
        (
            format!(r#"{second},"batch":8,"format":"mpfr:54""#),
            "batch of the format mpfr:54, whose numbers have no room in binary64 (allowed: formats of up to 53 bits)",
        ),
        (
            format!(r#"{second},"batch":0"#),
            "batch 0 (allowed: 1 to 1000000)",
        ),
        (
            format!(r#"{second},"batch":1000000000"#),
            "batch 1000000000 (allowed: 1 to 1000000)",
        ),
        (
            format!(r#"{second},"batch":-1"#),
            "invalid value: integer '-1' (allowed: u64)",
        ),
        (
            format!(r#"{second},"batch":"all""#),
            "invalid type: string \"all\" (allowed: u64)",
        ),
    ] {
        match read(&more) {
            Err(Trouble::Greeting { problem }) => assert_eq!(problem, words),
            other => panic!("{other:?}"),
        }
    }
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
        ("protocol", json!(3), "protocol 3 (allowed: 1, 2)"),
        ("protocol", json!("1"), "protocol \"1\" (allowed: 1, 2)"),
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

#[test]
fn a_gradient_has_as_many_numbers_as_there_are_values() {
    let hello = |more: &str| {
        let hello =
            format!(r#"{{"type":"hello","protocol":2,"name":"k","form":"segments",{more}}}"#);
        read_greeting(hello.as_bytes())
    };
    let middles = hello(r#""gradient":"middles""#).unwrap();
    let edges = hello(r#""gradient":"edges""#).unwrap();
    let segments = Segments {
        edges: Samples {
            lambda: vec![0.0, 0.5, 1.0],
            ..Samples::default()
        },
        middles: Samples {
            lambda: vec![0.25, 0.75],
            extinction: vec![1.0, 1.0],
            ..Samples::default()
        },
    };
    let task = Task {
        subject: &*SUBJECT,
        step: 0.5,
        segments: 2,
        seed: 0,
        data: Data::Segments(&segments),
    };
    let said = |greeting: &Greeting, gradient: &str, asked: bool| {
        let line =
            format!(r#"{{"type":"answer","id":7,"results":[{{"radiance":[1]{gradient}}}]}}"#);
        let mut results = read_answer(line.as_bytes(), 7, &[&task], greeting, asked).ok()?;
        Some(results.remove(0).map_err(|error| error.to_string()))
    };
    let of = |tau: &str, emission: &str| {
        format!(r#","gradient":{{"extinction":{tau},"emission":{emission}}}"#)
    };
    let right = said(&middles, &of("[1,2]", "[[3,4]]"), true)
        .unwrap()
        .unwrap();
    assert_eq!(right.gradient.unwrap().emission[0][1], 4);
    // Ends may be as many as the segments, or one more.
    for tau in ["[1,2]", "[1,2,0]"] {
        let padded = said(&edges, &of(tau, "[[3,4,0]]"), true).unwrap().unwrap();
        assert_eq!(padded.gradient.unwrap().extinction.len(), 3);
    }
    for (greeting, gradient, asked, problem) in [
        (
            &middles,
            of("[1]", "[[3,4]]"),
            true,
            "a gradient with 1 numbers of extinction (allowed: 2)",
        ),
        (
            &middles,
            of("[1,2]", "[[3]]"),
            true,
            "a gradient with 1 numbers of emission (allowed: 2)",
        ),
        (
            &middles,
            of("[1,2]", "[]"),
            true,
            "a gradient with 0 numbers of channels of emission (allowed: 1)",
        ),
        (
            &edges,
            of("[1,2,3,4]", "[[3,4]]"),
            true,
            "a gradient with 4 numbers of extinction (allowed: 3)",
        ),
        (
            &middles,
            String::new(),
            true,
            "no 'gradient' (allowed: where the task has cotangents)",
        ),
        (
            &middles,
            of("[1,2]", "[[3,4]]"),
            false,
            "an unasked 'gradient' (allowed: where the task has cotangents)",
        ),
    ] {
        let error = said(greeting, &gradient, asked).unwrap().unwrap_err();
        assert_eq!(error, problem);
    }
    // A gradient of another form, or in the first version, is refused.
    let old = br#"{"type":"hello","protocol":1,"name":"k","form":"segments","gradient":"middles"}"#;
    assert!(read_greeting(old).is_err());
    let volume =
        br#"{"type":"hello","protocol":2,"name":"k","form":"volume","gradient":"middles"}"#;
    assert!(read_greeting(volume).is_err());
}

#[test]
fn an_adjoint_is_that_of_a_projector() {
    for (protocol, more, is_good) in [
        (
            2,
            r#""gradient":"middles","answers":["optical_depth"],"adjoint":"lengths""#,
            true,
        ),
        (2, r#""answers":["optical_depth"],"adjoint":"plain""#, false),
        (2, r#""gradient":"middles","adjoint":"plain""#, false),
        (
            2,
            r#""gradient":"edges","answers":["radiance","optical_depth"],"adjoint":"plain""#,
            false,
        ),
        (1, r#""adjoint":"plain""#, false),
    ] {
        let hello = format!(
            r#"{{"type":"hello","protocol":{protocol},"name":"k","form":"segments",{more}}}"#
        );
        let greeting = read_greeting(hello.as_bytes());
        assert_eq!(greeting.is_ok(), is_good, "{more}");
    }
}

//! Studies written as files.

use serde_json::Value;
use volver::study::sweep::{FileLevels, StudyFile};

const EXAMPLE: &str = "\
cases = [\"sine-squared\", \"@jump\"]
methods = [\"trapezoid/trapezoid\"]
formats = [\"f32\", \"ieee:11,-14,15\"]
levels = \"8..4096\"
sweep-bits = \"4..53\"
errors = \"total\"
";

#[test]
fn every_key_is_read_with_its_line() {
    let file = StudyFile::read(EXAMPLE).unwrap();
    let formats = file.formats.unwrap();
    assert_eq!(formats.get_ref()[1].get_ref(), "ieee:11,-14,15");
    assert_eq!(StudyFile::line(EXAMPLE, &formats.get_ref()[1].span()), 3);
    assert_eq!(file.sweep_bits.unwrap().get_ref(), "4..53");
    assert_eq!(file.errors.unwrap().get_ref(), "total");
    assert!(
        matches!(file.levels.unwrap().get_ref(), FileLevels::Ladder(text) if text == "8..4096")
    );
    let list = StudyFile::read("levels = [8, 16]").unwrap().levels.unwrap();
    assert!(matches!(list.get_ref(), FileLevels::List(list) if list == &[8, 16]));
    assert!(StudyFile::read("").unwrap().cases.is_none());
}

#[test]
fn what_is_wrong_is_named_with_line_and_what_is_allowed() {
    let keys = "'cases', 'methods', 'formats', 'levels', 'sweep-bits', 'errors'";
    for (text, message) in [
        ("\ncase = []", format!("line 2: unknown field 'case' (allowed: {keys})")),
        (
            "formats = 3",
            "line 1: invalid type: integer '3' (allowed: a sequence)".into(),
        ),
        (
            "cases = [\n1]",
            "line 2: invalid type: integer '1' (allowed: a string)".into(),
        ),
        (
            "levels = true",
            "line 1: levels are neither text nor a list of numbers (allowed: \"8..4096\", or [8, 16, 32])".into(),
        ),
        (
            "levels = [-8]",
            "line 1: levels are neither text nor a list of numbers (allowed: \"8..4096\", or [8, 16, 32])".into(),
        ),
        ("a.b.c.d.e.f.g.h.i = 1", "line 1: too many parts of a key (allowed: up to 8)".into()),
    ] {
        assert_eq!(StudyFile::read(text).unwrap_err().to_string(), message, "{text}");
    }
    for text in [
        "cases = [\"a\"\nlevels",
        "levels = \"8\"\nlevels = \"9\"",
        "cases = \"\u{1}\"",
        "[[[",
    ] {
        let said = StudyFile::read(text).unwrap_err().to_string();
        assert!(
            said.starts_with("line ") && said.lines().count() == 1,
            "{said}"
        );
        assert!(said.contains("(allowed: "), "{said}");
    }
    let long = "#".repeat(2 << 20);
    assert!(
        StudyFile::read(&long)
            .unwrap_err()
            .to_string()
            .contains("2097152 bytes are too long")
    );
}

#[test]
fn the_schema_has_the_keys_that_are_accepted_and_takes_the_example() {
    let schema = StudyFile::schema();
    let properties = schema["properties"].as_object().unwrap();
    let mut keys: Vec<&str> = properties.keys().map(String::as_str).collect();
    keys.sort_unstable();
    // What the reader says it accepts.
    let said = StudyFile::read("other = 1").unwrap_err().to_string();
    let (_, allowed) = said.split_once("(allowed: ").unwrap();
    let mut accepted: Vec<&str> = allowed.split('\'').skip(1).step_by(2).collect();
    accepted.sort_unstable();
    assert_eq!(keys, accepted);
    assert_eq!(schema["additionalProperties"], false);
    assert!(schema["required"].is_null(), "{schema}");
    for (name, property) in properties {
        assert!(property["description"].is_string(), "{name}");
        assert!(property.get("default").is_none(), "{name}");
    }
    assert_eq!(properties["cases"]["type"], "array");
    assert_eq!(properties["cases"]["items"]["type"], "string");
    assert_eq!(properties["cases"]["minItems"], 1);
    assert_eq!(properties["sweep-bits"]["type"], "string");
    let levels = &schema["$defs"]["FileLevels"]["anyOf"];
    let types: Vec<&Value> = (0..2).map(|i| &levels[i]["type"]).collect();
    assert_eq!(types, ["string", "array"]);
}

//! Texts that are no TOML, and TOML that is no case.

use super::{assert_refused, instead, refused, slab};
use volver::case::file::MAX_FILE;
use volver::case::{Description, FileProblem};

#[test]
fn bad_toml() {
    let again = |key: &str| format!("key '{key}' a second time (allowed: each key once)");
    assert_refused(&[
        ("name = \"a\"\nname = \"b\"", 2, 1, &again("name")),
        ("[parameters]\nw = 1\n w = 2", 3, 2, &again("w")),
        ("[parameters]\n[parameters]\n", 2, 2, &again("parameters")),
        ("name = \"ä\" x", 1, 12, ""),
        ("name = \"a\nlength = 1", 1, 10, ""),
        ("\n= 1", 2, 1, ""),
        ("length = 1.\n", 1, 12, ""),
        ("\u{feff}name = 'a' 'b'\n", 1, 12, ""),
    ]);
}

#[test]
fn deep_nesting() {
    let many = 100_000;
    for text in [
        format!("name = {}", "[".repeat(many)),
        format!("name = {}{}", "[".repeat(many), "]".repeat(many)),
        format!("name = {}1{}", "{a=".repeat(many), "}".repeat(many)),
        format!("[{}]", "[".repeat(many)),
    ] {
        assert_eq!(refused(&text).line, 1);
    }
    let parts = "a.".repeat(many);
    for text in [
        format!("{parts}a = 1"),
        format!("[{parts}a]"),
        format!("[[{parts}a]]"),
        format!("x = {{ {parts}a = 1 }}"),
    ] {
        let error = refused(&text);
        assert_eq!(error.problem, FileProblem::TooDeep);
        assert_eq!(error.column, text.find('a').unwrap() + 16);
    }
    let parts = "\"a\" . ".repeat(many);
    assert_eq!(
        refused(&format!("{parts}a = 1")).problem,
        FileProblem::TooDeep
    );
}

#[test]
fn too_long_a_file() {
    let start = slab("# ");
    let fits = start.clone() + &".".repeat(MAX_FILE - start.len());
    assert!(Description::read(&fits).is_ok());
    let error = refused(&(fits + "."));
    assert_eq!(
        error.problem,
        FileProblem::TooLong {
            bytes: MAX_FILE + 1
        }
    );
    assert_eq!((error.line, error.column, error.caret()), (1, 1, None));
}

#[test]
fn keys_that_mean_nothing() {
    assert_refused(&[
        (
            &slab("colour = 1"),
            5,
            1,
            "unknown key 'colour' (allowed: name, title, tags, derivation, length, field, inverse, depth, \
             extinction, radiance, emission, emission_of_depth, background, parameters, channels)",
        ),
        (
            &slab("  \"a\\nb\" = 1"),
            5,
            3,
            "unknown key 'a b' (allowed: name, ",
        ),
        (
            &instead("depth = '0'\n[channels.red]\nradiance = '0'\ndepth = '0'"),
            6,
            1,
            "unknown key 'channels.red.depth' (allowed: radiance, emission, emission_of_depth, background)",
        ),
    ]);
}

#[test]
fn wrong_types() {
    assert_refused(&[
        (
            &slab("title = 1"),
            5,
            9,
            "'title' is an integer (allowed: a text in quotes)",
        ),
        (
            &slab("derivation = true"),
            5,
            14,
            "'derivation' is true or false (allowed: a text",
        ),
        (
            &slab("tags = 'a'"),
            5,
            8,
            "'tags' is a text (allowed: an array of names in quotes)",
        ),
        (
            &slab("tags = ['a', 1979-05-27]"),
            5,
            14,
            "'tags' is a date or time (allowed: a text",
        ),
        (
            &slab("field = 1.5\ninverse = 's'"),
            5,
            9,
            "'field' is a float (allowed: a text in quotes)",
        ),
        (
            &slab("parameters = 1"),
            5,
            14,
            "'parameters' is an integer (allowed: a table)",
        ),
        (
            &slab("[[parameters]]"),
            5,
            1,
            "'parameters' is an array (allowed: a table)",
        ),
        (
            &slab("[[channels]]"),
            5,
            1,
            "'channels' is an array (allowed: a table)",
        ),
        (
            &instead("channels.red = '0'"),
            3,
            16,
            "'channels.red' is a text (allowed: a table)",
        ),
        (
            &slab("[parameters.w]"),
            5,
            1,
            "'parameters.w' is a table (allowed: an integer, or a number",
        ),
    ]);
}

#[test]
fn names_titles_tags() {
    let long = "a".repeat(65);
    assert_refused(&[
        (
            &slab("").replace("\"slab\"", "'Slab'"),
            1,
            8,
            "'Slab' is no name (allowed: a to z, 0 to 9 and -",
        ),
        (&slab("").replace("slab", ""), 1, 8, "'' is no name"),
        (
            &slab("").replace("slab", "2-slab"),
            1,
            8,
            "'2-slab' is no name",
        ),
        (
            &slab("").replace("slab", &long),
            1,
            8,
            &format!("'{}…' is no name", &long[..64]),
        ),
        (&slab("tags = ['a', 'b c']"), 5, 14, "'b c' is no name"),
        (
            &slab("title = 'a\tb'"),
            5,
            9,
            "no title (allowed: one line of up to 200 characters)",
        ),
        (&slab("title = \"a\\nb\""), 5, 9, "no title"),
        (
            &slab(&format!("title = '{}'", "ä".repeat(201))),
            5,
            9,
            "no title",
        ),
    ]);
    assert!(Description::read(&slab(&format!("title = '{}'", "ä".repeat(200)))).is_ok());
    assert!(Description::read(&slab("").replace("slab", &long[1..])).is_ok());
}

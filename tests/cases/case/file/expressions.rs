//! Numbers and expressions that are refused.

use super::{assert_refused, instead, refused, slab};
use volver::case::Description;

#[test]
fn numbers() {
    let length = |value: &str| slab("").replace("length = 2", &format!("length = {value}"));
    let parameter = |line: &str| slab(&format!("[parameters]\n{line}"));
    let float = |key: &str, text: &str| {
        format!(
            "'{key}' is a float, which is not exact (allowed: an integer, or in quotes: \"{text}\")"
        )
    };
    assert_refused(&[
        (&length("0.1"), 2, 10, &float("length", "0.1")),
        (&length("-inf"), 2, 10, &float("length", "-inf")),
        (&length("0"), 2, 10, "a length of '0' (allowed: above 0)"),
        (
            &slab("background = '-1/2'"),
            5,
            14,
            "a background of '-1/2' (allowed: 0 to 1e12)",
        ),
        (
            &slab("background = '1e13'"),
            5,
            14,
            "a background of '10000000000000' (allowed: 0 to 1e12)",
        ),
        (
            &slab("background = 0.5"),
            5,
            14,
            &float("background", "0.5"),
        ),
        (
            &length("'-1/3'"),
            2,
            10,
            "a length of '-1/3' (allowed: above 0)",
        ),
        (
            &length("'1 + x'"),
            2,
            11,
            "'length': not a number (allowed: an integer, a decimal or a quotient",
        ),
        (&length("'pi'"), 2, 11, "'length': not a number"),
        (&length("'1/0'"), 2, 12, "'length': division by zero"),
        (
            &length("9223372036854775808"),
            2,
            10,
            "'length' is too large an integer",
        ),
        (
            &length("'1e999*10000'"),
            2,
            10,
            "'length' has too many digits",
        ),
        (
            &length("'1/1e999/10000'"),
            2,
            10,
            "'length' has too many digits",
        ),
        (&parameter("w = 2.5"), 6, 5, &float("parameters.w", "2.5")),
        (
            &parameter("w = [1]"),
            6,
            5,
            "'parameters.w' is an array (allowed: an integer, or a number in quotes)",
        ),
        (
            &parameter("w = '2,5'"),
            6,
            7,
            "'parameters.w': expected an operator or the end, found ','",
        ),
        (
            &parameter("w = '1 + v'\nv = 1"),
            6,
            6,
            "'parameters.w': not a number",
        ),
    ]);
    assert!(Description::read(&length("'1e1000'")).is_ok());
    assert!(Description::read(&length("9223372036854775807")).is_ok());
}

#[test]
fn names_of_parameters() {
    for name in [
        "lambda",
        "s",
        "t",
        "pi",
        "erf",
        "sqrt",
        "piecewise",
        "2",
        "a-b",
    ] {
        let text = slab(&format!("[parameters]\nx_1 = 1\n {name} = 2"));
        let message = format!("'{name}' cannot name a parameter (allowed: letters, digits and _");
        assert_refused(&[(&text, 7, 2, &message)]);
    }
    let many = (0..8)
        .map(|i| format!("\nw_{i} = 1"))
        .collect::<Vec<_>>()
        .concat();
    let text = slab("").replace("\"0\"", "'x'") + "[parameters]" + &many;
    let message =
        "symbol 'x' in 'radiance' (allowed: lambda, w_0, w_1, w_2, w_3, w_4, w_5, w_6, …)";
    assert_refused(&[(&text, 4, 13, message)]);
    let (fits, long) = ("w".repeat(64), "w".repeat(65));
    assert!(Description::read(&slab(&format!("[parameters]\n{fits} = 1"))).is_ok());
    assert_refused(&[(&slab(&format!("[parameters]\n{long} = 1")), 6, 1, "'w")]);
    for name in ["ä", " w", "w ", "", "(w)", "w\\t"] {
        let text = slab(&format!("[parameters]\n\"{name}\" = 2"));
        assert_refused(&[(&text, 6, 1, "'")]);
    }
}

#[test]
fn expressions() {
    let depth = |text: &str| {
        instead(&format!(
            "radiance = '0'\ndepth = {text}\nfield = 'lambda'\ninverse = 's'"
        ))
    };
    let no_operand = "'depth': expected a number, a name or '(', found the end";
    assert_refused(&[
        (&depth("'1 +'"), 4, 13, no_operand),
        (&depth("\"1 +\""), 4, 13, no_operand),
        (&depth("\"1\\u0020+\""), 4, 9, no_operand),
        (&depth("'''1 +'''"), 4, 9, no_operand),
        (&depth("''"), 4, 10, no_operand),
        (
            &depth("'1 ä'"),
            4,
            12,
            "'depth': unexpected character '\\u{e4}'",
        ),
        (
            &depth("' (1 + 2'"),
            4,
            17,
            "'depth': the '(' of column 11 is not closed",
        ),
        (
            &depth("'1'").replace("'s'", "'1 +'"),
            6,
            15,
            "'inverse': expected",
        ),
        (&depth("'1/0'"), 4, 11, "'depth': division by zero"),
        (
            &(depth("'1/(w - 1)'") + "\n[parameters]\nw = 1"),
            4,
            10,
            "'depth': division by zero",
        ),
        (
            &(depth("'(w - 1)^0'") + "\n[parameters]\nw = 1"),
            4,
            10,
            "'depth': 0^0 has no value",
        ),
    ]);
}

#[test]
fn symbols() {
    let depth = |text: &str| instead(&format!("radiance = '0'\ndepth = {text}"));
    let x = "symbol 'x' in 'depth' (allowed: lambda)";
    assert_refused(&[
        (&depth("'sin(2*x)'"), 4, 16, x),
        (
            &depth("'exp(xx*0 + 1e1*x)'"),
            4,
            14,
            "symbol 'xx' in 'depth' (allowed: lambda)",
        ),
        (&depth("'exp(lambda + 1e1*x + xx)'"), 4, 27, x),
        (&depth("\"\"\"x\"\"\""), 4, 9, x),
        (
            &depth("'s'"),
            4,
            10,
            "symbol 's' in 'depth' (allowed: lambda)",
        ),
        (
            &(depth("'w*y'") + "\n[parameters]\nw = 1\nv = 2"),
            4,
            12,
            "symbol 'y' in 'depth' (allowed: lambda, v, w)",
        ),
        (
            &slab("field = 't'\ninverse = 's'"),
            5,
            10,
            "symbol 't' in 'field' (allowed: lambda)",
        ),
        (
            &slab("field = '1'\ninverse = 'lambda'"),
            6,
            12,
            "symbol 'lambda' in 'inverse' (allowed: s)",
        ),
        (
            &slab("extinction = 's'\nemission = 'lambda'"),
            6,
            13,
            "symbol 'lambda' in 'emission' (allowed: s)",
        ),
        (
            &slab("extinction = 't'\nemission = 's'"),
            5,
            15,
            "symbol 't' in 'extinction' (allowed: s)",
        ),
        (
            &slab("emission_of_depth = '2*lambda'"),
            5,
            24,
            "symbol 'lambda' in 'emission_of_depth' (allowed: t)",
        ),
        (
            &slab("").replace("\"0\"", "'s'"),
            4,
            13,
            "symbol 's' in 'radiance' (allowed: lambda)",
        ),
        (
            &instead("depth = '0'\n[channels.red]\nradiance = 'x'"),
            5,
            13,
            "symbol 'x' in 'channels.red.radiance' (allowed: lambda)",
        ),
    ]);
}

#[test]
fn a_caret_stands_under_the_place() {
    let text = instead(&format!(
        "depth = '{}x'\nradiance = '0'",
        "lambda + ".repeat(20)
    ));
    let error = refused(&text);
    assert_eq!((error.line, error.column), (3, 190));
    let caret = error.caret().unwrap();
    let (line, caret) = caret.split_once('\n').unwrap();
    assert_eq!(
        (line.find('x'), line.len(), caret.len()),
        (Some(32), 34, 33)
    );
}

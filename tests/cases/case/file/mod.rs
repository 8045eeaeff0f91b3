//! Case files: what they say, and what is refused where.

mod expressions;
mod structure;
mod together;

use rug::Rational;
use volver::case::{Description, FileError, Recipe};
use volver::symbolic::Expr;

fn parse(text: &str) -> Expr {
    text.parse().unwrap()
}

/// A good file, with `more` after it.
fn slab(more: &str) -> String {
    instead(&format!("depth = \"lambda\"\nradiance = \"0\"\n{more}"))
}

/// Lines in the place of depth and radiance, the third and fourth.
fn instead(lines: &str) -> String {
    format!("name = \"slab\"\nlength = 2\n{lines}")
}

fn refused(text: &str) -> FileError {
    let error = Description::read(text).expect_err(text);
    let message = error.to_string();
    assert!(!message.contains(char::is_control), "{message}");
    let says = ["(allowed: ", ": expected "].map(|word| message.contains(word));
    assert!(says[0] || says[1], "{message}");
    if let Some(caret) = error.caret() {
        let last = caret.lines().last().unwrap();
        assert!(
            caret.lines().count() == 2 && last.trim_start() == "^",
            "{caret}"
        );
    }
    error
}

/// Each text with the line and the column of what is wrong with it, and the start of the message.
fn assert_refused(cases: &[(&str, usize, usize, &str)]) {
    let wrong: Vec<String> = cases
        .iter()
        .filter_map(|(text, line, column, message)| {
            let error = refused(text);
            let right = (error.line, error.column) == (*line, *column)
                && error.problem.to_string().starts_with(message);
            (!right).then(|| format!("{text}\n=> {error}\n"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.concat());
}

#[test]
fn the_catalogue_is_read() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/case/catalogue");
    let mut recipes = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let text = std::fs::read_to_string(&path).unwrap();
            let case = Description::read(&text).unwrap_or_else(|e| panic!("{path:?}: {e}"));
            assert_eq!(path.file_stem().unwrap(), &*case.name);
            assert!(!case.title.is_empty() && !case.tags.is_empty() && !case.derivation.is_empty());
            recipes.push(case.recipe());
        }
    }
    let count = |recipe| recipes.iter().filter(|r| **r == recipe).count();
    assert_eq!(
        [
            Recipe::DepthAndRadiance,
            Recipe::EmissionOfDepth,
            Recipe::Claimed
        ]
        .map(count),
        [5, 34, 23]
    );
}

#[test]
fn a_file_says_what_it_says() {
    let text = "\u{feff}name = 'a-1'\r
title = \"T\\u00e4\"
tags = ['x', \"y-2\"]
length = '1/3'
field = \"w*lambda\"
inverse = 's/w'
depth = '''
  w*lambda^2'''
parameters.w = 0x10
[channels.b]
emission_of_depth = 't'
[channels.a]
emission_of_depth = '1 + k_1'
radiance = '0'
[parameters]
k_1 = '-2.5e-1'
";
    // A table may not be opened in two ways.
    assert!(Description::read(text).is_err());
    let text = text.replace("parameters.w = 0x10\n", "") + "w = 0x10\n";
    let case: Description = text.parse().unwrap();
    let [b, a] = &case.channels[..] else { panic!() };
    assert_eq!((&*case.name, &*case.title), ("a-1", "Tä"));
    assert_eq!(case.tags, ["x", "y-2"]);
    assert_eq!(case.derivation, "");
    assert_eq!(case.length, Rational::from((1, 3)));
    assert_eq!(case.field, parse("16*lambda"));
    assert_eq!(case.inverse, Some(parse("s/16")));
    assert_eq!(case.depth, Some(parse("16*lambda^2")));
    assert_eq!(case.extinction, None);
    assert_eq!(case.recipe(), Recipe::EmissionOfDepth);
    assert_eq!(
        (a.name.as_deref(), b.name.as_deref()),
        (Some("a"), Some("b"))
    );
    assert_eq!(a.emission_of_depth, Some(parse("1 + (-1/4)")));
    assert_eq!((&a.radiance, &b.radiance), (&Some(parse("0")), &None));
}

#[test]
fn what_is_not_given_is_empty_or_lambda() {
    let case = Description::read(&slab("")).unwrap();
    assert_eq!(case.title, "");
    assert_eq!((case.tags.len(), case.channels.len()), (0, 1));
    assert_eq!(case.field, Expr::symbol("lambda"));
    assert_eq!(case.channels[0].name, None);
    assert_eq!(case.recipe(), Recipe::DepthAndRadiance);
}

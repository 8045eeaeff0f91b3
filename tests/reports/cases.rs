//! Cases, fits, references and proofs as documents.

use super::about;
use super::markdown::is_regular;
use rug::Float;
use volver::case::Description;
use volver::case::manufacture::manufacture;
use volver::document::{Block, Document, Table};
use volver::method::Method;
use volver::render::html::{read, render};
use volver::render::{markdown, terminal};
use volver::report::cases::{Derived, decimal, document, list};
use volver::report::proofs::{self, Fate, Proof};

fn derived(text: &str) -> Derived {
    let description = Description::read(text).unwrap();
    let cases = manufacture(&description).unwrap();
    Derived { description, cases }
}

fn of_radiance(length: &str, radiance: &str) -> Document {
    let text =
        format!("name = 'a'\nlength = '{length}'\ndepth = 'lambda'\nradiance = '{radiance}'");
    document(&derived(&text), true, &about())
}

fn fact(document: &Document, name: &str) -> String {
    let facts = document.blocks().filter_map(|block| match block {
        Block::Facts(facts) => Some(facts),
        _ => None,
    });
    let mut facts = facts.flatten();
    facts.find(|fact| fact.name == name).unwrap().value.clone()
}

fn tables(document: &Document) -> Vec<&Table> {
    fn table(block: &Block) -> Option<&Table> {
        match block {
            Block::Table(table) => Some(table),
            _ => None,
        }
    }
    document.blocks().filter_map(table).collect()
}

#[test]
fn decimals_have_six_digits() {
    for (text, written) in [
        ("0.130613993", "0.130614"),
        ("-0.000123456789", "-0.000123457"),
        ("0.0000123456789", "1.23457e-5"),
        ("50", "50.0000"),
        ("123456", "123456"),
        ("1234567", "1.23457e6"),
        ("-1e400", "-1.00000e400"),
        ("0", "0"),
        ("nan", "NaN"),
        ("-inf", "-inf"),
    ] {
        let x = Float::with_val(128, Float::parse(text).unwrap());
        assert_eq!(decimal(&x), written);
    }
}

#[test]
fn values_are_right_however_much_cancels() {
    let tiny = of_radiance("1e-400", "1 - (1 + lambda)*exp(-lambda)");
    assert_eq!(fact(&tiny, "I(D)"), "5.00000e-801");
    // Nothing encloses a 0 that is not certain: it is evaluated as it stands.
    let zero = of_radiance("1", "sin(lambda)^2 + cos(lambda)^2 - 1");
    let value: f64 = fact(&zero, "I(D)").parse().unwrap();
    assert!(value.abs() < 1e-37, "{value}");
}

#[test]
fn long_fractions_are_shortened() {
    assert_eq!(fact(&of_radiance("1/3", "lambda"), "D"), "1/3");
    let long = "1000000014000000050/1000000014000000049";
    assert_eq!(fact(&of_radiance(long, "lambda"), "D"), "about 1.00000");
}

#[test]
fn all_methods_have_their_order_and_one_theorem_or_none() {
    let document = of_radiance("1", "lambda");
    let orders = tables(&document)[1];
    assert_eq!(orders.rows.len(), 7);
    for row in &orders.rows {
        let [method, order, theorem] = &row[..] else {
            panic!("three cells a method: {row:?}");
        };
        assert!(method.text.parse::<Method>().is_ok(), "{}", method.text);
        assert!(!order.text.is_empty() && !theorem.text.is_empty());
    }
}

#[test]
fn rare_tags_come_first_and_what_is_open_is_said() {
    let case = |name: &str, tags: &str, extinction: &str| {
        derived(&format!(
            "name = '{name}'\ntags = [{tags}]\nlength = 1\nextinction = '{extinction}'\nemission = '1'"
        ))
    };
    let cases = [
        case("a", "'smooth', 'thin', 'paper'", "1"),
        case("b", "'smooth'", "2"),
    ];
    let list = list(&cases, &[], &about());
    let [first, second] = &tables(&list)[0].rows[..] else {
        panic!("a row a channel");
    };
    assert_eq!(first[5].text, "thin, paper, smooth");
    assert_eq!(second[4].text, "by reference");
    assert_eq!(fact(&list, "tags"), "paper, smooth, thin");
    let conclusion = list.conclusion.unwrap().words;
    assert_eq!(
        conclusion,
        "2 cases, 2 channels; every statement is proved for 2"
    );
}

#[test]
fn documents_of_cases_and_proofs_have_every_form() {
    let proofs = [
        Proof::new("a", Fate::Proved),
        Proof::new("b", Fate::Failed("first\n\nsecond".into())),
    ];
    let cases = [derived(
        "name = 'a'\nlength = 1\ndepth = 'lambda'\nradiance = '-lambda'",
    )];
    for document in [
        document(&cases[0], true, &about()),
        list(&cases, &[], &about()),
        proofs::document(&proofs, &about()),
    ] {
        let markdown = markdown(&document);
        is_regular(&markdown);
        assert_eq!(read(&render(&document).unwrap()).unwrap(), document);
        let text = terminal(&document, 80, false);
        assert!(
            !text.contains("\n\n\n") && !text.ends_with("\n\n"),
            "{text}"
        );
    }
    let text = terminal(&proofs::document(&proofs, &about()), 80, false);
    assert!(
        text.contains("  b                         failed\n    first\n    second\n"),
        "{text}"
    );
    assert!(text.ends_with("\n2 cases: 1 proved, 1 failed, 0 not checked, 0 not stated\n"));
}

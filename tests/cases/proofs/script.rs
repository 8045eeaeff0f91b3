//! Cases as theorems, and what no theorem says.

use volver::case::manufacture::manufacture;
use volver::case::{Description, catalogue};
use volver::proof::{MARK, NotStated, Script, script};

fn script_of(text: &str) -> Result<Script, NotStated> {
    let description = Description::read(text).unwrap();
    script(&description, &manufacture(&description).unwrap())
}

#[test]
fn a_case_is_stated_on_its_own_functions() {
    let script = script_of(
        r#"
        name = "two-thirds"
        length = "2/3"
        extinction = "2*s"
        emission = "1"
        depth = "lambda^2"
        radiance = "1 - exp(-lambda^2)"
        "#,
    );
    let Script {
        name,
        theorems,
        text,
    } = script.unwrap();
    assert_eq!(
        (name.as_str(), &theorems[..]),
        ("two_thirds", &["two_thirds".to_string()][..])
    );
    for part in [
        "Definition field (lambda : R) : R :=\n  lambda.\n",
        "Definition extinction (s : R) : R :=\n  2 * s.\n",
        "Definition emission (s : R) : R :=\n  1.\n",
        "Definition exact_depth (lambda : R) : R :=\n  lambda ^ 2.\n",
        "Definition exact_radiance (lambda : R) : R :=\n  1 - exp (- lambda ^ 2).\n",
        "Theorem two_thirds (D : R) :\n  0 <= D <= 2 / 3 ->\n",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn channels_stand_apart() {
    let description = catalogue::find("rgb-emission").unwrap().unwrap();
    let script = script(&description, &manufacture(&description).unwrap()).unwrap();
    let theorems = ["red", "green", "blue"].map(|c| format!("{c}.rgb_emission_{c}"));
    assert_eq!(script.theorems, theorems);
    for channel in ["red", "green", "blue"] {
        assert!(script.text.contains(&format!("\nModule {channel}.\n")));
        assert!(script.text.contains(&format!("\nEnd {channel}.\n")));
    }
}

#[test]
fn names_and_titles_stay_what_they_are_to_coq() {
    let script = script_of(
        r#"
        name = "for"
        title = "An \"end\" *) Qed. (* of comments"
        length = "1"
        depth = "lambda"
        emission_of_depth = "1"
        "#,
    );
    let script = script.unwrap();
    assert_eq!(script.name, "case_for");
    let comment = script.text.split("*)").next().unwrap();
    assert!(comment.contains(MARK), "{comment}");
    assert!(!comment.contains('"'));
}

#[test]
fn what_cannot_be_stated_is_named() {
    let branches = r#"
        name = "a"
        length = "1"
        depth = "piecewise(lambda < 1/2, lambda, 2*lambda - 1/2)"
        emission_of_depth = "1"
        "#;
    let error = script_of(branches).unwrap_err().to_string();
    assert!(error.contains("of a: 'piecewise("), "{error}");
    assert!(
        error.contains("(allowed: one formula for all of the ray)"),
        "{error}"
    );

    let medium = r#"
        name = "b"
        length = "1"
        extinction = "1 + s"
        emission = "s"
        "#;
    assert_eq!(
        script_of(medium),
        Err(NotStated::NoClosedForm { case: "b".into() })
    );
}

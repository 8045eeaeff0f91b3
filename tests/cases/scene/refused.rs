//! What is no scene, and why.

use super::{media, medium};
use volver::scene::SceneProblem;

#[test]
fn media_leave_no_gap_and_do_not_overlap() {
    let two = |from: &str, to: &str| {
        media(&format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = 'vacuum'\n[[media]]\nfrom = {from}\nto = {to}\nkind = 'vacuum'"
        ))
    };
    assert!(two("1", "2").is_ok());
    assert_eq!(
        two("1.5", "2").unwrap_err(),
        SceneProblem::Gap {
            end: 1.0,
            from: 1.5
        }
    );
    assert_eq!(
        two("0.5", "2").unwrap_err(),
        SceneProblem::Overlap {
            end: 1.0,
            from: 0.5
        }
    );
    assert_eq!(
        two("1", "1").unwrap_err(),
        SceneProblem::Order { from: 1.0, to: 1.0 }
    );
    assert_eq!(media("name = 'none'").unwrap_err(), SceneProblem::Empty);
}

#[test]
fn negative_and_undefined_values_are_refused_where_they_are() {
    let expression = |tau: &str, c: &str| {
        medium(&format!(
            "kind = 'expression'\nextinction = '{tau}'\nemission = '{c}'"
        ))
        .unwrap_err()
    };
    let SceneProblem::Value { what, at, value } = expression("1 - lambda", "1") else {
        panic!("not refused as negative");
    };
    assert_eq!(what, "extinction");
    assert!(at > 1.0 && at <= 2.0 && value.unwrap() < 0.0);
    assert!(matches!(
        expression("1", "ln(lambda - 1)"),
        SceneProblem::Value {
            what: "emission",
            ..
        }
    ));
    assert!(matches!(
        expression("1/(lambda - 1)", "1"),
        SceneProblem::Value {
            what: "extinction",
            ..
        }
    ));
    for (body, value) in [
        ("kind = 'constant'\nextinction = -1", -1.0),
        (
            "kind = 'linear'\nextinction = {front = 1, back = -0.5}",
            -0.5,
        ),
    ] {
        let SceneProblem::Value { value: found, .. } = medium(body).unwrap_err() else {
            panic!("{body}");
        };
        assert_eq!(found, Some(value));
    }
    for number in ["nan", "inf", "-inf"] {
        let error = medium(&format!("kind = 'constant'\nextinction = {number}")).unwrap_err();
        assert!(matches!(error, SceneProblem::Number { .. }), "{error}");
    }
}

#[test]
fn what_the_model_lacks_is_refused_with_the_reason() {
    let top = |features: &str| {
        media(&format!(
            "features = {features}\n[[media]]\nfrom = 0\nto = 1\nkind = 'constant'\nextinction = 1\nemission = 1"
        ))
    };
    assert!(top("['emission', 'absorption']").is_ok());
    let SceneProblem::Feature { feature, reason } =
        top("['emission', 'absorption', 'scattering']").unwrap_err()
    else {
        panic!("scattering was not refused");
    };
    assert_eq!(feature, "scattering");
    assert!(reason.contains("changes its direction"));
    assert_eq!(top("['absorption']").unwrap_err(), SceneProblem::Undeclared);
    assert!(matches!(
        top("['emission']").unwrap_err(),
        SceneProblem::Feature { .. }
    ));
    for key in ["scattering = 0.5", "albedo = 1", "phase = 'isotropic'"] {
        let error = medium(&format!("kind = 'constant'\nextinction = 1\n{key}")).unwrap_err();
        assert!(
            matches!(error, SceneProblem::Feature { .. }),
            "{key}: {error}"
        );
    }
}

#[test]
fn keys_belong_to_their_kinds() {
    for (body, what) in [
        (
            "kind = 'vacuum'\nextinction = 1",
            "'extinction' in a medium of kind 'vacuum'",
        ),
        ("kind = 'constant'", "without 'extinction'"),
        (
            "kind = 'constant'\nextinction = 1\nfield = 'lambda'",
            "'field' in a medium",
        ),
        ("kind = 'sampled'\nextinction = 's'", "without 'samples'"),
        ("kind = 'sampled'\nsamples = [1, 2]", "without 'table'"),
        (
            "kind = 'sampled'\nsamples = [1, 2]\nextinction = 's'\ntable = 'x'",
            "'extinction' in a medium of kind 'sampled'",
        ),
        (
            "kind = 'sampled'\nsamples = [1]\nextinction = 's'",
            "1 samples",
        ),
        (
            "kind = 'sampled'\nsamples = [1, 2, 3]\nspacing = 0.5\nextinction = 's'",
            "3 samples at a spacing of 0.5 are 1 long",
        ),
        (
            "kind = 'expression'\nextinction = 's'",
            "'s' has no value (allowed: lambda)",
        ),
        ("kind = 'expression'\nextinction = '1 +'", "'1 +': "),
        ("kind = 'fog'\nextinction = 1", "allowed: "),
        (
            "kind = 'constant'\nextinction = [1, 2]",
            "2 values for 1 channels",
        ),
    ] {
        let error = medium(body).unwrap_err().to_string();
        assert!(error.contains(what), "{error}\n{what}");
        assert!(error.contains("(allowed: "), "{error}");
    }
}

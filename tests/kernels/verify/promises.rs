//! Kernels that declare an order or nothing, and --expect.

use super::run::fixture;

#[test]
fn nothing_promised_is_nothing_confirmed_until_it_is_expected() {
    let bare = ["--declare", "{}"];
    let run = fixture(&[], &bare).with_code(1);
    run.shows("(nothing was promised: --expect ORDER, or let the kernel declare a method)");
    run.shows("αⱼ = 1 − exp(−τⱼ dⱼ) samples in the middle of segments");
    for right in ["2", "4/2", "2.0"] {
        let run = fixture(&["--expect", right], &bare).with_code(0);
        run.hides("nothing was promised");
    }
    for wrong in ["3", "5/2"] {
        let run = fixture(&["--expect", wrong], &bare).with_code(1);
        assert!(run.row("cloud").ends_with("TooLow"), "{}", run.out);
        run.hides("nothing was promised");
    }
}

#[test]
fn an_order_that_is_declared_is_tested() {
    fixture(&[], &["--declare", r#"{"order":2}"#]).with_code(0);
    let run = fixture(&[], &["--declare", r#"{"order":3}"#]).with_code(1);
    run.shows("not confirmed: 0 confirmed, 3 contradicted");
}

#[test]
fn orders_of_many_digits_stay_in_their_column() {
    let run = fixture(&["--expect", "4/3"], &[]);
    assert!(run.row("thick").contains(" 1.333 "), "{}", run.out);
    let run = fixture(&[], &["--declare", r#"{"order":1e300}"#]).with_code(1);
    assert!(run.row("thick").contains(" 1e300 "), "{}", run.out);
}

/// What cannot all be is no promise: nothing is measured, and nothing written.
#[test]
fn promises_that_contradict_each_other_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let saved = folder.path().join("base.json");
    let options = [
        "--out",
        out.to_str().unwrap(),
        "--save",
        saved.to_str().unwrap(),
    ];
    for (declared, message) in [
        (
            r#"{"method":"front-to-back/front/subtraction","order":2}"#,
            "it declares order 2 and method 'front-to-back/front/subtraction', which has order 1 (allowed: 1, or one of the two)",
        ),
        (
            r#"{"method":"simpson/simpson","order":2}"#,
            "it declares order 2 and method 'simpson/simpson', which has order 4 (allowed: 4, or one of the two)",
        ),
        (
            r#"{"method":"front-to-back/middle/expm1","sampling":"back"}"#,
            "it declares sampling 'back' and method 'front-to-back/middle/expm1', which samples 'middle' (allowed: 'middle', or one of the two)",
        ),
    ] {
        let run = fixture(&options, &["--declare", declared]).with_code(2);
        assert!(run.err.contains(message), "{}", run.err);
        assert_eq!(run.out, "");
        assert!(!out.exists() && !saved.exists());
    }
    for fits in [
        r#"{"method":"front-to-back/middle/subtraction","order":2}"#,
        r#"{"method":"front-to-back/middle/subtraction","sampling":"middle"}"#,
    ] {
        fixture(&[], &["--declare", fits]).with_code(0);
    }
}

//! Kernels that declare an order or nothing, and --expect.

use super::run::fixture;

#[test]
fn nothing_promised_is_nothing_confirmed_until_it_is_expected() {
    let bare = ["--declare", "{}"];
    let run = fixture(&[], &bare).with_code(1);
    run.shows("(nothing was promised: --expect ORDER, or let the kernel declare a method)");
    run.shows("the values are those of: middle samples, 1 - exp(-τd)");
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

//! Decimal numbers of any length and magnitude, and what is none.

use volver::convergence::Decimal;

#[test]
fn digits_decide_the_precision() {
    let digits =
        "0.1234567890123456789012345678901234567890123456789012345678901234567890123456789";
    let read = Decimal::parse(digits).unwrap();
    assert!(read.value.prec() > 79 * 332 / 100 + 64);
    assert_eq!(
        read.value.to_string_radix(10, Some(79)).get(..40),
        digits
            .get(2..41)
            .map(|d| format!("1.{}", &d[1..]))
            .as_deref()
    );
    assert_eq!(read.last_place, -79);
}

#[test]
fn magnitudes_outside_binary64_survive() {
    let tiny = Decimal::parse("-2.5e-2000").unwrap();
    assert!(tiny.value < 0 && !tiny.value.is_zero());
    assert_eq!(tiny.last_place, -2001);
    assert_eq!(Decimal::parse("1e400").unwrap().last_place, 400);
    assert_eq!(Decimal::parse("0e-5").unwrap().value, 0);
    assert_eq!(Decimal::parse("1.").unwrap().value, 1);
    assert_eq!(Decimal::parse("+.5E+1").unwrap().value, 5);
}

#[test]
fn nothing_else_is_a_number() {
    for text in [
        "",
        ".",
        "-",
        "e5",
        "1e",
        "1e+",
        "1e5.0",
        "1e--5",
        "--1",
        "+-1",
        "1_000",
        "0x10",
        "nan",
        "inf",
        "1,5",
        "1 5",
        " 1",
        "1f",
        "1e999999999",
        "1e-999999999",
        "1e99999999999999999999",
        "@nan@",
    ] {
        assert_eq!(Decimal::parse(text), None, "{text}");
    }
}

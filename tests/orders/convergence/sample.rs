//! Samples as JSON, however small.

use rug::Float;
use volver::convergence::Sample;
use volver::real::{MpfrReal, Real};

fn json(text: &str) -> String {
    let x = Float::with_val(200, Float::parse(text).unwrap());
    serde_json::to_string(&Sample {
        n: None,
        step: 0.5,
        floor: Float::new(53),
        error: x,
    })
    .unwrap()
}

#[test]
fn errors_are_numbers_down_to_1e_300_and_strings_below() {
    for (text, written) in [
        ("-0.25", "-0.25"),
        ("0", "0.0"),
        ("1e-300", "1e-300"),
        ("9e-301", "\"9.0000000000000000e-301\""),
        ("-1.5e-2000", "\"-1.5000000000000000e-2000\""),
        ("1e400", "\"1.0000000000000000e400\""),
        ("nan", "\"NaN\""),
        ("-inf", "\"-inf\""),
    ] {
        let expected = format!("{{\"n\":null,\"step\":0.5,\"error\":{written},\"floor\":0.0}}");
        assert_eq!(json(text), expected);
    }
}

#[test]
fn logarithms_survive_outside_binary64() {
    let tiny: Float = Float::with_val(64, 1) >> 10_000_u32;
    assert_eq!(MpfrReal::from(-tiny).log2_abs(), -10_000.0);
    assert_eq!(MpfrReal::from(Float::new(53)).log2_abs(), f64::NEG_INFINITY);
}

//! Format names: round trip, and what is said of text that names none.

use super::{FormatError, FormatName, WithFormat};
use crate::real::Format;

const NAMES: [(&str, FormatName, u32); 7] = [
    ("f16", FormatName::F16, 11),
    ("bf16", FormatName::Bf16, 8),
    ("f32", FormatName::F32, 24),
    ("f64", FormatName::F64, 53),
    ("mpfr:2", FormatName::Mpfr(2), 2),
    ("mpfr:256", FormatName::Mpfr(256), 256),
    ("mpfr:1048576", FormatName::Mpfr(1 << 20), 1 << 20),
];

#[test]
fn names_parse_and_print_alike() {
    for (text, name, _) in NAMES {
        assert_eq!(text.parse(), Ok(name));
        assert_eq!(name.to_string(), text);
    }
    // Tables align names.
    assert_eq!(
        format!("{:>5}|{:<9}|", FormatName::F32, FormatName::Mpfr(8)),
        "  f32|mpfr:8   |"
    );
}

#[test]
fn a_name_runs_its_own_format() {
    struct Describe;
    impl WithFormat for Describe {
        type Output = (String, u32);
        fn run<F: Format>(self, format: F) -> (String, u32) {
            (format.to_string(), format.bits())
        }
    }
    for (text, name, bits) in NAMES {
        assert_eq!(name.with(Describe), (text.to_string(), bits));
    }
}

#[test]
fn a_precision_out_of_range_is_named_with_the_range() {
    for bits in [
        "0",
        "1",
        "1048577",
        "99999999999",
        "-5",
        "53.0",
        "",
        " 53",
        "+53",
        "x",
    ] {
        let error = format!("mpfr:{bits}").parse::<FormatName>().unwrap_err();
        assert_eq!(error, FormatError::Precision { bits: bits.into() });
        assert_eq!(
            error.to_string(),
            format!(
                "precision '{bits}' of format 'mpfr:{bits}' is out of range (allowed: mpfr:2 … mpfr:1048576)"
            )
        );
    }
}

#[test]
fn an_unknown_name_is_repeated_with_the_allowed_ones() {
    for name in ["F64", "", "f64 ", "double", "mpfr", "mpfr256", "f128"] {
        let error = name.parse::<FormatName>().unwrap_err();
        assert_eq!(error, FormatError::Unknown { name: name.into() });
        assert_eq!(
            error.to_string(),
            format!("unknown format '{name}' (allowed: f16, bf16, f32, f64, mpfr:BITS)")
        );
    }
}

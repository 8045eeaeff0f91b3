//! Format names: round trip, and what is said of text that names none.

use volver::real::{Fixed, Format, FormatError, FormatName, Ieee, WithFormat};

fn names() -> [(&'static str, FormatName, u32); 17] {
    let ieee = |bits, emin, emax| FormatName::Ieee(Ieee::new(bits, emin, emax).unwrap());
    let fixed = |integer, fraction| FormatName::Fixed(Fixed::new(integer, fraction).unwrap());
    [
        ("f16", FormatName::F16, 11),
        ("bf16", FormatName::Bf16, 8),
        ("f32", FormatName::F32, 24),
        ("f64", FormatName::F64, 53),
        ("f32-lanes", FormatName::F32Lanes, 24),
        ("f64-lanes", FormatName::F64Lanes, 53),
        ("mpfr:2", FormatName::Mpfr(2), 2),
        ("mpfr:256", FormatName::Mpfr(256), 256),
        ("mpfr:1048576", FormatName::Mpfr(1 << 20), 1 << 20),
        ("tf32", ieee(11, -126, 127), 11),
        ("fp8-e4m3", FormatName::Ieee(Ieee::E4M3), 4),
        ("fp8-e5m2", ieee(3, -14, 15), 3),
        ("ieee:24,-126,127", FormatName::Ieee(Ieee::BINARY32), 24),
        ("ieee:64,-16382,16383", ieee(64, -16382, 16383), 64),
        ("fixed:15", fixed(16, 15), 15),
        ("fixed:8.24", fixed(8, 24), 24),
        ("fixed:0.1", fixed(0, 1), 1),
    ]
}

#[test]
fn names_parse_and_print_alike() {
    for (text, name, _) in names() {
        assert_eq!(text.parse(), Ok(name));
        assert_eq!(name.to_string(), text);
    }
    // Tables align names.
    assert_eq!(
        format!("{:>5}|{:<9}|", FormatName::F32, FormatName::Mpfr(8)),
        "  f32|mpfr:8   |"
    );
    let (tf32, fixed) = (FormatName::Ieee(Ieee::TF32), "fixed:8.4".parse());
    let fixed: FormatName = fixed.unwrap();
    assert_eq!(format!("{tf32:>6}|{fixed:<10}|"), "  tf32|fixed:8.4 |");
}

#[test]
fn one_format_has_one_name() {
    for (text, name) in [
        ("ieee:11,-126,127", "tf32"),
        ("ieee:3,-14,15", "fp8-e5m2"),
        ("fixed:16.15", "fixed:15"),
        ("ieee:8,-0126,127", "ieee:8,-126,127"),
    ] {
        let format: FormatName = text.parse().unwrap();
        assert_eq!(format.to_string(), name);
        assert_eq!(name.parse(), Ok(format));
    }
    // Its last significand is NaN, and it has no infinities.
    let e4m3_with_infinity: FormatName = "ieee:4,-6,8".parse().unwrap();
    assert_eq!(e4m3_with_infinity.to_string(), "ieee:4,-6,8");
    assert_ne!(e4m3_with_infinity, FormatName::Ieee(Ieee::E4M3));
}

#[test]
fn parameters_that_are_no_integers_are_named_with_what_they_should_be() {
    for parameters in [
        "",
        "24",
        "24,-126",
        "24,-126,127,1",
        "24, -126,127",
        "+24,-126,127",
        "24,-126,+127",
        "x,y,z",
        "-24,0,1",
        "24,-126,99999999999",
    ] {
        let error = format!("ieee:{parameters}")
            .parse::<FormatName>()
            .unwrap_err();
        assert_eq!(
            error,
            FormatError::Ieee {
                parameters: parameters.into()
            }
        );
        assert_eq!(
            error.to_string(),
            format!(
                "'{parameters}' of format 'ieee:{parameters}' are no three integers (allowed: ieee:BITS,EMIN,EMAX, such as ieee:24,-126,127)"
            )
        );
    }
    for parameters in [
        "",
        ".",
        "8.",
        ".24",
        "8.24.1",
        "+8.24",
        "8.+24",
        "-8.24",
        "1e3",
        "99999999999",
    ] {
        let error = format!("fixed:{parameters}")
            .parse::<FormatName>()
            .unwrap_err();
        assert_eq!(
            error,
            FormatError::Fixed {
                parameters: parameters.into()
            }
        );
        assert_eq!(
            error.to_string(),
            format!(
                "'{parameters}' of format 'fixed:{parameters}' are no numbers of bits (allowed: fixed:FRACTION, fixed:INTEGER.FRACTION, such as fixed:15, fixed:8.24)"
            )
        );
    }
    assert_eq!(
        "ieee:1,-126,127".parse::<FormatName>(),
        Err(FormatError::IeeeRange {
            bits: 1,
            emin: -126,
            emax: 127
        })
    );
    assert_eq!(
        "fixed:0".parse::<FormatName>(),
        Err(FormatError::FixedRange {
            integer: 16,
            fraction: 0
        })
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
    for (text, name, bits) in names() {
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
    for name in [
        "F64", "", "f64 ", "double", "mpfr", "mpfr256", "f128", "ieee", "fixed", "TF32", "fp8",
        "mpf:24",
    ] {
        let error = name.parse::<FormatName>().unwrap_err();
        assert_eq!(error, FormatError::Unknown { name: name.into() });
        assert_eq!(
            error.to_string(),
            format!(
                "unknown format '{name}' (allowed: f16, bf16, f32, f64, f32-lanes, f64-lanes, tf32, fp8-e4m3, fp8-e5m2, ieee:BITS,EMIN,EMAX, fixed:FRACTION, fixed:INTEGER.FRACTION, mpfr:BITS)"
            )
        );
    }
}

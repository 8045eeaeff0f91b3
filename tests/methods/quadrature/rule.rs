//! Names of rules.

use volver::quadrature::{Rule, RuleError};

const NAMES: [(&str, Rule); 9] = [
    ("riemann-left", Rule::RiemannLeft),
    ("riemann-right", Rule::RiemannRight),
    ("midpoint", Rule::Midpoint),
    ("trapezoid", Rule::Trapezoid),
    ("simpson", Rule::Simpson),
    ("boole", Rule::Boole),
    ("gauss-1", Rule::GaussLegendre(1)),
    ("gauss-3", Rule::GaussLegendre(3)),
    ("gauss-1000", Rule::GaussLegendre(1000)),
];

#[test]
fn names_parse_and_print_alike() {
    for (text, rule) in NAMES {
        assert_eq!(text.parse(), Ok(rule));
        assert_eq!(rule.to_string(), text);
    }
    assert_eq!(
        format!("{:>9}|{:<8}|", Rule::Boole, Rule::GaussLegendre(3)),
        "    boole|gauss-3 |"
    );
}

#[test]
fn a_number_of_points_out_of_range_is_named_with_the_range() {
    for points in ["0", "1001", "-3", "+3", "3.0", "", "many", "99999999999"] {
        let error = format!("gauss-{points}").parse::<Rule>().unwrap_err();
        assert_eq!(
            error,
            RuleError::Points {
                points: points.into()
            }
        );
        assert_eq!(
            error.to_string(),
            format!(
                "'{points}' points of a Gauss–Legendre rule are out of range (allowed: gauss-1 … gauss-1000)"
            )
        );
    }
}

#[test]
fn a_rule_made_in_code_is_checked_too() {
    for points in [0, 1001, u32::MAX] {
        let error = Rule::GaussLegendre(points).table(53).unwrap_err();
        assert_eq!(
            error,
            RuleError::Points {
                points: points.to_string()
            }
        );
    }
}

#[test]
fn an_unknown_rule_is_repeated_with_the_allowed_ones() {
    for name in ["simspon", "", "Simpson", "gauss", "gauss3", "riemann"] {
        let error = name.parse::<Rule>().unwrap_err();
        assert_eq!(error, RuleError::Unknown { name: name.into() });
        assert_eq!(
            error.to_string(),
            format!(
                "unknown rule '{name}' (allowed: riemann-left, riemann-right, midpoint, trapezoid, simpson, boole, gauss-POINTS)"
            )
        );
    }
}

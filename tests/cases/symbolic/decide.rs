//! Claims that hold, that fail, and that cannot be known.

use super::parse;
use Claim::{Defined, NonNegative, Nonzero, Positive};
use quickcheck::QuickCheck;
use rug::Rational;
use volver::symbolic::{Claim, Decision, EncloseError, Expr, Interval, decide};

fn on(text: &str, from: (i32, i32), to: (i32, i32), claim: Claim) -> Decision {
    decide(&parse(text), "x", &from.into(), &to.into(), claim)
}

#[test]
fn proved() {
    for (text, claim) in [
        ("x", NonNegative),
        ("1 + x", Positive),
        ("(x - 1/2)^2", NonNegative),
        ("x*cos(x^2)", NonNegative),
        ("1 + sin(5*x)", NonNegative),
        ("(sin(x^2) + 2)*exp(-sin(x^2)/2)", Positive),
        ("x*(1 - x)", NonNegative),
        ("x - x^2", NonNegative),
        ("x^2 - 2*x^3 + x^4", NonNegative),
        ("1/3*x - x^2/3", NonNegative),
        // Zeros of some order at an end, by slopes.
        ("1 - cos(x)", NonNegative),
        ("x - sin(x)", NonNegative),
        ("exp(x) - 1 - x", NonNegative),
        ("cosh(x) - 1 - x^2/2", NonNegative),
        ("tan(x) - x", NonNegative),
        ("x - tanh(x)", NonNegative),
        ("ln(1 + x) - x + x^2/2", NonNegative),
        ("1 - x - ln(2 - x)", NonNegative),
        ("exp(1 - x) - 2 + x", NonNegative),
        // And by halving down to where the slope is clear.
        ("sin(3*x)", NonNegative),
        ("x^3 - x^2/2 + x/10", NonNegative),
        ("x^2 + x + 1 - 3*x + 1/9", Positive),
        ("exp(x) - 2*x - 1/2", Positive),
        ("2 - exp(x) + x^2", Nonzero),
        ("sin(x) - 2", Nonzero),
        ("sqrt(x)", Defined),
        ("sqrt(x - x^2)", Defined),
        ("sqrt(x - x^2)", NonNegative),
        ("sqrt(x - sin(x))", Defined),
        ("2 + sqrt(1 + sqrt(x - x^2))", Positive),
        ("1/(1 + x^2 - x)", Defined),
        ("ln(x + 1/1000)", Defined),
        ("tan(3/2*x)", Defined),
        ("exp(exp(exp(20*x)))", Defined),
        ("min(x, 1 - x)", NonNegative),
        ("max(x, 1/2 - x)", Positive),
        ("max(x, 1/2) - x", NonNegative),
        ("abs(x - 1/3) + 1/100", Positive),
        // Pieces: jumps and what meets 0 at them.
        ("piecewise(x < 1/2, 1, 2)", Positive),
        ("piecewise(x < 1/2, 1, -2)", Nonzero),
        ("piecewise(x < 1/3, 1/3 - x, x - 1/3)", NonNegative),
        ("piecewise(x < 1/2, 0, x - 1/2)", NonNegative),
        (
            "piecewise(x <= 1/2, 1 - cos(x), x < 3/4, sqrt(x - 1/2), 7)",
            NonNegative,
        ),
        ("piecewise(1/2 > x, sin(x), 1)", NonNegative),
        ("piecewise(x^2 < 1/3, 1, 2)", Positive),
        ("piecewise(x > 2, 1/(x - x), 1)", Positive),
    ] {
        assert_eq!(on(text, (0, 1), (1, 1), claim), Decision::Proved, "{text}");
        assert_eq!(on(text, (1, 1), (0, 1), claim), Decision::Proved, "{text}");
    }
    let both = on("cosh(x) - 1 - x^2/2", (-1, 1), (1, 1), NonNegative);
    assert_eq!(both, Decision::Proved);
    assert_eq!(on("1 - 3*x", (0, 1), (1, 3), NonNegative), Decision::Proved);
    assert_eq!(on("x - 1/7", (1, 7), (1, 7), NonNegative), Decision::Proved);
}

#[test]
fn refuted() {
    for (text, claim, witness) in [
        ("x", Positive, Some("0")),
        ("x", Nonzero, Some("0")),
        ("1 - x", Positive, Some("1")),
        ("x - 1/100", NonNegative, Some("0")),
        ("0*x", Positive, Some("0")),
        ("1/x", Defined, Some("0")),
        ("1/x", NonNegative, Some("0")),
        ("ln(x)", Defined, Some("0")),
        ("1/(x - 1/3)", Defined, Some("1/3")),
        ("1/(x - 3/7)", Defined, Some("3/7")),
        ("(7*x - 3)^2", Nonzero, Some("3/7")),
        ("(11*x - 5)^2", Positive, Some("5/11")),
        ("sqrt(x - 1/2)", Defined, Some("0")),
        ("sqrt((x - 1/2)^2 - 1/10000)", Defined, Some("1/2")),
        ("x - 1/2", Nonzero, Some("1/2")),
        ("sqrt((x - 2/9)^2 - 1/1000000)", Defined, None),
        ("1 - 2*exp(-100*(x - 2/9)^2)", NonNegative, None),
        ("(x - 1/7)^2 - 1/1000000", NonNegative, None),
        ("x^2 - 1/2", Nonzero, None),
        ("exp(x) - 2", Nonzero, None),
        ("1/2 - sqrt(x - x^3)", Nonzero, None),
        ("cos(2*x)", Nonzero, None),
        (
            "piecewise(x < 1/2, 1, x <= 1/2, -1, 1)",
            Positive,
            Some("1/2"),
        ),
        ("piecewise(x < 4/9, 1, x < 5/9, -1, 1)", NonNegative, None),
        ("piecewise(x <= 0, -1, 1)", NonNegative, Some("0")),
        ("piecewise(x < 1/2, 1, 1/(x - 1/2))", Defined, Some("1/2")),
        ("piecewise(x < 1/2, 1, exp(x) - 2)", Nonzero, None),
    ] {
        let Decision::Refuted { witness: at, value } = on(text, (0, 1), (1, 1), claim) else {
            panic!("{text}: {:?}", on(text, (0, 1), (1, 1), claim));
        };
        if let Some(witness) = witness {
            assert_eq!(at.to_string(), witness, "{text}");
        }
        let there = parse(text).enclose(256, &|_| Some(Interval::point(256, &at)));
        match (claim, value) {
            (_, None) => assert!(
                matches!(there, Err(EncloseError::NotDefined { .. })),
                "{text}"
            ),
            (Nonzero, Some(value)) => {
                assert!(
                    value.contains_zero() && value.width() < 1e-6,
                    "{text}: {value}"
                );
            }
            (Positive, Some(value)) => assert!(value.is_nonpositive(), "{text}: {value}"),
            (_, Some(value)) => assert!(value.is_negative(), "{text}: {value}"),
        }
    }
}

/// At irrational numbers, the witness being beside them.
#[test]
fn poles_are_found_by_the_sign_of_what_is_divided_by() {
    for text in [
        "tan(2*x)",
        "1/cos(2*x)",
        "x/(x^2 - 1/2)",
        "0*(cos(2*x) + 1/7)^-3",
        "piecewise(x < 1/2, 1, tan(2*x))",
    ] {
        let decision = on(text, (0, 1), (1, 1), Defined);
        let Decision::Refuted {
            witness,
            value: None,
        } = decision
        else {
            panic!("{text}: {decision:?}");
        };
        assert!((0.5..1.0).contains(&witness.to_f64()), "{text}: {witness}");
    }
    assert_eq!(on("tan(x)", (0, 1), (3, 2), Defined), Decision::Proved);
}

#[test]
fn undecided() {
    for (text, claim) in [
        // Zeros that are only touched, or at no rational number.
        ("1 + sin(5*x)", Positive),
        ("sin(5*x + 1)^2", Positive),
        ("(x^2 - 1/2)^2", Nonzero),
        ("2 + 2*sin(5*x) - cos(5*x)^2/9", Positive),
        ("sin(x)^2 + cos(x)^2 - 1", NonNegative),
        // A divisor that only touches 0, and one that may not be needed.
        ("1/(1 + sin(5*x))", Defined),
        ("piecewise(x^2 < 1/2, 1, 1/cos(2*x))", Defined),
        ("y + 1", Positive),
        ("x - x*y", Defined),
        // Both sides of a kink meet at 1, and slopes cannot tell which is taken.
        ("max(x, x^2) - x^2", NonNegative),
        // What is between the pieces is not 0 within any number of bits.
        ("piecewise(x < 1/2, 1, x <= 1/2, sin(pi), 1)", NonNegative),
        // A rise after a jump downwards.
        ("piecewise(x^2 < 1/2, 1 + x, x*x - 1/2)", NonNegative),
    ] {
        let decision = on(text, (0, 1), (1, 1), claim);
        assert!(
            matches!(decision, Decision::Undecided { .. }),
            "{text}: {decision:?}"
        );
    }
    let Decision::Undecided { near } = on("1 + sin(5*x)", (0, 1), (1, 1), Positive) else {
        panic!();
    };
    let distance = near.to_f64() - 3.0 * std::f64::consts::PI / 10.0;
    assert!(distance.abs() < 1e-3, "{near}");
    // The sign changes at a jump: no number gives 0.
    let jump = on("piecewise(x^2 < 1/2, -1, 1)", (0, 1), (1, 1), Nonzero);
    assert!(!matches!(jump, Decision::Refuted { .. }));
    let touched = on(
        "piecewise(x^2 < 1/2, x^2 - 1/2, 1)",
        (0, 1),
        (1, 1),
        Nonzero,
    );
    assert!(matches!(touched, Decision::Undecided { .. }));
}

/// Polynomials that are made of their roots: every sign is known beforehand.
#[test]
fn no_false_claim_is_proved() {
    fn check(roots: Vec<(i8, u8)>, squared: u8, lift: u8) -> bool {
        let mut roots: Vec<Rational> = roots
            .into_iter()
            .take(4)
            .map(|(n, d)| Rational::from((n, i32::from(d % 12) + 40)))
            .collect();
        roots.sort();
        roots.dedup();
        let exponent = 1 + usize::from(squared % 2);
        let lift = Rational::from((i32::from(lift % 3), 1000));
        // Multiplied out, so that its roots cannot be seen.
        let mut coefficients = vec![Rational::from(1)];
        for root in roots.iter().flat_map(|root| vec![root; exponent]) {
            let mut next = vec![Rational::new(); coefficients.len() + 1];
            for (power, coefficient) in coefficients.iter().enumerate() {
                next[power + 1] += coefficient;
                next[power] -= Rational::from(coefficient * root);
            }
            coefficients = next;
        }
        let x = Expr::symbol("x");
        let mut polynomial = Expr::number(lift.clone());
        let mut power = Expr::number(1);
        for coefficient in coefficients {
            polynomial = polynomial + Expr::number(coefficient) * power.clone();
            power = power * x.clone();
        }
        let (from, to) = (Rational::from(0), Rational::from(1));
        let inside = roots.iter().any(|root| *root >= 0 && *root <= 1);
        let crosses = exponent == 1 && roots.iter().any(|root| *root > 0 && *root < 1);
        let truth = |claim| match claim {
            Defined => Some(true),
            // Squares, lifted or not, are what they look like; others only where nothing is lifted.
            _ if lift != 0 && exponent == 2 => Some(true),
            _ if lift != 0 => None,
            NonNegative if exponent == 2 => Some(true),
            NonNegative if crosses => Some(false),
            Positive if exponent == 2 => Some(!inside),
            Positive if inside => Some(false),
            Nonzero => Some(!inside),
            NonNegative | Positive => None,
        };
        for claim in [Defined, NonNegative, Positive, Nonzero] {
            let decision = decide(&polynomial, "x", &from, &to, claim);
            match (truth(claim), &decision) {
                (Some(true), Decision::Refuted { .. }) | (Some(false), Decision::Proved) => {
                    panic!("{claim:?} of {polynomial}: {decision:?}")
                }
                _ => {}
            }
        }
        true
    }
    QuickCheck::new()
        .tests(60)
        .quickcheck(check as fn(Vec<(i8, u8)>, u8, u8) -> bool);
}

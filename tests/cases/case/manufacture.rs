//! The catalogue, proved; derivations worked by hand; what is refused.

use rug::Rational;
use volver::case::manufacture::{ManufactureError, Manufactured, Outcome, Statement, manufacture};
use volver::case::{Case, Description, END_DERIVATIVES, catalogue};
use volver::symbolic::{Expr, expand};

fn description(text: &str) -> Description {
    Description::read(text).unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn made(text: &str) -> Vec<Manufactured> {
    manufacture(&description(text)).unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn refused(text: &str) -> ManufactureError {
    manufacture(&description(text)).unwrap_err()
}

fn catalogued() -> Vec<Manufactured> {
    catalogue::names()
        .flat_map(|name| manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap())
        .collect()
}

fn outcome(case: &Manufactured, statement: Statement) -> &Outcome {
    let check = case
        .checks
        .iter()
        .find(|check| check.statement == statement);
    &check.unwrap().outcome
}

#[test]
fn the_catalogue_is_proved() {
    for case in catalogued() {
        for check in &case.checks {
            assert_eq!(
                check.outcome,
                Outcome::Proved,
                "{}: {}",
                case.case.name(),
                check.statement
            );
        }
    }
}

#[test]
fn the_paper_s_case_is_derived() {
    let case = &made(catalogue::text("sine-squared").unwrap())[0];
    let formulas = case.case.formulas();
    assert_eq!(formulas.emission.to_string(), "sin(s^2)");
    assert_eq!(formulas.extinction.to_string(), "cos(s^2)*s");
    assert!(case.is_proved() && case.suits_kernels());
    assert!(!case.is_degenerate_for_preintegration());
    assert!(made(catalogue::text("reciprocal").unwrap())[0].is_degenerate_for_preintegration());
}

#[test]
fn the_polynomial_recipe_gives_the_radiance() {
    // P = t²: P̃ = t² + 2t + 2, I = 2 − (t² + 2t + 2) e^(−t).
    let case =
        &made("name = \"a\"\nlength = 2\ndepth = \"3*lambda\"\nemission_of_depth = \"t^2\"")[0];
    let expected: Expr = "2 - (9*lambda^2 + 6*lambda + 2)*exp(-3*lambda)"
        .parse()
        .unwrap();
    let difference = case.case.formulas().radiance.as_ref().unwrap() - &expected;
    assert!(expand(&difference).unwrap().is(0));
}

#[test]
fn what_hides_errors_is_seen() {
    let along = |text: &str| made(text)[0].case.structure().along;
    let cloud = along(catalogue::text("cloud").unwrap());
    // C τ e^(−t) and its slope are 0 at both ends; its second derivative is not the same there.
    assert_eq!(cloud.equal_at_ends[..4], [true, true, false, false]);
    let sine = along(catalogue::text("sine-squared").unwrap());
    assert_eq!(sine.equal_at_ends, [false; END_DERIVATIVES]);
    // τ is 0 at both ends of the cloud.
    assert!(cloud.end_samples_cancel && !sine.end_samples_cancel);
    // C τ is the same at both ends of a layer without extinction in front of it, but not what is seen of it.
    let emission = |text: &str| {
        along(&format!(
            "name = \"a\"\nlength = 1\ndepth = \"lambda^2 + lambda\"\n{text}"
        ))
    };
    let constant = emission("emission_of_depth = \"3/7\"");
    assert!(constant.emission_is_constant && !constant.end_samples_cancel);
    assert!(!emission("emission_of_depth = \"t + 1\"").emission_is_constant);
    // τ = 1 + (1 − 2λ)²: C constant, and τ as large at the far end as in front.
    let even = along(
        "name = \"a\"\nlength = 1\ndepth = \"2*lambda - 2*lambda^2 + 4*lambda^3/3\"\n\
         emission_of_depth = \"2\"",
    );
    assert!(even.emission_is_constant && even.end_samples_cancel);
    let decay = |factor: &str| {
        along(&format!(
            "name = \"a\"\nlength = 3\nfield = \"exp(-lambda)\"\ninverse = \"-ln(s)\"\n\
             depth = \"{factor}*lambda\"\nemission_of_depth = \"t + 1\""
        ))
    };
    // w ∝ e^((1 − a)λ) and s = e^(−λ): w s⁗ + 4 w′ s‴ ∝ 1 − 4 (1 − a).
    assert!(decay("3/4").parabolas_hide_source);
    assert!(!decay("1").parabolas_hide_source);
    assert_eq!(decay("1").extinction_degree, Some(0));
}

const HEAD: &str = "name = \"a\"\nlength = 1\n";

#[test]
fn wrong_claims_are_refused_with_a_witness() {
    for (body, statement) in [
        (
            "depth = \"1 + lambda\"\nradiance = \"lambda\"",
            Statement::DepthAtZero,
        ),
        (
            "depth = \"lambda\"\nradiance = \"1 - exp(-lambda) + 1/1000000\"",
            Statement::RadianceAtZero,
        ),
        (
            "depth = \"lambda - lambda^2\"\nradiance = \"1 - exp(lambda^2 - lambda)\"",
            Statement::ExtinctionNonNegative,
        ),
        (
            "depth = \"lambda - 51/100*lambda^2\"\nemission_of_depth = \"1\"",
            Statement::ExtinctionNonNegative,
        ),
        (
            "depth = \"sqrt(lambda)\"\nemission_of_depth = \"1\"",
            Statement::ExtinctionDefined,
        ),
        (
            "depth = \"piecewise(lambda < 1/2, lambda, 2*lambda)\"\nemission_of_depth = \"1\"",
            Statement::DepthContinuous,
        ),
        (
            "depth = \"lambda\"\nextinction = \"1\"\nemission = \"1\"\nradiance = \"1 - exp(-lambda)*(1 + lambda/10^9)\"",
            Statement::RadianceDerivative,
        ),
        (
            "depth = \"lambda\"\nextinction = \"1 + s/10^9\"\nemission = \"0\"\nradiance = \"0\"",
            Statement::DepthDerivative,
        ),
        (
            "depth = \"lambda\"\nradiance = \"sqrt(lambda)\"",
            Statement::EmissionDefined,
        ),
        (
            "field = \"1 + lambda\"\ninverse = \"s + 1\"\ndepth = \"lambda\"\nemission_of_depth = \"1\"",
            Statement::Inverse,
        ),
        (
            "field = \"1/(lambda - 1/2)\"\nextinction = \"1\"\nemission = \"0\"\ndepth = \"lambda\"\nradiance = \"0\"",
            Statement::FieldDefined,
        ),
    ] {
        match refused(&format!("{HEAD}{body}")) {
            ManufactureError::Refuted {
                statement: refuted,
                witness,
                ..
            } => {
                assert_eq!(refuted, statement, "{body}");
                assert!((0..=1).contains(&witness), "{witness}");
            }
            error => panic!("{body}: {error}"),
        }
    }
}

/// Whatever holds beside a point says nothing of the point.
#[test]
fn a_value_at_a_single_point_counts() {
    let layers = [
        ("depth", "lambda"),
        ("extinction", "1"),
        ("emission", "1"),
        ("radiance", "1 - exp(-lambda)"),
    ];
    for (key, value, statement) in [
        (
            "depth",
            "piecewise(lambda <= 0, 5, lambda)",
            Statement::DepthAtZero,
        ),
        (
            "depth",
            "piecewise(lambda >= 1, 0, lambda)",
            Statement::DepthContinuous,
        ),
        (
            "depth",
            "piecewise(lambda < 1/2, lambda, lambda <= 1/2, 7, lambda)",
            Statement::DepthContinuous,
        ),
        (
            "depth",
            "piecewise((lambda - 1/3)^2 <= 0, 7, lambda)",
            Statement::DepthContinuous,
        ),
        (
            "depth",
            "piecewise(abs(lambda - sqrt(1/2)) <= 0, lambda + 1e-30, lambda)",
            Statement::DepthContinuous,
        ),
        (
            "radiance",
            "piecewise(lambda < 1, 1 - exp(-lambda), 0)",
            Statement::RadianceContinuous,
        ),
        (
            "extinction",
            "piecewise(abs(s - 1/2) <= 0, 7, 1)",
            Statement::DepthDerivative,
        ),
        (
            "emission",
            "piecewise(s <= 0, 7, 1)",
            Statement::RadianceDerivative,
        ),
    ] {
        let lines = layers.map(|(name, plain)| {
            let formula = if name == key { value } else { plain };
            format!("{name} = \"{formula}\"\n")
        });
        match refused(&format!("{HEAD}{}", lines.concat())) {
            ManufactureError::Refuted {
                statement: refuted, ..
            } => assert_eq!(refuted, statement, "{value}"),
            error => panic!("{value}: {error}"),
        }
    }
    // All of I is lost at the far end, where both closed forms are 0.
    let lost = "name = \"a\"\nlength = 2\nextinction = \"piecewise(s < 1, 1, s < 2, 3, 0)\"\n\
                emission = \"1\"\n\
                depth = \"piecewise(lambda < 1, lambda, lambda < 2, 3*lambda - 2, 0)\"\n\
                radiance = \"piecewise(lambda < 1, 1 - exp(-lambda), lambda < 2, 1 - exp(2 - 3*lambda), 0)\"";
    let error = refused(lost).to_string();
    assert!(
        error.starts_with("t continuous fails at lambda = 2"),
        "{error}"
    );
}

#[test]
fn an_inverse_has_a_value_or_is_none() {
    let with = |inverse: &str| {
        format!(
            "{HEAD}depth = \"lambda\"\nemission_of_depth = \"1\"\nfield = \"lambda\"\n\
             inverse = \"{inverse}\""
        )
    };
    for inverse in ["s + 0*ln(abs(s) - s)", "s + 0*tan(2*s)", "s*(s/s)"] {
        assert!(
            matches!(
                refused(&with(inverse)),
                ManufactureError::Refuted {
                    statement: Statement::InverseDefined,
                    ..
                }
            ),
            "{inverse}"
        );
    }
    let touched = &made(&with("s + 0/(s^2 - 2*s*sqrt(1/3) + 1/3)"))[0];
    for statement in [Statement::InverseDefined, Statement::Inverse] {
        assert!(matches!(
            outcome(touched, statement),
            Outcome::Undecided { .. }
        ));
    }
    assert!(!touched.is_proved() && touched.unproved().len() >= 2);
}

/// Both formulas are right, and give the kink to different sides.
#[test]
fn sides_of_a_kink_are_no_contradiction() {
    let kink = &made(&format!(
        "{HEAD}depth = \"max(lambda, 2*lambda - 1/2)\"\nextinction = \"piecewise(2*s <= 1, 1, 2)\"\n\
         emission = \"1\"\nradiance = \"1 - exp(-max(lambda, 2*lambda - 1/2))\""
    ))[0];
    assert!(kink.is_proved(), "{:?}", kink.unproved());
    // Where cos λ = λ, of which no closed form is known.
    let kink = &made(&format!(
        "{HEAD}depth = \"max(lambda - cos(lambda), 0)\"\n\
         extinction = \"piecewise(s <= cos(s), 0, 1 + sin(s))\"\nemission = \"1\"\n\
         radiance = \"1 - exp(-max(lambda - cos(lambda), 0))\""
    ))[0];
    assert!(kink.is_proved(), "{:?}", kink.unproved());
}

#[test]
fn what_is_not_proved_is_reachable_from_the_case() {
    let case = &made(&format!(
        "{HEAD}depth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\""
    ))[0];
    let unproved: Vec<String> = case
        .case
        .unproved()
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        unproved,
        [
            "C defined: undecided near lambda = 0",
            "C >= 0: undecided near lambda = 0"
        ]
    );
    assert!(!case.meets_theorems());
    let proved = &made(catalogue::text("sine-squared").unwrap())[0];
    assert!(proved.unproved().is_empty() && proved.meets_theorems());
    let pole = refused("name = 'a'\nlength = 2\nextinction = '1 + tan(s)^2'\nemission = '1'");
    assert!(pole.to_string().starts_with("tau defined fails"), "{pole}");
}

#[test]
fn what_has_no_value_proves_nothing() {
    // Each is right wherever it has a value, and has none beyond 1/2.
    let nothing = "ln(1/2 - lambda) - ln(1/2 - lambda)";
    let of_field = "ln(1/2 - s) - ln(1/2 - s)";
    let plain = ["lambda", "1", "1", "1 - exp(-lambda)"];
    for (place, text, statement) in [
        (0, nothing, Statement::DepthDefined),
        (1, of_field, Statement::ExtinctionDefined),
        (2, of_field, Statement::EmissionDefined),
        (3, nothing, Statement::RadianceDefined),
    ] {
        let mut formulas = plain.map(String::from);
        formulas[place] = format!("{} + {text}", plain[place]);
        let [depth, extinction, emission, radiance] = formulas;
        let error = refused(&format!(
            "{HEAD}depth = \"{depth}\"\nextinction = \"{extinction}\"\nemission = \"{emission}\"\n\
             radiance = \"{radiance}\""
        ));
        let refuted = match &error {
            ManufactureError::Refuted { statement, .. } => Some(*statement),
            _ => None,
        };
        assert_eq!(refuted, Some(statement), "{error}");
    }
}

#[test]
fn negative_emission_is_a_warning() {
    let case = &made(&format!("{HEAD}depth = \"lambda\"\nradiance = \"-lambda\""))[0];
    assert!(case.is_proved() && !case.suits_kernels());
    assert!(matches!(
        outcome(case, Statement::EmissionNonNegative),
        Outcome::Refuted { .. }
    ));
}

#[test]
fn what_cancels_no_formula_is_undecided_there() {
    // C = 2λ/sin λ·… is 0/0 at 0 with a limit that no cancelling shows.
    let case = &made(&format!(
        "{HEAD}depth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\""
    ))[0];
    for statement in [Statement::EmissionDefined, Statement::EmissionNonNegative] {
        assert_eq!(
            *outcome(case, statement),
            Outcome::Undecided {
                near: Some(Rational::new())
            }
        );
    }
}

#[test]
fn no_extinction_needs_an_emission() {
    let error = refused(&format!("{HEAD}depth = \"0\"\nradiance = \"0\""));
    assert!(
        matches!(error, ManufactureError::NoExtinction { .. }),
        "{error}"
    );
    let error = refused(&format!(
        "{HEAD}depth = \"piecewise(lambda < 1/2, lambda, 1/2)\"\nradiance = \"1 - exp(-min(lambda, 1/2))\""
    ));
    assert_eq!(
        error,
        ManufactureError::NoExtinction {
            from: "1/2".parse().unwrap()
        }
    );
}

#[test]
fn fields_need_inverses_and_polynomials_end() {
    let mut without = description(catalogue::text("square-root-field").unwrap());
    without.inverse = None;
    let error = manufacture(&without).unwrap_err();
    assert!(
        matches!(error, ManufactureError::NoInverse { .. }),
        "{error}"
    );
    let endless = format!("{HEAD}depth = \"lambda\"\nemission_of_depth = \"exp(-t)\"");
    assert!(matches!(
        refused(&endless),
        ManufactureError::NotPolynomial { .. }
    ));
    // With a claimed radiance it need not end.
    let claimed = format!("{endless}\nradiance = \"(1 - exp(-2*lambda))/2\"");
    assert!(made(&claimed)[0].is_proved());
}

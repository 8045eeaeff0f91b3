//! The oracle: as many digits as it says, from closed forms and without them.

mod attack;
mod chebyshev;
mod enclosure;
mod singular;

use rayon::prelude::*;
use rug::Float;
use volver::case::manufacture::{Manufactured, Statement, manufacture};
use volver::case::{Case, Description, Recipe, SymbolicCase, catalogue};
use volver::reference::{
    Reference, ReferenceError, Source, enclosed_radiance, estimated_radiance, optical_depth,
    radiance,
};

fn made(text: &str) -> Manufactured {
    let description = Description::read(text).unwrap();
    manufacture(&description).unwrap().remove(0)
}

/// A medium without a closed form on [0, 1].
fn medium(extinction: &str, emission: &str) -> SymbolicCase {
    medium_of("1", extinction, emission)
}

fn medium_of(length: &str, extinction: &str, emission: &str) -> SymbolicCase {
    let text = format!(
        "name = 'a'\nlength = '{length}'\nextinction = '{extinction}'\nemission = '{emission}'"
    );
    made(&text).case
}

fn bits(digits: u32) -> u32 {
    u32::try_from((u64::from(digits) * 3322).div_ceil(1000)).unwrap() + 1
}

fn distance(a: &Float, b: &Float) -> Float {
    Float::with_val(64, a - b).abs()
}

/// Whether the spectral value has the digits asked for and no more than it says.
fn agrees(case: &SymbolicCase, digits: u32) {
    let name = case.name();
    let exact = radiance(case, bits(2 * digits)).unwrap();
    assert_eq!(exact.source, Source::ClosedForm, "{name}");
    let found = estimated_radiance(case, bits(digits)).unwrap();
    assert_eq!(found.source, Source::Spectral);
    let error = distance(&found.value, &exact.value);
    assert!(
        error <= found.error,
        "{name}: {error} above {}",
        found.error
    );
    let allowed = Float::with_val(64, exact.value.abs_ref()) >> bits(digits);
    assert!(error <= allowed, "{name}: {error}");
    assert!(
        found.digits().is_none_or(|believed| believed >= digits),
        "{name}"
    );
    assert!(exact.error <= allowed, "{name}");
}

/// Whether the enclosure has the closed form's value within.
fn encloses(case: &SymbolicCase, digits: u32) {
    let name = case.name();
    let exact = radiance(case, bits(2 * digits)).unwrap();
    let enclosed = enclosed_radiance(case, bits(digits)).unwrap();
    let error = distance(&enclosed.value, &exact.value);
    assert!(exact.is_enclosed() && enclosed.is_enclosed(), "{name}");
    assert!(
        error <= Float::with_val(64, &enclosed.error + &exact.error),
        "{name}: {error} above {}",
        enclosed.error
    );
}

fn of_catalogue() -> Vec<Manufactured> {
    let names: Vec<&str> = catalogue::names().collect();
    let of_name = |name: &&str| manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap();
    names.par_iter().flat_map(of_name).collect()
}

#[test]
fn all_closed_forms_are_found_again_to_50_digits() {
    let made = of_catalogue();
    assert!(made.len() >= 50);
    made.par_iter().for_each(|made| {
        agrees(&made.case, 50);
        encloses(&made.case, 50);
    });
}

#[test]
fn kinks_jumps_roots_and_spikes_have_500_digits() {
    [
        "square-root-edge",
        "jump-moving",
        "kink-off-node",
        "tent",
        "vacuum-gap",
        "sine-squared",
        "thick-back",
        "transfer-window",
    ]
    .par_iter()
    .for_each(|name| {
        let description = catalogue::find(name).unwrap().unwrap();
        agrees(&manufacture(&description).unwrap().remove(0).case, 500);
    });
}

/// [`Float`]s of the fixture: I(D) and t(D).
fn fixture() -> [Float; 2] {
    let text = include_str!("../data/gaussian_over_sine.txt");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    [(); 2].map(|()| {
        let line = lines.next().unwrap();
        Float::with_val(480, Float::parse(line).unwrap())
    })
}

#[test]
fn a_medium_without_a_closed_form_agrees_with_nested_quadrature() {
    let case = medium("2 + sin(10*s^2)", "exp(-s^2)");
    let [light, depth] = fixture();
    let found = radiance(&case, bits(100)).unwrap();
    assert_eq!(found.source, Source::Enclosure);
    let error = distance(&found.value, &light);
    assert!(error <= found.error);
    assert!(error < Float::with_val(64, Float::parse("1e-100").unwrap()));
    assert!(found.digits().unwrap() >= 100);
    let found = optical_depth(&case, bits(100)).unwrap();
    assert!(distance(&found.value, &depth) <= found.error);
    assert!(found.digits().unwrap() >= 100);
}

#[test]
fn every_point_is_sampled_once_and_every_exponential_taken_once() {
    let case = medium("2 + sin(10*s^2)", "exp(-s^2)");
    let work = estimated_radiance(&case, bits(100)).unwrap().work;
    // 257 points: a sine, an exponential; their light on 513: an exponential. No cosine but by √.
    assert_eq!((work.panels, work.points, work.evaluations), (1, 257, 257));
    assert_eq!(work.transcendental_calls, 2 * 257 + 513);
    // A break inside: its value is never asked for, on neither side.
    let jump = medium("piecewise(s < 1/3, 1, 2)", "1");
    let work = estimated_radiance(&jump, bits(30)).unwrap().work;
    assert_eq!((work.panels, work.points, work.evaluations), (2, 66, 64));
    // Between two breaks, neither end: the polynomial through the others has both.
    let slab = medium("piecewise(s < 1/4, 1, s < 3/4, 2 + s^5, 1)", "1");
    let work = estimated_radiance(&slab, bits(30)).unwrap().work;
    assert_eq!((work.panels, work.points, work.evaluations), (3, 99, 95));
}

#[test]
fn what_nobody_told_of_is_found_in_the_formulas() {
    // A root at the far end, a corner and a jump that the structure does not know.
    let plain = |extinction: &str, emission: &str, length: &str| {
        let text = |t: &str| t.parse().unwrap();
        let formulas = volver::case::Formulas {
            field: text("lambda"),
            extinction: text(extinction),
            emission: text(emission),
            optical_depth: None,
            radiance: None,
        };
        let length = length.parse().unwrap();
        SymbolicCase::new("a", length, formulas, volver::case::Structure::default()).unwrap()
    };
    let one_minus_exp = |t: Float| -(-t).exp_m1();
    let number = |q: (u32, u32)| Float::with_val(200, q.0) / q.1;
    for (case, depth) in [
        // ∫ √(1 − u) = 2/3.
        (plain("sqrt(1 - s)", "1", "1"), number((2, 3))),
        // ∫ |u − 1/π| = (1/π² + (1 − 1/π)²)/2.
        (plain("abs(s - 1/pi)", "1", "1"), {
            let b = Float::with_val(200, rug::float::Constant::Pi).recip();
            let rest = Float::with_val(200, 1 - &b);
            (b.square() + rest.square()) / 2_u32
        }),
        // 1/3 + 3·2/3.
        (plain("piecewise(s < 1/3, 1, 3)", "1", "1"), number((7, 3))),
        (plain("piecewise(s < 1/2, 1, 3)", "1", "1"), number((2, 1))),
    ] {
        let found = estimated_radiance(&case, bits(30)).unwrap();
        let error = distance(&found.value, &one_minus_exp(depth));
        assert!(error <= found.error, "{error} {}", found.error);
        assert!(found.digits().unwrap() >= 30);
        assert!(found.work.panels <= 2, "{:?}", found.work);
    }
}

#[test]
fn light_in_front_of_much_extinction_is_seen_and_none_behind_it() {
    // I = 1 − e^(−10¹²), to all digits 1.
    let thick = radiance(&medium("1000000000000", "1"), bits(30)).unwrap();
    assert!(distance(&thick.value, &Float::with_val(64, 1)) <= thick.error);
    // ∫ (1 − λ) K e^(−Kλ) = 1 − (1 − e^(−K))/K.
    let falling = radiance(&medium("1000", "1 - s"), bits(30)).unwrap();
    let k = Float::with_val(200, 1000);
    let expected = 1 - -Float::with_val(200, -&k).exp_m1() / k;
    assert!(distance(&falling.value, &expected) <= falling.error);
    let hidden = medium(
        "piecewise(s < 1/2, 4000000000, 1)",
        "piecewise(s < 1/2, 0, 1)",
    );
    let error = radiance(&hidden, bits(20)).unwrap_err();
    assert!(
        matches!(error, ReferenceError::OracleUnderflow { .. }),
        "{error}"
    );
    // Half as thick it is far below binary64, and right: e^(−10⁸)(1 − e^(−1/2)).
    let dim = medium(
        "piecewise(s < 1/2, 200000000, 1)",
        "piecewise(s < 1/2, 0, 1)",
    );
    let found = radiance(&dim, bits(20)).unwrap();
    let expected = Float::with_val(200, -100_000_000).exp() * -Float::with_val(200, -0.5).exp_m1();
    assert!(distance(&found.value, &expected) <= found.error);
    assert!(found.digits().unwrap() >= 20);
}

#[test]
fn nothing_is_exactly_nothing() {
    let dark = radiance(&medium("1 + s", "0"), bits(30)).unwrap();
    assert!(dark.value.is_zero() && dark.error.is_zero());
    assert_eq!(dark.digits(), None);
}

#[test]
fn what_is_no_medium_is_refused() {
    let plain = |extinction: &str, emission: &str| -> Result<Reference, ReferenceError> {
        let text = |t: &str| t.parse().unwrap();
        let formulas = volver::case::Formulas {
            field: text("lambda"),
            extinction: text(extinction),
            emission: text(emission),
            optical_depth: None,
            radiance: None,
        };
        let structure = volver::case::Structure::default();
        let case = SymbolicCase::new("a", 1.into(), formulas, structure).unwrap();
        radiance(&case, bits(20))
    };
    for (extinction, emission) in [("1/s", "1"), ("1", "ln(s)"), ("sqrt(s - 2)", "1")] {
        let error = plain(extinction, emission).unwrap_err();
        assert!(
            matches!(error, ReferenceError::MediumNotFinite { .. }),
            "{error}"
        );
    }
    // The second between the points of any estimate.
    for extinction in ["s - 1/2", "1 - 3*exp(-((s - 0.14154)/0.0000001)^2)"] {
        let error = plain(extinction, "1").unwrap_err();
        assert!(
            matches!(error, ReferenceError::NegativeExtinction { .. }),
            "{error}"
        );
    }
    let error = plain("1 + sin(1000000*s)", "1").unwrap_err();
    assert!(
        matches!(error, ReferenceError::NotResolved { .. }),
        "{error}"
    );
    assert!(error.to_string().contains(" near lambda = 0"), "{error}");
    for bits in [0, 1, 1 << 20] {
        let error = radiance(&medium("1", "1"), bits).unwrap_err();
        assert_eq!(error, ReferenceError::Bits { bits });
    }
}

#[test]
fn media_in_files_are_checked_and_never_proved() {
    let text = "name = 'a'\nlength = 1\nextinction = 'max(0, s - 1/2)'\nemission = '1 - s'";
    assert_eq!(Description::read(text).unwrap().recipe(), Recipe::Medium);
    let made = made(text);
    assert!(!made.has_closed_form() && !made.is_proved() && made.suits_kernels());
    let statements: Vec<Statement> = made.checks.iter().map(|check| check.statement).collect();
    assert_eq!(
        statements,
        [
            Statement::FieldDefined,
            Statement::ExtinctionDefined,
            Statement::ExtinctionNonNegative,
            Statement::EmissionDefined,
            Statement::EmissionNonNegative,
        ]
    );
    let breaks = made.case.structure().breaks;
    assert_eq!(breaks[0].part, Some((1, 2).into()));
    let error = |text: &str| manufacture(&Description::read(text).unwrap()).unwrap_err();
    let negative = error("name = 'a'\nlength = 1\nextinction = 's - 1/2'\nemission = '1'");
    assert!(
        negative.to_string().starts_with("tau >= 0 fails"),
        "{negative}"
    );
    let half = "name = 'a'\nlength = 1\nextinction = '1'\nemission = '1'\ndepth = 'lambda'";
    let half = Description::read(half).unwrap_err().to_string();
    assert!(half.contains("'radiance' missing beside"), "{half}");
    assert!(half.contains("or extinction and emission alone"), "{half}");
}

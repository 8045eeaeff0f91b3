//! Orders on the whole catalogue, in exact arithmetic as good as.

use super::{POSITIONS, case, compositing, front_to_back, made, slab};
use rug::Float;
use volver::case::{Case, Fresh, catalogue};
use volver::convergence::{Verdict, fit};
use volver::method::{
    Accumulation, CompositingOrder, Expected, Method, OpacityFormula, Part, Position, Summation,
    expected, expected_on,
};
use volver::real::{Format, Mpfr, Real};
use volver::study::{Run, Silent, samples};

const LADDER: [u64; 9] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048];
/// Errors of order 2 are some 2⁻²² of the radiance at 2048 segments, far above the floor of 2⁻⁸¹.
const FORMAT: Mpfr = Mpfr { bits: 96 };

fn method(position: Position, opacity: OpacityFormula, order: CompositingOrder) -> Method {
    Method::Composited(compositing(position, opacity, order))
}

/// One variant of each approximation.
fn methods() -> Vec<Method> {
    let depths = front_to_back(Accumulation::Depths, Summation::Naive);
    let families = [
        (OpacityFormula::Expm1, CompositingOrder::Tree),
        (OpacityFormula::Linear, CompositingOrder::BackToFront),
        (OpacityFormula::Linear, depths),
    ];
    let each = |position| families.map(|(opacity, order)| method(position, opacity, order));
    POSITIONS.into_iter().flat_map(each).collect()
}

/// S(0) − T(D) S(D) − τ(0) I, twice the coefficient of d for samples at the fronts.
fn end_samples<C: Case>(case: &C) -> f64 {
    let (front, back) = (FORMAT.int(0), FORMAT.ratio(&case.length()));
    let [at_front, at_back] = [&front, &back].map(|place| case.transfer(&case.field(place)));
    let attenuation = (-case.optical_depth(&back).unwrap()).exp();
    let seen = case.radiance(&back).unwrap() * &at_front.extinction;
    let source = at_front.emission * &at_front.extinction;
    let difference = source - &(at_back.emission * &at_back.extinction * &attenuation) - &seen;
    Float::from(difference).to_f64()
}

fn error<C: Case>(method: &Method, case: &C, n: u64) -> f64 {
    let exact = case.radiance(&FORMAT.ratio(&case.length())).unwrap();
    let radiance = method.radiance(&Fresh::new(case, FORMAT), n).unwrap();
    Float::from(radiance - &exact).to_f64()
}

/// Whether a verdict on a case without breaks bears theory out, or is none.
fn bears_out(verdict: Verdict, theory: Expected, last: f64) -> bool {
    match (verdict, theory) {
        // A small leading coefficient: the finest pair of levels tells, if anything does.
        (Verdict::PreAsymptotic, _) => true,
        (Verdict::Blind, Expected::Blind { here, .. }) => (last - here).abs() < 0.05,
        _ => verdict.passes(Some(theory)),
    }
}

#[test]
fn smooth_cases_show_the_orders_expected() {
    let (mut confirmed, mut all) = (0, 0);
    for case in catalogue::names().flat_map(made) {
        if !case.structure().breaks.is_empty() {
            continue;
        }
        let methods = methods();
        let run = Run::new(&case, FORMAT, &methods, &LADDER, &Silent).unwrap();
        for (m, method) in methods.iter().enumerate() {
            let theory = expected_on(method, &case, &LADDER);
            assert_eq!(theory, expected(method, &case));
            let fit = fit(&samples(&case, &run, m, None).unwrap(), Some(theory)).unwrap();
            let last = fit.pairs.last().map_or(f64::NAN, |pair| pair.order);
            // Exact but for what is left of the transmittance, here below the floor of 2⁻⁸¹: where C is constant, and where
            // it is linear and τ the same everywhere for linear opacities with samples at the back, Σ x (1 − x)ⁱ x (i + 1) = 1.
            let depth = case.optical_depth(&case.length().to_f64()).unwrap();
            if depth > 60.0 && error(method, &case, 2048).abs() < 2_f64.powi(-80) {
                continue;
            }
            all += 1;
            confirmed += u32::from(fit.verdict.passes(Some(theory)));
            // Not 0, but too small to be seen beside the next order.
            let small = fit.verdict == Verdict::TooHigh && {
                let leading = end_samples(&case) * case.length().to_f64() / 2.0 / 2048.0;
                leading.abs() < 0.01 * error(method, &case, 2048).abs()
            };
            assert!(
                small || bears_out(fit.verdict, theory, last),
                "{method} on {}: {theory:?}, {} of {last}",
                case.name(),
                fit.verdict
            );
        }
    }
    println!("{confirmed} of {all} confirmed");
    assert!(confirmed * 10 >= all * 8, "{confirmed} of {all}");
}

/// Breaks move within their segments from level to level: the largest errors of neighbouring levels tell.
#[test]
fn broken_cases_show_the_orders_expected() {
    let (coarse, fine) = (256..264, 2048..2056);
    let ladder: Vec<u64> = coarse.chain(fine).collect();
    for case in catalogue::names().flat_map(made) {
        if case.structure().breaks.is_empty() {
            continue;
        }
        let methods = methods();
        let run = Run::new(&case, FORMAT, &methods, &ladder, &Silent).unwrap();
        for (m, method) in methods.iter().enumerate() {
            let Expected::Order(expected) = expected(method, &case) else {
                continue;
            };
            let samples = samples(&case, &run, m, None).unwrap();
            let errors: Vec<f64> = samples.iter().map(|s| s.error.to_f64().abs()).collect();
            let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max).log2();
            let order = (largest(&errors[..8]) - largest(&errors[8..])) / 3.0;
            assert!(
                (order - expected).abs() < 0.25,
                "{method} on {}: {order}",
                case.name()
            );
        }
    }
}

#[test]
fn a_jump_on_a_node_is_harmless_to_samples_in_the_middle_alone() {
    let jump = case("jump-on-node");
    let even = [64, 128, 256];
    let middle = method(
        Position::Middle,
        OpacityFormula::Relative,
        CompositingOrder::Tree,
    );
    let front = method(
        Position::Front,
        OpacityFormula::Relative,
        CompositingOrder::Tree,
    );
    assert_eq!(expected_on(&middle, &jump, &even), Expected::Order(2.0));
    assert_eq!(expected(&middle, &jump), Expected::Order(1.0));
    assert_eq!(expected_on(&front, &jump, &even), Expected::Order(1.0));
    let ratio = error(&middle, &jump, 128) / error(&middle, &jump, 256);
    assert!((ratio.log2() - 2.0).abs() < 0.02, "{ratio}");
    let odd = error(&middle, &jump, 129) / error(&middle, &jump, 257);
    assert!((odd.log2() - 1.0).abs() < 0.05, "{odd}");
}

/// The coefficients derived in `Compositing::limits`' module, where these have a closed form.
#[test]
fn the_leading_error_is_the_one_derived() {
    for name in [
        "sine-squared",
        "atmosphere",
        "rational-radiance",
        "linear-transfer",
    ] {
        let case = case(name);
        let first = end_samples(&case) * case.length().to_f64() / 2.0;
        for (position, sign) in [(Position::Front, 1.0), (Position::Back, -1.0)] {
            let method = method(
                position,
                OpacityFormula::Expm1,
                CompositingOrder::BackToFront,
            );
            // Extrapolated once, which leaves O(d²).
            let [coarse, fine] = [1024, 2048].map(|n: u64| error(&method, &case, n) * n as f64);
            let found = 2.0 * fine - coarse;
            assert!(
                (found / (sign * first) - 1.0).abs() < 1e-3,
                "{method} on {name}: {found} {first}"
            );
        }
    }
}

#[test]
fn what_is_exact_has_no_limits() {
    for opacity in super::EXACT_OPACITIES {
        for position in POSITIONS {
            let constant = method(position, opacity, CompositingOrder::Tree);
            assert_eq!(expected(&constant, &slab()), Expected::Exact);
        }
    }
    let linear = method(
        Position::Middle,
        OpacityFormula::Linear,
        CompositingOrder::Tree,
    );
    let limits = linear.limits(&slab());
    assert_eq!(
        limits.iter().map(|limit| limit.part).collect::<Vec<_>>(),
        [Part::LinearOpacity]
    );
    assert_eq!(expected(&linear, &slab()), Expected::Order(1.0));
}

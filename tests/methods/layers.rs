//! Layer rules: by their definitions, exact where they should be, and of the orders that theory gives.

use rug::Float;
use volver::case::manufacture::{Manufactured, manufacture};
use volver::case::{Case, Description, Fresh, SymbolicCase, catalogue};
use volver::convergence::{Verdict, fit};
use volver::method::{Expected, Layers, Method, MethodError, expected, expected_on};
use volver::real::special::{linear_in_depth, logarithmic_mean};
use volver::real::{Format, Mpfr, Native, Real};
use volver::study::{Run, Silent, samples};

const LADDER: [u64; 9] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048];
/// Errors of order 2 are some 2⁻²² of the radiance at 2048 layers, far above the floor of 2⁻⁸¹.
const FORMAT: Mpfr = Mpfr { bits: 96 };

fn made(name: &str) -> Vec<SymbolicCase> {
    let made: Vec<Manufactured> = manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap();
    made.into_iter().map(|made| made.case).collect()
}

/// A ray by its extinction and emission, whose radiance is known.
fn ray(extinction: &str, emission: &str, depth: &str, radiance: &str) -> SymbolicCase {
    let file = format!(
        "name = \"ray\"\nlength = 1\nextinction = \"{extinction}\"\nemission = \"{emission}\"\n\
         depth = \"{depth}\"\nradiance = \"{radiance}\"\n"
    );
    let description = Description::read(&file).unwrap();
    manufacture(&description).unwrap().remove(0).case
}

fn all() -> impl Iterator<Item = Method> {
    Layers::ALL.into_iter().map(Method::Layered)
}

fn error<C: Case>(layers: Layers, case: &C, n: u64, format: Mpfr) -> Float {
    let exact = case.radiance(&format.ratio(&case.length())).unwrap();
    let radiance = layers.radiance(&Fresh::new(case, format), n).unwrap();
    Float::from(radiance - &exact).abs()
}

/// The definitions, from the back to the front as formal solutions are written.
fn by_hand(layers: Layers, case: &SymbolicCase, n: u32) -> f64 {
    let d = case.length().to_f64() / f64::from(n);
    let at = |half_steps: u32| {
        let value = case.transfer(&case.field(&(d * f64::from(half_steps) / 2.0)));
        (value.extinction, value.emission)
    };
    let mut radiance = 0.0;
    for i in (0..n).rev() {
        let ((tf, cf), (tm, cm), (tb, cb)) = (at(2 * i), at(2 * i + 1), at(2 * i + 2));
        let ends = d * (tf + tb) / 2.0;
        let mean = |x: f64| {
            if x == 0.0 {
                1.0
            } else {
                (1.0 - (-x).exp()) / x
            }
        };
        let opacity = 1.0 - (-ends).exp();
        let (x, light) = match layers {
            Layers::Linear => (
                ends,
                (1.0 - mean(ends)) * cf + (mean(ends) - (-ends).exp()) * cb,
            ),
            Layers::Mean => (ends, opacity * (cf + cb) / 2.0),
            Layers::Logarithmic if cf == cb => (ends, opacity * cf),
            Layers::Logarithmic => (ends, opacity * (cb - cf) / (cb / cf).ln()),
            Layers::HalfCells => {
                let (near, far) = ((-tf * d / 2.0).exp(), (-tb * d / 2.0).exp());
                (ends, (1.0 - near) * cf + near * (1.0 - far) * cb)
            }
            Layers::Middle => (ends, d * tm * cm * (-ends / 2.0).exp()),
            Layers::HalfOwn => (tm * d, d * tm * cm * (-tm * d / 2.0).exp()),
            Layers::WholeOwn => (tm * d, d * tm * cm * (-tm * d).exp()),
        };
        radiance = light + (-x).exp() * radiance;
    }
    radiance
}

#[test]
fn rules_are_their_definitions() {
    let mut values = Vec::new();
    for name in ["thick", "cloud", "linear-transfer", "emission-bump"] {
        for case in made(name) {
            for layers in Layers::ALL {
                let radiance = layers.radiance(&Fresh::new(&case, Native::<f64>::new()), 13);
                let (radiance, wanted) = (radiance.unwrap(), by_hand(layers, &case, 13));
                let difference = (radiance - wanted).abs();
                assert!(
                    difference <= 1e-13 * wanted.abs(),
                    "{layers} on {name}: {difference}"
                );
                values.push(radiance);
            }
        }
    }
    // No two of them are one.
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    assert!(values.len() >= 4 * Layers::ALL.len() - 3, "{values:?}");
}

#[test]
fn where_a_model_is_the_medium_all_digits_are_right() {
    let format = Mpfr { bits: 400 };
    // τ is linear along the ray, and C the same everywhere.
    let constant = ray(
        "1 + s",
        "3",
        "lambda + lambda^2/2",
        "3 - 3*exp(-lambda - lambda^2/2)",
    );
    // C is linear in the depth, which is linear along the ray.
    let linear = ray(
        "2",
        "1 + s",
        "2*lambda",
        "3/2 - (3/2 + lambda)*exp(-2*lambda)",
    );
    for layers in Layers::ALL {
        let of_constant = error(layers, &constant, 7, format);
        let of_linear = error(layers, &linear, 7, format);
        let ends = !matches!(layers, Layers::Middle | Layers::HalfOwn | Layers::WholeOwn);
        assert_eq!(of_constant < 1e-60, ends, "{layers}: {of_constant}");
        assert_eq!(
            of_linear < 1e-60,
            layers == Layers::Linear,
            "{layers}: {of_linear}"
        );
        let method = Method::Layered(layers);
        assert_eq!(expected(&method, &constant) == Expected::Exact, ends);
        assert_eq!(
            expected(&method, &linear) == Expected::Exact,
            layers == Layers::Linear
        );
    }
}

#[test]
fn orders_in_general_are_these() {
    for layers in Layers::ALL {
        let order = match layers {
            Layers::WholeOwn => Expected::Order(1.0),
            Layers::Logarithmic => Expected::Unknown,
            _ => Expected::Order(2.0),
        };
        assert_eq!(Method::Layered(layers).order(), order, "{layers}");
    }
}

/// Whether a verdict on a case without breaks bears theory out, or is none.
fn bears_out(verdict: Verdict, theory: Expected, last: f64) -> bool {
    match (verdict, theory) {
        // A small leading coefficient: the finest pair of levels tells, if anything does.
        (Verdict::PreAsymptotic, _) | (_, Expected::Unknown) => true,
        (Verdict::Blind, Expected::Blind { here, .. }) => (last - here).abs() < 0.05,
        _ => verdict.passes(Some(theory)),
    }
}

#[test]
fn smooth_cases_show_the_orders_expected() {
    let (mut confirmed, mut told) = (0, 0);
    let mut contradicted = Vec::new();
    for case in catalogue::names().flat_map(made) {
        if !case.structure().breaks.is_empty() {
            continue;
        }
        let methods: Vec<Method> = all().collect();
        let run = Run::new(&case, FORMAT, &methods, &LADDER, &Silent).unwrap();
        for (m, method) in methods.iter().enumerate() {
            let theory = expected_on(method, &case, &LADDER);
            assert_eq!(theory, expected(method, &case));
            let Ok(samples) = samples(&case, &run, m, None) else {
                // Signs differ.
                assert_eq!(theory, Expected::Unknown, "{method} on {}", case.name());
                continue;
            };
            let fit = fit(&samples, Some(theory)).unwrap();
            let last = fit.pairs.last().map_or(f64::NAN, |pair| pair.order);
            if theory != Expected::Unknown {
                told += 1;
                confirmed += u32::from(fit.verdict.passes(Some(theory)));
            }
            if !bears_out(fit.verdict, theory, last) {
                let name = case.name();
                contradicted.push(format!(
                    "{method} on {name}: {theory:?}, {} of {last}",
                    fit.verdict
                ));
            }
        }
    }
    println!("{confirmed} of {told} confirmed");
    assert!(contradicted.is_empty(), "{}", contradicted.join("\n"));
    assert!(confirmed * 10 >= told * 8, "{confirmed} of {told}");
}

/// Breaks move within their layers from level to level: the largest errors of neighbouring levels tell.
#[test]
fn broken_cases_show_the_orders_expected() {
    let (coarse, fine) = (256..264, 2048..2056);
    let ladder: Vec<u64> = coarse.chain(fine).collect();
    let mut contradicted = Vec::new();
    let mut told = 0;
    for case in catalogue::names().flat_map(made) {
        if case.structure().breaks.is_empty() {
            continue;
        }
        let methods: Vec<Method> = all().collect();
        let run = Run::new(&case, FORMAT, &methods, &ladder, &Silent).unwrap();
        for (m, method) in methods.iter().enumerate() {
            let Expected::Order(expected) = expected(method, &case) else {
                continue;
            };
            told += 1;
            let samples = samples(&case, &run, m, None).unwrap();
            let errors: Vec<f64> = samples.iter().map(|s| s.error.to_f64().abs()).collect();
            let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max).log2();
            let order = (largest(&errors[..8]) - largest(&errors[8..])) / 3.0;
            if (order - expected).abs() >= 0.25 {
                contradicted.push(format!(
                    "{method} on {}: {order}, not {expected}",
                    case.name()
                ));
            }
        }
    }
    assert!(contradicted.is_empty(), "{}", contradicted.join("\n"));
    assert!(told >= 50, "{told}");
}

#[test]
fn the_logarithmic_mean_has_order_2_where_there_is_emission_and_no_number_where_signs_differ() {
    let methods = [Method::Layered(Layers::Logarithmic)];
    let theory = |name: &str| expected(&methods[0], &made(name)[0]);
    assert_eq!(theory("thick"), Expected::Order(2.0));
    // C is 0 at the front.
    assert_eq!(theory("sine-squared"), Expected::Unknown);
    assert_eq!(theory("emission-cubic"), Expected::Unknown);
    for name in ["linear-transfer", "thick", "rgb-transfer"] {
        for case in made(name) {
            let run = Run::new(&case, FORMAT, &methods, &LADDER, &Silent).unwrap();
            let samples = samples(&case, &run, 0, None).unwrap();
            let fit = fit(&samples, Some(Expected::Order(2.0))).unwrap();
            let passes = fit.verdict.passes(Some(Expected::Order(2.0)));
            let is_exact = fit.verdict == Verdict::Exact;
            assert!(passes || is_exact, "{}: {}", case.name(), fit.verdict);
        }
    }
    let changing = ray(
        "1",
        "s - 1/2",
        "lambda",
        "1/2 - (lambda + 1/2)*exp(-lambda)",
    );
    let nodes = Fresh::new(&changing, Native::<f64>::new());
    assert!(Layers::Logarithmic.radiance(&nodes, 3).unwrap().is_nan());
    assert!(Layers::Mean.radiance(&nodes, 3).unwrap().is_finite());
}

#[test]
fn weights_keep_their_digits_in_thin_layers() {
    let wide = Mpfr { bits: 400 };
    for exponent in -40..6 {
        let x = 1.37 * 2_f64.powi(exponent);
        let [near, far] = linear_in_depth(&x);
        let exact = wide.binary64(x);
        let mean = -(-exact.clone()).exp_m1() / &exact;
        let wanted = [wide.int(1) - &mean, mean - &(-exact).exp()];
        for (got, wanted) in [near, far].into_iter().zip(wanted) {
            let relative = (wide.binary64(got) / &wanted - &wide.int(1))
                .to_float()
                .to_f64();
            assert!(relative.abs() < 1e-14, "{x}: {relative}");
        }
        // Of two emissions that are as close.
        let (a, b) = (3.0, 3.0 + x);
        let [wide_a, wide_b] = [a, b].map(|c| wide.binary64(c));
        let ratio = (wide_b.clone() / &wide_a).ln();
        let wanted = (wide_b - &wide_a) / &ratio;
        let relative =
            (wide.binary64(logarithmic_mean(&a, &b)) / &wanted - &wide.int(1)).to_float();
        assert!(relative.to_f64().abs() < 1e-15, "{x}");
    }
    assert_eq!(logarithmic_mean(&2.5, &2.5), 2.5);
    assert_eq!(logarithmic_mean(&0.0, &2.5), 0.0);
    assert_eq!(logarithmic_mean(&2.5, &0.0), 0.0);
    assert!(logarithmic_mean(&-1.0_f64, &2.5).is_nan());
}

#[test]
fn no_layers_are_refused() {
    let case = made("thick").remove(0);
    let nodes = Fresh::new(&case, Native::<f32>::new());
    for layers in Layers::ALL {
        let refused = layers.radiance(&nodes, 0);
        assert!(matches!(
            refused,
            Err(MethodError::Segments {
                n: 0,
                multiple: 1,
                ..
            })
        ));
        assert!(Method::Layered(layers).check_segments(1).is_ok());
    }
}

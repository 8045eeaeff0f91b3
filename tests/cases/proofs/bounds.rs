//! Measured errors of nested rules stay below the proved constants, at every level.

use super::rules::panel_constant;
use rayon::prelude::*;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};
use std::sync::LazyLock;
use volver::case::manufacture::{Manufactured, manufacture};
use volver::case::{Case, catalogue};
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::Rule;
use volver::real::Mpfr;
use volver::study::{Run, Silent, samples};
use volver::symbolic::{Expr, Program, Range, Taylor, taylor};

const RULES: [Rule; 9] = [
    Rule::RiemannLeft,
    Rule::RiemannRight,
    Rule::Midpoint,
    Rule::Trapezoid,
    Rule::Simpson,
    Rule::Boole,
    Rule::GaussLegendre(2),
    Rule::GaussLegendre(3),
    Rule::GaussLegendre(5),
];
const LADDER: [u64; 6] = [4, 8, 16, 32, 64, 128];
const BITS: u32 = 200;
/// Parts of the ray over which derivatives are enclosed: finer parts, tighter bounds.
const PANELS: u32 = 256;

/// sup |τ⁽ᵏ⁾| and sup |F⁽ᵏ⁾| on [0, D] for F = C τ e^(−t), and sup |C τ|; infinite where intervals do not tell.
struct Derivatives {
    extinction: Vec<f64>,
    integrand: Vec<f64>,
    source: f64,
    /// sup τ.
    most: f64,
}

impl Derivatives {
    fn of(case: &Manufactured, order: u32) -> Option<Self> {
        let depth = case.case.formulas().optical_depth.as_ref()?;
        let source = Expr::product([case.emission.clone(), case.extinction.clone()]);
        let transmittance = (-depth).exp();
        let integrand = Expr::product([source.clone(), transmittance]);
        let outputs = [case.extinction.clone(), integrand, source];
        let program = Program::new(&outputs, &["lambda"]).unwrap();
        let reach = case.case.length() / (2 * PANELS);
        let scale = Range::around(&reach).high;
        let mut derivatives = Derivatives {
            extinction: vec![0.0; order as usize + 1],
            integrand: vec![0.0; order as usize + 1],
            source: 0.0,
            most: 0.0,
        };
        for panel in 0..PANELS {
            let front = Range::around(&Rational::from(&reach * (2 * panel)));
            let back = Range::around(&Rational::from(&reach * (2 * panel + 2)));
            let variable = Taylor::variable(Range::new(front.low, back.high), scale);
            let series = taylor(&program, &variable, order as usize);
            let [extinction, integrand, source] = &series[..] else {
                panic!("three outputs");
            };
            let mut factor = 1.0;
            for k in 0..=order as usize {
                // Coefficient k is f⁽ᵏ⁾ rᵏ/k!; what binary64 rounds here is far below the slack of a millionth.
                if k > 0 {
                    factor *= k as f64 / Range::around(&reach).low;
                }
                let magnitude = |of: &Taylor| of.coefficient(k).magnitude() * factor * (1.0 + 1e-6);
                let larger = |a: f64, b: f64| if b.is_nan() { f64::INFINITY } else { a.max(b) };
                derivatives.extinction[k] =
                    larger(derivatives.extinction[k], magnitude(extinction));
                derivatives.integrand[k] = larger(derivatives.integrand[k], magnitude(integrand));
            }
            derivatives.source = derivatives.source.max(source.coefficient(0).magnitude());
            derivatives.most = derivatives.most.max(extinction.coefficient(0).magnitude());
        }
        Some(derivatives)
    }
}

/// The error that `nested_bound_absorbing` allows at n segments, and `linear_exponential_first_order` beside
/// it: the outer rule's share, the inner rule's, and for a linear exponential its own.
fn proved(derivatives: &Derivatives, nested: &Nested, length: &Rational, n: u64) -> Float {
    let Inner::PerSegment(inner) = nested.inner else {
        panic!("a rule per segment");
    };
    let outer = nested.outer.0;
    let (p, q) = (inner.order(), outer.order());
    let linear = nested.exponential == Exponential::Linear;
    let r = if linear { 1 } else { p.min(q) };
    let length = Float::with_val(BITS, length);
    let step = Float::with_val(BITS, &length / n);
    let group = Float::with_val(BITS, Integer::from(nested.outer.segments_multiple()).pow(q));
    // Σ |w| is 1 for all of these rules, whose weights are positive.
    let source = derivatives.source;
    let of_outer = panel_constant(outer)
        * group
        * derivatives.integrand[q as usize]
        * length.clone().pow(1 + q - r);
    let of_inner = panel_constant(inner)
        * derivatives.extinction[p as usize]
        * source
        * length.clone().pow(2 + p - r);
    let mut constant = of_outer + of_inner;
    if linear {
        let most = Float::with_val(BITS, derivatives.most);
        constant += most.square() / 2u32 * source * length.square();
    }
    constant * step.pow(r)
}

fn nested(inner: Rule, outer: Rule, exponential: Exponential) -> Nested {
    Nested {
        inner: Inner::PerSegment(inner),
        outer: Outer(outer),
        exponential,
        scope: Scope::PerSegment,
    }
}

fn methods() -> Vec<Nested> {
    let exponentials = [Exponential::Exact, Exponential::Linear].into_iter();
    let with = |exponential| {
        let pairs = RULES
            .iter()
            .flat_map(|&inner| RULES.map(|outer| (inner, outer)));
        pairs.map(move |(inner, outer)| nested(inner, outer, exponential))
    };
    exponentials.flat_map(with).collect()
}

/// A case that the theorems are about, and all methods on it: they look at the same places.
struct Measured {
    case: Manufactured,
    derivatives: Option<Derivatives>,
    run: Run,
}

/// All of them: without breaks, with a closed form, τ ≥ 0.
static CASES: LazyLock<Vec<Measured>> = LazyLock::new(|| {
    let descriptions = catalogue::names().map(|name| catalogue::find(name).unwrap().unwrap());
    let cases = descriptions.flat_map(|description| manufacture(&description).unwrap());
    let cases: Vec<Manufactured> = cases
        .filter(|case| case.case.structure().breaks.is_empty() && case.is_proved())
        .collect();
    let methods: Vec<Method> = methods().into_iter().map(Method::Nested).collect();
    let measured = |case: Manufactured| Measured {
        derivatives: Derivatives::of(&case, 10),
        run: Run::new(&case.case, Mpfr { bits: BITS }, &methods, &LADDER, &Silent).unwrap(),
        case,
    };
    cases.into_par_iter().map(measured).collect()
});

struct Tally {
    checked: usize,
    /// How close to its bound an error came.
    closest: f64,
}

fn check(measured: &Measured, exponential: Exponential) -> Tally {
    let Measured {
        case,
        derivatives,
        run,
    } = measured;
    let mut tally = Tally {
        checked: 0,
        closest: 0.0,
    };
    let Some(derivatives) = derivatives else {
        return tally;
    };
    // 0 for a vacuum, where every method is exact.
    let tiny = Float::with_val(BITS, 1) >> (BITS - 40);
    for (index, method) in methods().iter().enumerate() {
        if method.exponential != exponential {
            continue;
        }
        for sample in samples(&case.case, run, index, None).unwrap() {
            let n = sample.n.unwrap();
            // 1 − x is an attenuation for x in [0, 1] alone.
            let length = case.case.length();
            let step = Rational::from(&length / n).to_f64();
            if exponential == Exponential::Linear && derivatives.most * step > 1.0 {
                continue;
            }
            let bound = proved(derivatives, method, &length, n);
            if !bound.is_finite() {
                continue;
            }
            let error = sample.error.abs();
            let name = case.case.name();
            assert!(
                error <= Float::with_val(BITS, &bound + &tiny),
                "{name}: {method} at n = {n}: {error:.3e} > {bound:.3e}"
            );
            tally.checked += 1;
            if bound > tiny {
                tally.closest = tally.closest.max((error / bound).to_f64());
            }
        }
    }
    tally
}

fn check_all(exponential: Exponential) -> (usize, Vec<(String, Tally)>) {
    let tallies = CASES.par_iter().map(|measured| {
        let name = measured.case.case.name().to_string();
        (name, check(measured, exponential))
    });
    let tallies: Vec<_> = tallies.collect();
    for (name, tally) in &tallies {
        println!(
            "{name:<24} {:>5} errors, closest {:.3}",
            tally.checked, tally.closest
        );
    }
    (CASES.len(), tallies)
}

#[test]
fn errors_stay_below_the_proved_bounds() {
    let (cases, tallies) = check_all(Exponential::Exact);
    let bounded = tallies
        .iter()
        .filter(|(_, tally)| tally.checked > 0)
        .count();
    assert!(cases >= 42);
    assert_eq!(bounded, cases);
    let everything = RULES.len() * RULES.len() * LADDER.len();
    let whole = tallies
        .iter()
        .filter(|(_, tally)| tally.checked == everything);
    assert_eq!(whole.count(), bounded);
    // Sharp constants are nearly reached where derivatives are nearly constant: these bounds can be broken.
    let closest = tallies.iter().map(|(_, tally)| tally.closest);
    assert!(closest.fold(0.0, f64::max) > 0.99);
}

#[test]
fn errors_under_a_linear_exponential_stay_below_theirs() {
    let (cases, tallies) = check_all(Exponential::Linear);
    // On these a segment of the finest level is still deeper than 1.
    let too_deep = ["long-ray", "deep-growing", "deep-rise", "deep-wall"];
    for (name, tally) in &tallies {
        let is_deep = name
            .split('/')
            .next()
            .is_some_and(|case| too_deep.contains(&case));
        assert_eq!(tally.checked == 0, is_deep, "{name}");
    }
    assert_eq!(tallies.len(), cases);
    let closest = tallies.iter().map(|(_, tally)| tally.closest);
    assert!(closest.fold(0.0, f64::max) > 0.99);
}

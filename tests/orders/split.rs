//! Errors are split into the parts that the definitions name, by another route.

mod branches;
mod exact;
mod many_bits;
mod stops;

use exact::{Attenuation, Medium};
use quickcheck::{Arbitrary, Gen};
use rug::{Float, Rational};
use volver::case::manufacture::manufacture;
use volver::case::random::RandomCase;
use volver::case::{Case, Fresh, Nodes, Number, SymbolicCase};
use volver::convergence::{Cell, Oracle, Split};
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::Rule;
use volver::real::{Format, FormatName, Mpfr, Real, WithFormat};

/// Bits at which Q_∞ is evaluated here: the oracle starts at 128.
const BITS: u32 = 1000;

const FORMATS: [&str; 9] = [
    "f16",
    "bf16",
    "f32",
    "f64",
    "tf32",
    "fp8-e5m2",
    "ieee:17,-126,127",
    "mpfr:40",
    "mpfr:128",
];

fn of<T: Clone>(g: &mut Gen, all: &[T]) -> T {
    g.choose(all).unwrap().clone()
}

/// One run of a random method on a random case in a random format.
#[derive(Clone, Debug)]
struct Run {
    inner: Rule,
    outer: Rule,
    attenuation: Attenuation,
    format: FormatName,
    n: u64,
}

impl Arbitrary for Run {
    fn arbitrary(g: &mut Gen) -> Run {
        let inner = [
            Rule::RiemannLeft,
            Rule::RiemannRight,
            Rule::Midpoint,
            Rule::Trapezoid,
            Rule::Simpson,
        ];
        let outer = [
            Rule::RiemannLeft,
            Rule::RiemannRight,
            Rule::Trapezoid,
            Rule::Simpson,
        ];
        let attenuation = [
            Attenuation::Linear,
            Attenuation::Quadratic,
            Attenuation::Exact,
        ];
        Run {
            inner: of(g, &inner),
            outer: of(g, &outer),
            attenuation: of(g, &attenuation),
            format: of(g, &FORMATS).parse().unwrap(),
            n: 2 * (1 + u64::arbitrary(g) % 12),
        }
    }
}

impl Run {
    fn method(&self) -> Method {
        let (exponential, scope) = match self.attenuation {
            Attenuation::Linear => (Exponential::Linear, Scope::PerSegment),
            Attenuation::Quadratic => (Exponential::Quadratic, Scope::PerSegment),
            Attenuation::Exact => (Exponential::Exact, Scope::Whole),
        };
        Method::Nested(Nested {
            inner: Inner::PerSegment(self.inner),
            outer: Outer(self.outer),
            exponential,
            scope,
        })
    }

    fn exactly(&self, medium: &Medium) -> Rational {
        exact::radiance(medium, self.inner, self.outer, self.attenuation)
    }
}

/// What the nodes of a run say, exactly; `None` where they are not finite.
fn medium<N: Nodes>(nodes: &N, n: u64) -> Option<Medium> {
    let exactly = |values: &[Number<N>]| values.iter().map(Real::to_rational).collect();
    let boundaries = nodes.boundaries(n);
    let extinction: Option<Vec<Rational>> = exactly(&boundaries.extinction);
    let emission: Option<Vec<Rational>> = exactly(&boundaries.emission);
    let middle: Option<Vec<Rational>> = exactly(&nodes.interior(n, &(1, 2).into()).extinction);
    Some(Medium {
        extinction: extinction?,
        emission: emission?,
        middle: middle?,
        step: nodes.length() / Rational::from(n),
    })
}

/// The parts by definition, in rationals.
struct Parts {
    discretization: Rational,
    input: Rational,
    arithmetic: Rational,
}

struct Both<'a> {
    run: &'a Run,
    case: &'a SymbolicCase,
}

impl WithFormat for Both<'_> {
    /// The library's cell, and the parts by definition where everything is finite.
    type Output = (Cell, Option<Parts>);

    fn run<F: Format>(self, format: F) -> Self::Output {
        let Both { run, case } = self;
        let nodes = Fresh::new(case, format);
        let oracle = Oracle::new(case, &[run.method()]);
        let cell = oracle.split(&nodes, run.n).unwrap().remove(0).unwrap();
        let parts = || {
            let here = run
                .method()
                .radiance(&nodes, run.n)
                .unwrap()
                .to_rational()?;
            let on_inputs = run.exactly(&medium(&nodes, run.n)?);
            let wide = Fresh::new(case, Mpfr { bits: BITS });
            let limit = run.exactly(&medium(&wide, run.n)?);
            let length = Mpfr { bits: BITS }.ratio(&case.length());
            let radiance = case.radiance(&length)?.to_rational()?;
            Some(Parts {
                arithmetic: here - &on_inputs,
                input: on_inputs - &limit,
                discretization: limit - radiance,
            })
        };
        (cell, parts())
    }
}

/// |part − exact| ≤ 2⁻²⁰ |exact|, or no more than what the oracle says it cannot see.
fn agrees(part: &Float, exact: &Rational, resolution: &Float) -> bool {
    let difference = (part.to_rational().unwrap() - exact).abs();
    difference <= Rational::from(exact.abs_ref()) >> 20_u32
        || difference <= resolution.to_rational().unwrap()
}

fn random_case(seed: u64) -> SymbolicCase {
    let description = RandomCase::from_seed(seed).description().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

/// For methods of + − × alone the replay in rationals is exact; with the exponential it is good to 2000 bits.
/// 25 runs on each of 64 random media: every arithmetic part, every input part and every discretization error
/// equals that by definition, in more than a thousand runs of + − × alone.
#[test]
fn the_parts_of_a_thousand_random_runs_are_those_of_an_exact_replay() {
    let g = &mut Gen::from_size_and_seed(100, 4);
    let (mut split, mut rational, mut not_finite) = (0, 0, 0);
    for seed in 0..64 {
        let case = random_case(seed);
        for _ in 0..25 {
            let run = Run::arbitrary(g);
            let (cell, parts) = run.format.with(Both {
                run: &run,
                case: &case,
            });
            match (cell, parts) {
                (Cell::Split(found), Some(exact)) => {
                    let Split {
                        resolution, bits, ..
                    } = &found;
                    for (name, part, exact) in [
                        ("arithmetic", &found.arithmetic, &exact.arithmetic),
                        ("input", &found.input, &exact.input),
                        (
                            "discretization",
                            &found.discretization,
                            &exact.discretization,
                        ),
                    ] {
                        assert!(
                            agrees(part, exact, resolution),
                            "{name} of {run:?} on seed {seed}, {bits} bits: {part} instead of {}",
                            exact.to_f64()
                        );
                    }
                    split += 1;
                    rational += u32::from(run.attenuation != Attenuation::Exact);
                }
                // FP8 overflows here and there.
                (Cell::NotFinite { total }, None) => {
                    assert!(!total.is_finite());
                    not_finite += 1;
                }
                (cell, parts) => panic!("{run:?} on seed {seed}: {cell:?}, {}", parts.is_some()),
            }
        }
    }
    println!("{split} runs split, {rational} of them of + − × alone, {not_finite} not finite");
    assert!(rational >= 1000 && not_finite < 100);
}

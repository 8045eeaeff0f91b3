//! Pre-integration against a second, plainer implementation: interpolants by Lagrange's formula, and
//! segments by 100 Gauss–Legendre points in place of closed forms and series.

use rug::{Float, Rational};
use volver::case::{Case, Fresh, PolynomialTransfer, SineSquared, Structure, Transfer};
use volver::method::{Color, Integration, Interpolant, LastSegment, Opacity, Preintegrated};
use volver::quadrature::Rule;
use volver::real::{Format, Mpfr, MpfrReal, Native, Real};

const BITS: u32 = 320;
const FORMAT: Mpfr = Mpfr { bits: BITS };

/// s = λ² + λ³/2, which no parabola is; τ = 1 + s + s²/3, C τ = 2 + s − s²/4, on [0, 3/2].
#[derive(Debug)]
struct Bowl;

fn ratio<R: Real>(x: &R, q: (i32, i32)) -> R {
    x.format().ratio(&q.into())
}

impl Case for Bowl {
    fn name(&self) -> &'static str {
        "bowl"
    }
    fn length(&self) -> Rational {
        (3, 2).into()
    }
    fn field<R: Real>(&self, lambda: &R) -> R {
        let square = lambda.clone() * lambda;
        square.clone() * lambda * &ratio(lambda, (1, 2)) + &square
    }
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let square = s.clone() * s;
        let one = s.format().int(1);
        let extinction = square.clone() * &ratio(s, (1, 3)) + s + &one;
        let source = s.format().int(2) + s - &(square * &ratio(s, (1, 4)));
        Transfer {
            emission: source / &extinction,
            extinction,
        }
    }
    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        unimplemented!("no method may look at it")
    }
    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        unimplemented!("no method may look at it")
    }
    fn structure(&self) -> Structure {
        Structure {
            field_degree: Some(3),
            transfer: Some(PolynomialTransfer {
                extinction: vec![1.into(), 1.into(), (1, 3).into()],
                source: vec![2.into(), 1.into(), (-1, 4).into()],
            }),
            ..Structure::default()
        }
    }
}

fn number(q: impl Into<Rational>) -> MpfrReal {
    FORMAT.ratio(&q.into())
}

/// Through the samples (x, s), at x.
fn lagrange(samples: &[(Rational, MpfrReal)], x: &MpfrReal) -> MpfrReal {
    let mut sum = number(0);
    for (i, (at, s)) in samples.iter().enumerate() {
        let mut term = s.clone();
        for (j, (other, _)) in samples.iter().enumerate() {
            if i != j {
                term *= &(x.clone() - &number(other.clone()));
                term /= &number(Rational::from(at - other));
            }
        }
        sum += &term;
    }
    sum
}

/// s̄ on segment j of n, at x ∈ [0, 1].
fn interpolated<C: Case>(
    case: &C,
    interpolant: Interpolant,
    (j, n): (u64, u64),
    x: &MpfrReal,
) -> MpfrReal {
    let offsets: &[(i32, i32)] = match interpolant {
        Interpolant::Linear => &[(0, 1), (1, 1)],
        Interpolant::QuadraticMidpoint => &[(0, 1), (1, 2), (1, 1)],
        Interpolant::Quadratic(LastSegment::Backward) if j + 1 == n => &[(-1, 1), (0, 1), (1, 1)],
        Interpolant::Quadratic(_) => &[(0, 1), (1, 1), (2, 1)],
    };
    let samples: Vec<_> = offsets
        .iter()
        .map(|&offset| {
            let offset = Rational::from(offset);
            let lambda = Rational::from(&offset + j) * case.length() / n;
            (offset, case.field(&number(lambda)))
        })
        .collect();
    lagrange(&samples, x)
}

/// ∫₀ˣ τ by 3 points, which suffice: along a parabola the extinctions here have degree 4.
fn depth_exactly(tau: &dyn Fn(&MpfrReal) -> MpfrReal, x: &MpfrReal) -> MpfrReal {
    by_rule(tau, Rule::GaussLegendre(3), &number(0), x)
}

fn by_rule(
    f: &dyn Fn(&MpfrReal) -> MpfrReal,
    rule: Rule,
    from: &MpfrReal,
    to: &MpfrReal,
) -> MpfrReal {
    let table = rule.table(BITS).unwrap();
    let width = to.clone() - from;
    let mut sum = number(0);
    for (node, weight) in table.nodes.iter().zip(&table.weights) {
        let x = number(node.clone()) * &width + from;
        sum += &(f(&x) * &number(weight.clone()));
    }
    sum * &width
}

/// The plain implementation: Σ C̃ᵢ ∏ α̃ⱼ.
fn plain<C: Case>(case: &C, method: &Preintegrated, n: u64) -> MpfrReal {
    let step = number(case.length() / n);
    let (mut radiance, mut transmittance) = (number(0), number(1));
    for j in 0..n {
        let tau = |interpolant| {
            let step = step.clone();
            move |x: &MpfrReal| {
                case.transfer(&interpolated(case, interpolant, (j, n), x))
                    .extinction
                    * &step
            }
        };
        let color = method.color;
        let inside = tau(color.interpolant);
        let polynomial = case.structure().transfer.is_some();
        let depth = |x: &MpfrReal| match color.integration {
            _ if !color.attenuated => number(0),
            Integration::SubIntervals { rule, count } if !polynomial => {
                depth_along_places(&inside, rule, count, x)
            }
            _ => depth_exactly(&inside, x),
        };
        let emitted = |x: &MpfrReal| {
            let transfer = case.transfer(&interpolated(case, color.interpolant, (j, n), x));
            let fall = (-depth(x)).exp();
            transfer.emission * &transfer.extinction * &fall * &step
        };
        let one = number(1);
        let emission = match color.integration {
            Integration::Closed => by_rule(&emitted, Rule::GaussLegendre(100), &number(0), &one),
            Integration::SubIntervals { count, rule } => composite(&emitted, rule, count, &one),
        };
        radiance += &(transmittance.clone() * &emission);
        let across = tau(method.opacity.interpolant);
        let segment = match method.opacity.integration {
            Integration::Closed => depth_exactly(&across, &one),
            Integration::SubIntervals { count, rule } => composite(&across, rule, count, &one),
        };
        transmittance *= &(-segment).exp();
    }
    radiance
}

/// The rule on each of `count` equal parts of [0, to].
fn composite(f: &dyn Fn(&MpfrReal) -> MpfrReal, rule: Rule, count: u32, to: &MpfrReal) -> MpfrReal {
    let mut sum = number(0);
    for i in 0..count {
        let (from, end) = (number((i, count)) * to, number((i + 1, count)) * to);
        sum += &by_rule(f, rule, &from, &end);
    }
    sum
}

/// Where nothing is known in closed form: the rule from each place of the sum over sub-intervals to
/// the next, up to x.
fn depth_along_places(
    f: &dyn Fn(&MpfrReal) -> MpfrReal,
    rule: Rule,
    count: u32,
    x: &MpfrReal,
) -> MpfrReal {
    let table = rule.table(BITS).unwrap();
    let mut places: Vec<Rational> = (0..count)
        .flat_map(|i| {
            table
                .nodes
                .iter()
                .map(move |c| Rational::from(c + i) / count)
        })
        .collect();
    places.dedup();
    let mut depth = number(0);
    let mut from = number(0);
    for place in places.into_iter().map(number) {
        if (place.clone() - x).log2_abs() > -200.0 && place > *x {
            break;
        }
        depth += &by_rule(f, rule, &from, &place);
        from = place;
    }
    depth
}

fn compare<C: Case>(case: &C, method: Preintegrated, levels: &[u64]) {
    for &n in levels {
        let ours = method.radiance(&Fresh::new(case, FORMAT), n).unwrap();
        let theirs = plain(case, &method, n);
        let off = (ours.clone() - &theirs).log2_abs() - theirs.log2_abs();
        // A few hundred roundings at most, and Gauss's own error far below.
        assert!(off < 16.0 - f64::from(BITS), "{method} on {n}: 2^{off}");
    }
}

const INTERPOLANTS: [Interpolant; 4] = [
    Interpolant::Linear,
    Interpolant::Quadratic(LastSegment::Beyond),
    Interpolant::Quadratic(LastSegment::Backward),
    Interpolant::QuadraticMidpoint,
];

fn method(
    (color, opacity): (Interpolant, Interpolant),
    attenuated: bool,
    (inside, across): (Integration, Integration),
) -> Preintegrated {
    Preintegrated {
        color: Color {
            interpolant: color,
            attenuated,
            integration: inside,
        },
        opacity: Opacity {
            interpolant: opacity,
            integration: across,
        },
    }
}

#[test]
fn closed_forms_are_the_integrals_along_the_interpolated_field() {
    for (color, opacity) in INTERPOLANTS.into_iter().zip(INTERPOLANTS.into_iter().rev()) {
        for attenuated in [true, false] {
            let closed = (Integration::Closed, Integration::Closed);
            compare(&Bowl, method((color, opacity), attenuated, closed), &[2, 3]);
        }
    }
    let closed = (Integration::Closed, Integration::Closed);
    let linear = (Interpolant::Linear, Interpolant::QuadraticMidpoint);
    compare(&Bowl, method(linear, true, closed), &[1]);
    let beyond = INTERPOLANTS[1];
    compare(&Bowl, method((beyond, beyond), true, closed), &[1]);
}

#[test]
fn sub_intervals_apply_their_rule_to_each() {
    for (rule, count) in [
        (Rule::RiemannLeft, 3),
        (Rule::RiemannRight, 2),
        (Rule::Midpoint, 3),
        (Rule::Trapezoid, 4),
        (Rule::Simpson, 3),
        (Rule::Boole, 1),
        (Rule::GaussLegendre(3), 2),
    ] {
        let by_rule = Integration::SubIntervals { count, rule };
        for (integrations, attenuated) in [
            ((by_rule, by_rule), true),
            ((by_rule, Integration::Closed), true),
            ((Integration::Closed, by_rule), false),
            ((by_rule, by_rule), false),
        ] {
            let pair = (Interpolant::Linear, Interpolant::QuadraticMidpoint);
            compare(&Bowl, method(pair, attenuated, integrations), &[1, 2]);
        }
        // No polynomials here, so the depth inside comes from the rule as well.
        let pair = (INTERPOLANTS[2], Interpolant::Linear);
        compare(
            &SineSquared,
            method(pair, true, (by_rule, by_rule)),
            &[2, 3],
        );
    }
}

/// Backward parabolas need two segments, all the others one.
#[test]
fn a_backward_parabola_needs_two_segments() {
    let closed = (Integration::Closed, Integration::Closed);
    let nodes = Fresh::new(&Bowl, FORMAT);
    for interpolant in INTERPOLANTS {
        let method = method((interpolant, interpolant), true, closed);
        let backward = interpolant == Interpolant::Quadratic(LastSegment::Backward);
        assert_eq!(method.radiance(&nodes, 1).is_err(), backward, "{method}");
        assert!(method.radiance(&nodes, 0).is_err(), "{method}");
        for n in [2, 3, 5] {
            assert!(method.radiance(&nodes, n).is_ok(), "{method} on {n}");
        }
    }
}

#[test]
fn binary64_agrees_with_mpfr() {
    let closed = (Integration::Closed, Integration::Closed);
    for interpolant in INTERPOLANTS {
        let method = method((interpolant, interpolant), true, closed);
        let native = method
            .radiance(&Fresh::new(&Bowl, Native::<f64>::new()), 8)
            .unwrap();
        let wide = Float::from(method.radiance(&Fresh::new(&Bowl, FORMAT), 8).unwrap());
        // Some 200 operations of 2⁻⁵³ each.
        assert!((wide / native - 1_u32).abs() < 2e-14, "{method}");
    }
}

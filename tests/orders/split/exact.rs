//! Nested rules over closed forms of their sums, in exact rationals: written anew, sharing nothing with the
//! library but the values of the medium.

use rug::{Float, Rational};
use volver::quadrature::Rule;

/// Bits of the only thing that is not rational, an exponential: far beyond any oracle here.
const BITS: u32 = 2000;

/// What a run reads of the medium.
#[derive(Clone, Debug)]
pub(crate) struct Medium {
    /// τ at the n + 1 boundaries.
    pub(crate) extinction: Vec<Rational>,
    /// C at the n + 1 boundaries.
    pub(crate) emission: Vec<Rational>,
    /// τ in the middle of the n segments.
    pub(crate) middle: Vec<Rational>,
    /// D/n.
    pub(crate) step: Rational,
}

/// How a depth attenuates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Attenuation {
    /// ∏ (1 − qⱼ).
    Linear,
    /// ∏ (1 − qⱼ + qⱼ²/2).
    Quadratic,
    /// e^(−Σ qⱼ), to 2000 bits.
    Exact,
}

/// ∑ W C τ T.
pub(crate) fn radiance(
    medium: &Medium,
    inner: Rule,
    outer: Rule,
    attenuation: Attenuation,
) -> Rational {
    let n = medium.middle.len();
    let mut radiance = Rational::new();
    let mut depth = Rational::new();
    let mut transmittance = Rational::from(1);
    for i in 0..=n {
        if i > 0 {
            let q = segment(medium, inner, i - 1);
            depth += &q;
            transmittance = match attenuation {
                Attenuation::Linear => transmittance * (1 - q),
                Attenuation::Quadratic => {
                    let square = Rational::from(q.square_ref()) / 2;
                    transmittance * (1 - q + square)
                }
                Attenuation::Exact => (-Float::with_val(BITS, &depth))
                    .exp()
                    .to_rational()
                    .unwrap(),
            };
        }
        let source = Rational::from(&medium.emission[i] * &medium.extinction[i]);
        radiance += source * &transmittance * weight(outer, i, n);
    }
    radiance * &medium.step
}

/// The depth of segment j.
fn segment(medium: &Medium, rule: Rule, j: usize) -> Rational {
    let (front, back) = (&medium.extinction[j], &medium.extinction[j + 1]);
    let mean = match rule {
        Rule::RiemannLeft => front.clone(),
        Rule::RiemannRight => back.clone(),
        Rule::Midpoint => medium.middle[j].clone(),
        Rule::Trapezoid => Rational::from(front + back) / 2,
        Rule::Simpson => (Rational::from(front + back) + Rational::from(&medium.middle[j] * 4)) / 6,
        _ => unreachable!("no such inner rule here"),
    };
    mean * &medium.step
}

/// The weight of boundary i of n, in steps.
fn weight(rule: Rule, i: usize, n: usize) -> Rational {
    let end = i == 0 || i == n;
    match rule {
        Rule::RiemannLeft => Rational::from(i32::from(i != n)),
        Rule::RiemannRight => Rational::from(i32::from(i != 0)),
        Rule::Trapezoid => Rational::from((1, if end { 2 } else { 1 })),
        Rule::Simpson => Rational::from((
            if end {
                1
            } else if i % 2 == 1 {
                4
            } else {
                2
            },
            3,
        )),
        _ => unreachable!("no such outer rule here"),
    }
}

//! The functions of a case, evaluated along the ray.

use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::real::{Mpfr, MpfrReal};
use crate::symbolic::{Piece, Place, Program};
use rug::Float;
use std::f64::consts::LN_10;

/// Places of a piece; those on a straight line are thinned out later.
const COUNT: u32 = 600;
const PRECISION: Mpfr = Mpfr { bits: 128 };
/// An optical depth from which on the transmittance is drawn by its logarithm: T = 10⁻⁴.
const LOGARITHMIC_FROM: f64 = 4.0 * LN_10;
/// Beyond these, axes would overflow: values are taken as infinite, or 0.
const HUGE: f64 = 1e290;
/// How far inside a piece a function is looked at that has no value at its end, as a part of the piece.
const INSIDE: f64 = 1e-7;

/// One function of λ, of each channel where it differs.
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) symbol: &'static str,
    pub(super) curves: Vec<Curve>,
    /// Values are logarithms to base 10.
    pub(super) is_logarithm: bool,
    /// The value at the far end of the ray, where it is worth telling.
    pub(super) at_end: Option<Float>,
}

/// Runs of (λ, value) without a gap or a jump.
pub(super) type Curve = Vec<Vec<(f64, f64)>>;

/// s, C, τ, T and I; s, τ and T are the same for all channels.
pub(super) fn quantities(channels: &[Manufactured]) -> Vec<Quantity> {
    let sampled: Vec<Sampled> = channels.iter().map(sample).collect();
    let Some(first) = sampled.first() else {
        return Vec::new();
    };
    let [field, _, extinction, depth, _] = &first.curves;
    let of_all = |index: usize| sampled.iter().map(|s| s.curves[index].clone()).collect();
    let depth_at_end = first.depth_at_end.as_ref();
    let is_logarithm = depth_at_end.is_some_and(|t| *t >= LOGARITHMIC_FROM);
    let mut transmittance = depth.clone();
    for (_, value) in transmittance.iter_mut().flatten() {
        *value = if is_logarithm {
            -*value / LN_10
        } else {
            (-*value).exp()
        };
    }
    let plain = |name, symbol, curves| Quantity {
        name,
        symbol,
        curves,
        is_logarithm: false,
        at_end: None,
    };
    let mut quantities = vec![
        plain("field s", "s", vec![field.clone()]),
        plain("emission C", "C", of_all(1)),
        plain("extinction τ", "τ", vec![extinction.clone()]),
        Quantity {
            is_logarithm,
            at_end: depth_at_end.map(|depth| Float::with_val(depth.prec(), -depth).exp()),
            ..plain("transmittance T = exp(−t)", "T", vec![transmittance])
        },
        Quantity {
            at_end: match &sampled[..] {
                [only] => only.radiance_at_end.clone(),
                _ => None,
            },
            ..plain("radiance I of the ray up to λ", "I", of_all(4))
        },
    ];
    // What has no closed form is not drawn.
    quantities.retain(|quantity| quantity.curves.iter().any(|curve| !curve.is_empty()));
    quantities
}

/// s, C, τ, t and I of one channel.
struct Sampled {
    curves: [Curve; 5],
    depth_at_end: Option<Float>,
    radiance_at_end: Option<Float>,
}

fn sample(case: &Manufactured) -> Sampled {
    let mut curves: [Curve; 5] = Default::default();
    let mut ends: Vec<Float> = Vec::new();
    for piece in pieces(case) {
        let places = places(&piece);
        // Every formula of a case is one of λ: the library checked it before.
        let Ok(program) = Program::new(&piece.exprs, &["lambda"]) else {
            continue;
        };
        let inputs: Vec<MpfrReal> = places
            .iter()
            .map(|&place| MpfrReal::from(Float::with_val(PRECISION.bits, place)))
            .collect();
        let mut values: [Vec<MpfrReal>; 5] = Default::default();
        program.bind(PRECISION).run(&[&inputs], &mut values);
        ends = values
            .iter()
            .filter_map(|values| values.last())
            .map(|value| value.as_float().clone())
            .collect();
        for (curve, values) in curves.iter_mut().zip(&values) {
            let values = values.iter().map(|value| drawable(value.as_float()));
            let points: Vec<(f64, f64)> = places.iter().copied().zip(values).collect();
            curve.extend(runs(&points));
        }
    }
    let end = |index: usize| ends.get(index).filter(|end| end.is_finite()).cloned();
    Sampled {
        curves,
        depth_at_end: end(3),
        radiance_at_end: end(4),
    }
}

/// The pieces; the whole ray as one where it cannot be cut.
fn pieces(case: &Manufactured) -> Vec<Piece> {
    case.pieces().unwrap_or_else(|_| {
        vec![Piece {
            from: Place::rational(0.into()),
            to: Place::rational(case.case.length()),
            exprs: case.along(),
        }]
    })
}

/// Evenly from end to end, and once more just inside of both.
fn places(piece: &Piece) -> Vec<f64> {
    // The inner bounds: a function may have no value on the other side.
    let (from, to) = (piece.from.bracket.1.to_f64(), piece.to.bracket.0.to_f64());
    let at = |share: f64| from + (to - from) * share;
    let mut places = vec![from, at(INSIDE)];
    places.extend((1..COUNT).map(|k| at(f64::from(k) / f64::from(COUNT))));
    places.extend([at(1.0 - INSIDE), to]);
    places
}

fn drawable(value: &Float) -> f64 {
    let value = value.to_f64();
    if value.abs() > HUGE {
        f64::NAN
    } else if value.abs() < HUGE.recip() {
        0.0
    } else {
        value
    }
}

/// The stretches with values.
fn runs(points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    points
        .split(|(place, value)| !(place.is_finite() && value.is_finite()))
        .filter(|run| run.len() > 1)
        .map(<[_]>::to_vec)
        .collect()
}

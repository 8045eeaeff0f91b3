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
    pub(super) curves: Vec<Curve>,
    /// Values are logarithms to base 10.
    pub(super) is_logarithm: bool,
    /// "T(D)" and the value there.
    pub(super) at_end: Option<(&'static str, Float)>,
}

/// Runs of (λ, value) without a gap or a jump.
pub(super) type Curve = Vec<Vec<(f64, f64)>>;

/// s, C, τ, T and I; s, τ and T are the same for all channels.
pub(super) fn quantities(channels: &[Manufactured]) -> Vec<Quantity> {
    let sampled: Vec<Sampled> = channels.iter().map(sample).collect();
    let Some(first) = sampled.first() else {
        return Vec::new();
    };
    let curve = |sampled: &Sampled, index: usize| sampled.curves.get(index).cloned();
    let of_all = |index: usize| sampled.iter().filter_map(|s| curve(s, index)).collect();
    let of_first = |index: usize| curve(first, index).into_iter().collect();
    let plain = |name, curves| Quantity {
        name,
        curves,
        is_logarithm: false,
        at_end: None,
    };
    let mut transmittance: Vec<Curve> = of_first(3);
    let is_logarithm = first
        .depth_at_end
        .as_ref()
        .is_some_and(|t| *t >= LOGARITHMIC_FROM);
    for point in transmittance.iter_mut().flatten().flatten() {
        point.1 = if is_logarithm {
            -point.1 / LN_10
        } else {
            (-point.1).exp()
        };
    }
    let mut quantities = vec![
        plain("field s", of_first(0)),
        plain("emission C", of_all(1)),
        plain("extinction τ", of_first(2)),
        Quantity {
            is_logarithm,
            at_end: first
                .depth_at_end
                .as_ref()
                .map(|depth| ("T(D)", Float::with_val(depth.prec(), -depth).exp())),
            ..plain("transmittance T = exp(−t)", transmittance)
        },
        Quantity {
            at_end: match &sampled[..] {
                [only] => only.radiance_at_end.clone().map(|value| ("I(D)", value)),
                _ => None,
            },
            ..plain("radiance I of the ray up to λ", of_all(4))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::manufacture::manufacture;
    use crate::case::{Description, catalogue};

    fn quantities_of(text: &str) -> Vec<Quantity> {
        quantities(&manufacture(&Description::read(text).unwrap()).unwrap())
    }

    #[test]
    fn both_sides_of_a_jump_are_right() {
        let quantities = quantities_of(catalogue::text("jump-off-node").unwrap());
        let [before, after] = &quantities[2].curves[0][..] else {
            panic!("two pieces");
        };
        assert!(before.iter().all(|point| point.1 == 1.0));
        assert!(after.iter().all(|point| point.1 == 3.0));
        assert_eq!(before.last().unwrap().0, after[0].0);
    }

    #[test]
    fn what_channels_share_is_sampled_once() {
        let quantities = quantities_of(catalogue::text("rgb-transfer").unwrap());
        let counts: Vec<usize> = quantities.iter().map(|q| q.curves.len()).collect();
        assert_eq!(counts, [1, 3, 1, 1, 3]);
        assert!(quantities[4].at_end.is_none());
    }

    #[test]
    fn thick_rays_have_logarithms() {
        let quantities = quantities_of(catalogue::text("thick").unwrap());
        assert!(quantities[3].is_logarithm);
        let last = quantities[3].curves[0][0].last().unwrap().1;
        assert!((last + 50.0 / LN_10).abs() < 1e-12);
        assert!(
            quantities_of(catalogue::text("sine-squared").unwrap())[3]
                .at_end
                .is_some()
        );
    }

    #[test]
    fn a_function_without_a_value_at_an_end_is_drawn_up_to_it() {
        // C = 2 lambda/sin lambda is 0/0 at 0.
        let quantities = quantities_of(
            "name = \"a\"\nlength = 1\ndepth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\"",
        );
        let start = quantities[1].curves[0][0][0];
        assert!(start.0 > 0.0 && start.0 < 1e-6 && (start.1 - 2.0).abs() < 1e-6);
    }
}

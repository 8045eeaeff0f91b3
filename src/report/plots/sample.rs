//! The functions of a case, evaluated along the ray.

use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::real::{Mpfr, MpfrReal};
use crate::symbolic::{Piece, Place, Program};
use rug::Float;

/// Places of a piece; those on a straight line are thinned out later.
const COUNT: u32 = 600;
const PRECISION: Mpfr = Mpfr { bits: 128 };
/// Beyond these, axes would overflow: values are taken as infinite, or 0.
const HUGE: f64 = 1e290;
/// How far inside a piece a function is looked at that has no value at its end, as a part of the piece.
const INSIDE: f64 = 1e-7;

/// (λ, value), with a value that is not finite where the line breaks.
pub(super) type Curve = Vec<(f64, f64)>;

/// s, C, τ, t and I of one channel, and their values at the far end.
pub(super) struct Sampled {
    pub(super) curves: [Curve; 5],
    pub(super) ends: [Option<Float>; 5],
}

pub(super) fn sample(case: &Manufactured) -> Sampled {
    let mut sampled = Sampled {
        curves: Default::default(),
        ends: Default::default(),
    };
    for piece in pieces(case) {
        let places = places(&piece);
        // Every formula of a case is one of λ: the library checked it before.
        let Ok(program) = Program::new(&piece.exprs, &["lambda"]) else {
            continue;
        };
        let input = |place: &f64| MpfrReal::from(Float::with_val(PRECISION.bits, *place));
        let inputs: Vec<MpfrReal> = places.iter().map(input).collect();
        let mut values: [Vec<MpfrReal>; 5] = Default::default();
        program.bind(PRECISION).run(&[&inputs], &mut values);
        for (index, values) in values.iter().enumerate() {
            let curve = &mut sampled.curves[index];
            let points = values.iter().map(|value| drawable(value.as_float()));
            curve.extend(places.iter().copied().zip(points));
            curve.push((f64::NAN, f64::NAN));
            let end = values.last().map(|value| value.as_float().clone());
            sampled.ends[index] = end.filter(Float::is_finite);
        }
    }
    sampled
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

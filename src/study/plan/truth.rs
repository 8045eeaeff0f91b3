//! The radiance of a scene to many digits, without a plan.

use crate::case::{Case, Structure, Transfer};
use crate::real::{Format, Real};
use crate::reference::{ReferenceError, optical_depth, radiance};
use crate::scene::{BoundPiece, Columns, Form, Piece, Scene};
use crate::symbolic::{Expr, Program};
use rug::{Float, Rational};

/// The radiance of every channel to about `bits` bits of the brightest light: piece by piece by the oracle, which
/// knows nothing of plans, and composited.
///
/// # Errors
/// [`ReferenceError`] where a piece is not resolved.
pub fn scene_radiance(scene: &Scene, bits: u32) -> Result<Vec<Float>, ReferenceError> {
    let wide = bits + 64;
    let number = |q: &Rational| Float::with_val(wide, q);
    let pieces: Vec<&Piece> = scene
        .media()
        .iter()
        .flat_map(|medium| &medium.pieces)
        .collect();
    let background = scene.background().iter().enumerate();
    background
        .map(|(channel, background)| {
            let mut light = number(background);
            for piece in pieces.iter().rev() {
                let case = OfPiece { piece, channel };
                let (own, depth) = match &piece.form {
                    Form::Vacuum => continue,
                    Form::Constant(values) => {
                        let length = case.length();
                        let depth = number(&(length * &values[channel].extinction));
                        let opacity = -Float::with_val(wide, -&depth).exp_m1();
                        (opacity * number(&values[channel].emission), depth)
                    }
                    _ => {
                        let depth = optical_depth(&case, bits)?.value;
                        (radiance(&case, bits)?.value, depth)
                    }
                };
                light *= Float::with_val(wide, -depth).exp();
                light += own;
            }
            Ok(light)
        })
        .collect()
}

/// One channel of a piece as a case whose field is λ less where the piece begins.
#[derive(Clone, Copy, Debug)]
struct OfPiece<'s> {
    piece: &'s Piece,
    channel: usize,
}

impl Case for OfPiece<'_> {
    fn name(&self) -> &'static str {
        "piece"
    }

    fn length(&self) -> Rational {
        Rational::from(&self.piece.to - &self.piece.from)
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let format = s.format();
        let place = s.clone() + &format.ratio(&self.piece.from);
        let channels = match &self.piece.form {
            Form::Vacuum => 1,
            Form::Constant(values) => values.len(),
            Form::Linear { front, .. } => front.len(),
            Form::Smooth { formulas, .. } => formulas.len(),
        };
        let mut columns = Columns::new(channels);
        BoundPiece::new(self.piece, format).evaluate(&[place], &mut columns);
        let value = |columns: &[Vec<R>]| {
            let column = columns.get(self.channel).and_then(|column| column.first());
            column.cloned().unwrap_or_else(|| format.int(0))
        };
        Transfer {
            emission: value(&columns.emission),
            extinction: value(&columns.extinction),
        }
    }

    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        None
    }

    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        None
    }

    fn integrand(&self) -> Option<Program> {
        let place = Expr::symbol("lambda") + Expr::from(self.piece.from.clone());
        let of = |values: &Transfer<Expr>| [values.emission.clone(), values.extinction.clone()];
        let number = |q: &Rational| Expr::from(q.clone());
        let outputs = match &self.piece.form {
            Form::Vacuum => [Expr::from(0), Expr::from(0)],
            Form::Constant(values) => {
                let values = values.get(self.channel)?;
                [number(&values.emission), number(&values.extinction)]
            }
            Form::Linear { front, back } => {
                let (front, back) = (front.get(self.channel)?, back.get(self.channel)?);
                let part = Expr::symbol("lambda") * Expr::from(self.length().recip());
                let between = |near: &Rational, far: &Rational| {
                    number(near) + number(&Rational::from(far - near)) * part.clone()
                };
                [
                    between(&front.emission, &back.emission),
                    between(&front.extinction, &back.extinction),
                ]
            }
            Form::Smooth { formulas, .. } => {
                of(formulas.get(self.channel)?).map(|formula| formula.substitute("lambda", &place))
            }
        };
        Program::new(&outputs, &["lambda"]).ok()
    }

    fn structure(&self) -> Structure {
        Structure::default()
    }
}
